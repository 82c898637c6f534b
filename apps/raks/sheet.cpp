#include "apps/raks/commands.hpp"

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/raks/dance_setup.hpp"
#include "apps/raks/sheet_file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/setup/dance_files.hpp"
#include "engine/trials/figure_alone.hpp"
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

// What a sheet shows.
struct DancedFigure {
    std::string name;  // "salsa: basic"
    std::vector<motion::Pose> poses;
};

// A sheet or a film of a clip. Sheets have its poses at even times.
ExitCode draw_clip(const SheetArguments& arguments, const engine::Look& look) {
    const auto clip = open_clip(arguments.motion, arguments.settings);
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

// One figure, danced by itself on a steady beat, from count 1 on. Errors: no such figure.
Expected<DancedFigure> dance_a_figure(const SheetArguments& arguments,
                                      const DanceSetup& setup,
                                      const SheetPlan& plan) {
    const engine::Settings& settings = arguments.settings;
    const std::string dance = engine::dance_to_load(settings, *setup.catalogue.list());
    const auto library = engine::load_dance(
        setup.catalogue, dance, setup.skeleton, motion::DanceRole::lead, engine::form_of(settings));
    if (!library) {
        return fail(library.error());
    }
    const std::vector<std::string_view> names = (*library)->figure_names();
    const auto figure = std::find(names.begin(), names.end(), arguments.figure);
    if (figure == names.end() && !arguments.figure.empty()) {
        return fail(unknown_name("figure", arguments.figure, names));
    }
    // The first figure when none is named.
    const auto index = arguments.figure.empty() ? 0 : figure - names.begin();
    std::vector<double> beats;
    const auto poses = static_cast<std::size_t>(plan.counts * plan.poses_per_beat);
    for (std::size_t i = 0; i < poses; ++i) {
        beats.push_back(static_cast<double>(i) / plan.poses_per_beat);
    }
    // The dancer settles before count 1, so that the figure does not begin from standing.
    engine::FigureOnBeat on;
    on.figure = static_cast<std::size_t>(index);
    on.tempo = Bpm(arguments.bpm);
    on.seed = static_cast<std::uint64_t>(settings.seed);
    auto danced = engine::dance_alone(*library, setup.skeleton, on, beats);
    if (!danced) {
        return fail(danced.error());
    }
    return DancedFigure{fmt::format("{}: {}", dance, names[on.figure]), std::move(*danced)};
}

}  // namespace

ExitCode sheet(const SheetArguments& given) {
    SheetArguments arguments = given;
    const auto look = open_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    if (!arguments.motion.empty()) {
        return draw_clip(arguments, *look);
    }
    // The kind of output decides: a .png is a sheet, all else a film.
    const bool is_sheet = arguments.output.extension() == ".png";
    const double fps = arguments.settings.fps;
    // A film has one pose a picture: 60 fps / BPM pictures a beat.
    const SheetPlan plan =
        is_sheet ? SheetPlan() : SheetPlan{kFilmCounts, 60.0 * fps / arguments.bpm};
    const auto setup =
        open_dances(arguments.settings, render::dance_body(*look->avatars.front().avatar));
    if (!setup) {
        return fail(setup.error());
    }
    const auto danced = dance_a_figure(arguments, *setup, plan);
    if (!danced) {
        return fail(danced.error());
    }
    auto studio = SheetStudio::open(*look, best_quality(*look));
    if (!studio) {
        return fail(studio.error());
    }
    const std::string title = fmt::format("{}, {:g} BPM", danced->name, arguments.bpm);
    return exit_code_of(is_sheet ? studio->write_sheet(arguments.output,
                                                       danced->poses,
                                                       figure_sheet(),
                                                       figure_labels(title, danced->poses.size()))
                                 : studio->write_film(arguments.output, danced->poses, fps));
}

}  // namespace raks::apps
