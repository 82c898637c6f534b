#include "apps/raks/stick_film.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/raks/stick_window.hpp"
#include "apps/terminal/program.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "engine/show/clip_film.hpp"
#include "render/avatar/avatar.hpp"
#include "render/overlay/overlay.hpp"
#include "render/renderer.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Poses of a sheet over a whole clip: two rows of twelve.
constexpr std::size_t kSheetPoses = 24;

bool is_sheet(const Path& output) { return output.extension() == ".png"; }

// The frames to draw: the one asked for, or up to 24 evenly over the clip, with the first and last.
std::vector<std::size_t> frames_to_draw(std::size_t frame_count,
                                        const std::optional<std::size_t>& frame) {
    if (frame) {
        return {*frame};
    }
    const std::size_t count = std::min(kSheetPoses, frame_count);
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i) {
        frames.push_back(count == 1 ? 0 : i * (frame_count - 1) / (count - 1));
    }
    return frames;
}

// A single frame is drawn large.
render::PoseSheetConfig sheet_layout(bool is_alone) {
    render::PoseSheetConfig config;
    config.columns = is_alone ? 1 : 12;
    config.tile_width = is_alone ? 720 : 180;
    config.tile_height = is_alone ? 960 : 240;
    return config;
}

// Draws these frames from the front and the side, and prints their numbers.
Expected<void> write_frames(const Path& output,
                            const engine::Look& look,
                            const ShownClip& shown,
                            const render::RecordedBodies& recorded,
                            const std::vector<std::size_t>& frames) {
    const bool is_alone = frames.size() == 1;
    render::PoseSheetConfig config = sheet_layout(is_alone);
    std::vector<render::ClipBody> bodies;
    bodies.reserve(frames.size());
    for (const std::size_t frame : frames) {
        bodies.push_back(recorded.at(frame));
    }
    const float aspect =
        static_cast<float>(config.tile_width) / static_cast<float>(config.tile_height);
    for (render::Camera& camera : config.cameras) {
        camera = engine::framed_for(camera, recorded);
        for (const render::ClipBody& body : bodies) {
            camera = render::enclosing(camera, aspect, body);
        }
    }
    // A frame alone is the picture that was asked for, without a word on it.
    SheetLabels labels;
    if (!is_alone) {
        labels.title = printable(shown.name, 120) + ", frames";
        for (const std::size_t frame : frames) {
            labels.poses.push_back(std::to_string(frame));
        }
    }
    auto studio = SheetStudio::open(look, best_quality(look));
    if (!studio) {
        return fail(studio.error());
    }
    if (auto written = studio->write_sheet(output, bodies, config, labels); !written) {
        return written;
    }
    print_text(fmt::format(
        "{}: front and side of frames {}\n", printable(output.string()), fmt::join(frames, " ")));
    return {};
}

engine::ClipFilmPlan film_plan(const StickArguments& arguments,
                               engine::PictureSize size,
                               render::Quality quality) {
    engine::ClipFilmPlan plan;
    plan.output = arguments.output;
    plan.size = size;
    plan.quality =
        quality == render::Quality::fast ? render::VideoQuality::draft : render::VideoQuality::high;
    return plan;
}

engine::ClipContent content_of(const StickArguments& arguments,
                               const ShownClip& shown,
                               const render::RecordedBodies& recorded,
                               bool has_bar) {
    // Paused at the frame asked for, or playing.
    engine::ClipTransport transport =
        arguments.frame
            ? engine::ClipTransport(shown.frame_count, shown.frames_per_second, *arguments.frame)
            : engine::ClipTransport(shown.frame_count, shown.frames_per_second);
    transport.set_rate(arguments.rate);
    return {recorded,
            std::move(transport),
            {.marks = {arguments.has_names, arguments.has_trails, shown.keys},
             .highlight = shown.highlight,
             .framed_frames = frames_to_draw(shown.frame_count, std::nullopt),
             .frames_per_second = shown.frames_per_second,
             .has_bar = has_bar}};
}

// A film of the whole clip, or of the frame that was asked for.
Expected<void> film(const StickArguments& arguments,
                    const engine::Look& look,
                    const ShownClip& shown,
                    const render::RecordedBodies& recorded) {
    auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto renderer =
        render::Renderer::create(*look.avatars.front().avatar, {.quality = best_quality(look)});
    if (!renderer) {
        return fail(renderer.error());
    }
    auto overlay = render::Overlay::create();
    if (!overlay) {
        return fail(overlay.error());
    }
    engine::ClipContent content = content_of(arguments, shown, recorded, false);
    render::Scene scene = look.scene;
    scene.camera = content.framed(scene.camera);
    engine::ClipFilmPlan plan = film_plan(arguments, look.size, best_quality(look));
    plan.samples = renderer->samples();
    plan.shown = engine::filmed_frames(shown.frame_count, shown.frames_per_second, arguments.rate);
    if (arguments.frame) {
        plan.shown.frames = {*arguments.frame};
    }
    ProgressLine progress("filming");
    std::size_t pictures = 0;
    auto written = engine::write_clip_film(
        plan,
        [&](std::size_t frame, const render::FrameTarget& target) {
            render::OverlayState state;
            content.draw_frame(frame, *renderer, scene, target, state);
            overlay->draw(state, render::OverlayView::hidden, target);
            ++pictures;
        },
        [&](double share) {
            progress.show(share);
            return !stop_signal().has_value();
        });
    if (!written) {
        return fail(std::move(written.error()));
    }
    print_text(fmt::format("{}: {} pictures, {:.4g} a second\n",
                           printable(written->string()),
                           pictures,
                           plan.shown.pictures_per_second));
    return {};
}

}  // namespace

Expected<void> check_stick_output(const StickArguments& arguments) {
    if (arguments.output.empty() || is_sheet(arguments.output)) {
        return {};
    }
    const std::string ending = arguments.output.extension().string();
    constexpr std::array<std::string_view, 5> kFilms = {"", ".mp4", ".avi", ".mkv", ".webm"};
    if (std::find(kFilms.begin(), kFilms.end(), ending) == kFilms.end()) {
        return fail(arguments.output.string() +
                    ": cannot write this kind of picture; known: .png, .mp4, .avi, .mkv, .webm, or "
                    "a folder");
    }
    const auto size = engine::parse_size(arguments.settings.size);
    if (!size) {
        return fail(size.error());
    }
    return engine::check_clip_film(film_plan(arguments, *size, render::Quality::high));
}

Expected<void> show_recorded(const StickArguments& arguments,
                             const ShownClip& shown,
                             const render::RecordedBodies& recorded) {
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    Path output = arguments.output;
    if (!output.empty() && !is_sheet(output)) {
        return film(arguments, *look, shown, recorded);
    }
    // Without a display the sheet takes the window's place.
    if (output.empty()) {
        auto window = open_stick_window(shown.name, *look, arguments.settings);
        if (window) {
            engine::ClipContent content = content_of(arguments, shown, recorded, true);
            look->scene.camera = content.framed(look->scene.camera);
            return show_in_window(std::move(*window), *look, content);
        }
        output = arguments.input.stem();
        output += ".png";
        say("no window (" + window.error().message + "): drawing a sheet");
    }
    return write_frames(
        output, *look, shown, recorded, frames_to_draw(shown.frame_count, arguments.frame));
}

}  // namespace raks::apps
