// `raks stick dance.toml`: shows a written dance in a window while it is being written, or draws it
// on sheets.
#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks/commands.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/raks/stick_window.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/dance_preview.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Poses on all sheets of one command: each is two pictures, of some 20 ms of computing in software,
// and more nobody looks at.
constexpr int kMostPoses = 192;

// One sheet of the figure that the preview shows, so many poses a beat.
Expected<void> write_figure(const engine::DancePreview& preview,
                            SheetStudio& studio,
                            const Path& output,
                            int per_beat) {
    const auto poses = preview.sheet(per_beat);
    const SheetLabels labels = figure_labels(std::string(preview.figure()), poses.size(), per_beat);
    if (auto written = studio.write_sheet(output, poses, figure_sheet(), labels); !written) {
        return written;
    }
    print_text(fmt::format("{}: front and side of {}, {}\n",
                           printable(output.string()),
                           preview.figure(),
                           per_beat == kPosesPerBeat ? std::string("eighths of a beat")
                                                     : fmt::format("{} a beat", per_beat)));
    return {};
}

// Eighths of a beat, or as many as keep all sheets within bounds; at least one.
int poses_per_beat(int beats) {
    int per_beat = kPosesPerBeat;
    while (beats * per_beat > kMostPoses && per_beat > 1) {
        per_beat /= 2;
    }
    return per_beat;
}

// One sheet of each figure as X_FIGURE.png. Of very long dances the last figures are left out.
Expected<void> write_all(engine::DancePreview& preview, SheetStudio& studio, const Path& output) {
    const std::vector<std::string> figures = preview.figures();
    int beats = 0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        beats += preview.beats_of_sheet(i);
    }
    const int per_beat = poses_per_beat(beats);
    int poses = 0;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        poses += per_beat * preview.beats_of_sheet(i);
        if (i > 0 && poses > kMostPoses) {
            say(fmt::format(
                "the sheets of {} figures from {} on are left out; --figure NAME draws one",
                figures.size() - i,
                figures[i]));
            return {};
        }
        preview.show(i);
        Path path = output;
        path.replace_filename(fmt::format("{}_{}.png", output.stem().string(), figures[i]));
        if (auto written = write_figure(preview, studio, path, per_beat); !written) {
            return written;
        }
    }
    return {};
}

// Sheets: one of the figure asked for, or one of each. Drawn as a window would be: on software
// drivers fast.
Expected<void> write_figures(engine::DancePreview& preview,
                             const engine::Look& look,
                             const Path& output,
                             const std::string& wanted) {
    auto studio = SheetStudio::open(look, look.quality);
    if (!studio) {
        return fail(studio.error());
    }
    if (wanted.empty()) {
        return write_all(preview, *studio, output);
    }
    const std::vector<std::string> figures = preview.figures();
    const auto shown = std::find(figures.begin(), figures.end(), wanted) - figures.begin();
    const int beats = preview.beats_of_sheet(static_cast<std::size_t>(shown));
    return write_figure(preview, *studio, output, poses_per_beat(beats));
}

// Shows the dance in a window, and its newer text as soon as it is saved; the camera follows the
// body.
class PreviewContent final : public engine::WindowContent {
 public:
    /// `preview` must outlive this.
    explicit PreviewContent(engine::DancePreview& preview) : preview_(preview) {}

    bool handle(const KeyEvent& key) override { return preview_.handle(key); }
    [[nodiscard]] std::vector<render::HelpRow> own_keys() const override {
        return {{"DANCE", {"Left", "Right"}, "figure before, after"},
                {"DANCE", {"Up", "Down"}, "faster, slower"},
                {"DANCE", {"Space"}, "pause, go on"}};
    }
    void advance(double seconds) override;
    void draw(const engine::WindowPicture& picture, render::OverlayState& overlay) override;
    [[nodiscard]] bool is_finished() const override { return false; }

 private:
    engine::DancePreview& preview_;
    double since_look_ = 0.0;  // seconds
    std::string status_;
};

void PreviewContent::advance(double seconds) {
    // Seconds between two looks at whether the file was saved.
    constexpr double kLookEvery = 0.25;
    preview_.advance(seconds);
    since_look_ += seconds;
    if (since_look_ > kLookEvery) {
        since_look_ = 0.0;
        // A fault stays over the picture and is printed once.
        if (preview_.refresh() && !preview_.fault().empty()) {
            say(preview_.fault());
        }
    }
}

void PreviewContent::draw(const engine::WindowPicture& picture, render::OverlayState& overlay) {
    const motion::Pose pose = preview_.pose();
    picture.scene.camera.pan_to(pose.hips_position);
    const render::Dancer dancer = picture.bodies.still(pose);
    picture.renderer.draw(picture.scene, std::span(&dancer, 1), picture.target);
    // The overlay refers to the text until the next picture.
    status_ = preview_.status();
    overlay.message = status_;
}

}  // namespace

ExitCode stick_dance(const StickArguments& arguments) {
    if (!arguments.output.empty() && arguments.output.extension() != ".png") {
        return fail(arguments.output.string() +
                    ": cannot write this kind of picture of a written dance; known: .png (raks "
                    "sheet --dance films one)");
    }
    if (!arguments.edges.empty() || !arguments.other.empty()) {
        return fail(arguments.input.string() +
                    ": is a written dance; --edges and a second motion are for clips and points");
    }
    auto preview = engine::DancePreview::create(
        arguments.input,
        arguments.figure,
        arguments.bpm > 0.0 ? std::optional(Bpm(arguments.bpm)) : std::nullopt);
    if (!preview) {
        return fail(preview.error());
    }
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    Path output = arguments.output;
    if (output.empty()) {
        auto window = open_stick_window(arguments.input.string(), *look, arguments.settings);
        if (window) {
            PreviewContent content(*preview);
            if (auto shown = show_in_window(std::move(*window), *look, content); !shown) {
                return fail(shown.error());
            }
            return kExitDone;
        }
        output = arguments.input.stem();
        output += ".png";
        say("no window (" + window.error().message + "): drawing sheets");
    }
    if (auto written = write_figures(*preview, *look, output, arguments.figure); !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::apps
