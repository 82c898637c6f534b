#include "apps/raks/commands.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/cell_sheet.hpp"
#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "apps/terminal/say.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/show/dress_by_dance.hpp"
#include "engine/trials/figure_alone.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/dance_library.hpp"
#include "render/avatar/avatar.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Beats of a sheet.
constexpr int kCounts = 8;
// Beats of a film: at least two repeats of a figure.
constexpr int kFilmCounts = 16;

// Length of the poses in beats, and their rate.
struct SheetPlan {
    int counts = kCounts;
    double poses_per_beat = kPosesPerBeat;
};

// Moments of a clip on a sheet: as many as a figure has, of a posture one.
std::vector<double> even_times(double duration) {
    constexpr int kTimes = kCounts * kPosesPerBeat / 2;
    if (!(duration > 0.0)) {
        return {0.0};
    }
    std::vector<double> times;
    times.reserve(kTimes);
    for (int i = 0; i < kTimes; ++i) {
        times.push_back(duration * i / (kTimes - 1));
    }
    return times;
}

// Moments of a film's pictures.
std::vector<double> film_times(double duration, double fps) {
    std::vector<double> times;
    for (int i = 0; i == 0 || i / fps < duration; ++i) {
        times.push_back(i / fps);
    }
    return times;
}

// A sheet or a film of a clip. Sheets have its poses at even times.
ExitCode draw_clip(const SheetArguments& arguments, const engine::Look& look) {
    const auto clip = open_clip(arguments.motion, arguments.settings, arguments.arm_angle);
    if (!clip) {
        return fail(clip.error());
    }
    auto studio = SheetStudio::open(look, best_quality(look));
    if (!studio) {
        return fail(studio.error());
    }
    const bool is_sheet = arguments.output.extension() == ".png";
    const std::vector<double> times = is_sheet
                                          ? even_times(clip->duration())
                                          : film_times(clip->duration(), arguments.settings.fps);
    std::vector<motion::Pose> poses;
    poses.reserve(times.size());
    for (const double time : times) {
        poses.push_back(clip->pose_at(time));
    }
    if (!is_sheet) {
        return exit_code_of(studio->write_film(arguments.output, poses, arguments.settings.fps));
    }
    SheetLabels labels{.title = printable(Path(arguments.motion).filename().string()), .poses = {}};
    for (const double time : times) {
        labels.poses.push_back(fmt::format("{:.2f} s", time));
    }
    return exit_code_of(studio->write_sheet(arguments.output, poses, figure_sheet(), labels));
}

// The figure or take that is drawn, as an index; none is named: nothing. Errors: no such one.
Expected<std::optional<std::size_t>> named_figure(const motion::DanceLibrary& library,
                                                  const std::string& name) {
    if (name.empty()) {
        return std::nullopt;
    }
    const std::vector<std::string_view> names = library.figure_names();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        return fail(unknown_name(library.cells() != nullptr ? "take" : "figure", name, names));
    }
    return static_cast<std::size_t>(found - names.begin());
}

// One figure, danced by itself on a steady beat, from count 1 on.
Expected<std::vector<motion::Pose>> dance_a_figure(
    const SheetArguments& arguments,
    const motion::Skeleton& skeleton,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    std::size_t figure,
    const SheetPlan& plan) {
    std::vector<double> beats;
    const auto poses = static_cast<std::size_t>(plan.counts * plan.poses_per_beat);
    for (std::size_t i = 0; i < poses; ++i) {
        beats.push_back(static_cast<double>(i) / plan.poses_per_beat);
    }
    // The dancer settles before count 1, so that the figure does not begin from standing.
    engine::FigureOnBeat on;
    on.figure = figure;
    on.tempo = Bpm(arguments.bpm);
    on.seed = static_cast<std::uint64_t>(arguments.settings.seed);
    return engine::dance_alone(library, skeleton, on, beats);
}

// All of a take, as it was danced.
std::vector<motion::Pose> poses_of_take(const motion::DanceLibrary& library,
                                        std::size_t take,
                                        double poses_per_beat) {
    std::vector<motion::Pose> poses;
    const double beats = library.cells()->takes[take].beats;
    for (int i = 0; i / poses_per_beat < beats; ++i) {
        poses.push_back(library.pose_at(take, i / poses_per_beat));
    }
    return poses;
}

// A sheet of all takes of a dance of cells, or of one; or a film of one.
Expected<void> draw_takes(const SheetArguments& arguments,
                          const motion::DanceLibrary& library,
                          std::optional<std::size_t> take,
                          const std::string& dance,
                          const SheetPlan& plan,
                          SheetStudio& studio) {
    if (arguments.output.extension() != ".png") {
        return studio.write_film(arguments.output,
                                 poses_of_take(library, take.value_or(0), plan.poses_per_beat),
                                 arguments.settings.fps);
    }
    const auto left_out = write_cell_sheet(studio, arguments.output, library, take, dance);
    if (!left_out) {
        return fail(left_out.error());
    }
    if (!left_out->empty()) {
        say(*left_out);
    }
    return {};
}

}  // namespace

ExitCode sheet(const SheetArguments& given) {
    SheetArguments arguments = given;
    // The kind of output decides: a .png is a sheet, all else a film.
    const bool is_sheet = arguments.output.extension() == ".png";
    if (!is_sheet) {
        arguments.settings.fps = said_film_fps(arguments.settings);
    }
    auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    if (!arguments.motion.empty()) {
        return draw_clip(arguments, *look);
    }
    const double fps = arguments.settings.fps;
    // A film has one pose a picture: 60 fps / BPM pictures a beat.
    const SheetPlan plan =
        is_sheet ? SheetPlan() : SheetPlan{kFilmCounts, 60.0 * fps / arguments.bpm};
    const auto setup =
        open_dances(arguments.settings, render::dance_body(*look->avatars.front().avatar));
    if (!setup) {
        return fail(setup.error());
    }
    const engine::Settings& settings = arguments.settings;
    const std::string dance = engine::dance_to_load(settings, setup->catalogue);
    engine::dress_for(*setup->catalogue.list(), dance, *look);
    const auto library = engine::load_dance(setup->catalogue,
                                            dance,
                                            setup->skeleton,
                                            motion::DanceRole::lead,
                                            engine::form_of(settings));
    if (!library) {
        return fail(library.error());
    }
    const auto named = named_figure(**library, arguments.figure);
    if (!named) {
        return fail(named.error());
    }
    // The figures of hundreds of beats are small: shadows are drawn where somebody asks for them.
    const bool is_of_cells = (*library)->cells() != nullptr;
    const bool is_fast = is_of_cells && is_sheet && look->quality != render::Quality::high;
    auto studio = SheetStudio::open(*look, is_fast ? render::Quality::fast : best_quality(*look));
    if (!studio) {
        return fail(studio.error());
    }
    if (is_of_cells) {
        return exit_code_of(draw_takes(arguments, **library, *named, dance, plan, *studio));
    }
    // The first figure when none is named.
    const std::size_t figure = named->value_or(0);
    const auto danced = dance_a_figure(arguments, setup->skeleton, *library, figure, plan);
    if (!danced) {
        return fail(danced.error());
    }
    const std::string title =
        fmt::format("{}: {}, {:g} BPM", dance, (*library)->figure_names()[figure], arguments.bpm);
    return exit_code_of(
        is_sheet
            ? studio->write_sheet(
                  arguments.output, *danced, figure_sheet(), figure_labels(title, danced->size()))
            : studio->write_film(arguments.output, *danced, fps));
}

}  // namespace raks::apps
