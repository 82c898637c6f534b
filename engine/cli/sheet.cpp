#include "engine/cli/commands.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "base/suggest.hpp"
#include "engine/cli/sheet_file.hpp"
#include "engine/dance_files.hpp"
#include "motion/dancer.hpp"

namespace raks::cli {
namespace {

// The dancer has settled into the figure by then, and figures of 3, 4, 6 and 8 beats begin there.
constexpr double kBeatsBefore = 24.0;
constexpr int kCounts = 8;
constexpr std::size_t kPoses = std::size_t{kCounts} * kPosesPerBeat;

/// Music that is known exactly: a steady tempo in bars of four.
MusicState steady_music(HopIndex hop, Bpm tempo) {
    MusicState state;
    state.hop = hop;
    state.time = state.heard_until = time_of_hop(hop);
    state.grid.tempo = tempo;
    state.grid.confidence = 1.0F;
    state.is_silent = false;
    state.loudness_lufs = -16.0F;
    state.level_dbfs = -16.0F;
    state.genre = Genre::salsa;
    return state;
}

/// One figure from count 1 on, a pose every 1/8 beat.
Expected<std::vector<motion::Pose>> poses_of_a_figure(const SheetArguments& arguments) {
    const engine::Settings& settings = arguments.settings;
    const Bpm tempo(arguments.bpm);
    const auto library = engine::load_dance(
        engine::dance_to_load(settings), motion::DanceRole::lead, engine::form_of(settings));
    if (!library) {
        return fail(library.error());
    }
    motion::Dancer dancer;
    if (auto prepared = dancer.prepare(
            *library, motion::mannequin_skeleton(), static_cast<std::uint64_t>(settings.seed));
        !prepared) {
        return fail(prepared.error());
    }
    const std::vector<std::string_view> names = (*library)->figure_names();
    const auto figure = std::find(names.begin(), names.end(), arguments.figure);
    if (figure == names.end() && !arguments.figure.empty()) {
        return fail(unknown_name("figure", arguments.figure, names));
    }
    const auto index = arguments.figure.empty() ? 0 : figure - names.begin();
    using Kind = motion::DancerCommand::Kind;
    dancer.command({Kind::select_figure, {}, static_cast<double>(index)});
    dancer.command({Kind::lock_figure, {}, 1.0});
    const auto track = std::make_unique<motion::PoseTrack>();
    std::vector<motion::Pose> poses;
    for (HopIndex hop = 0; poses.size() < kPoses; ++hop) {
        const MusicState state = steady_music(hop, tempo);
        dancer.advance(state, *track);
        const auto next = [&] {
            return state.grid.time_of(
                Beats(kBeatsBefore + static_cast<double>(poses.size()) / kPosesPerBeat));
        };
        while (poses.size() < kPoses && next() <= state.time) {
            poses.push_back(track->at(next()));
        }
    }
    return poses;
}

}  // namespace

ExitCode sheet(const SheetArguments& arguments) {
    const auto look = engine::read_look(arguments.settings);
    if (!look) {
        return fail(look.error());
    }
    const auto poses = poses_of_a_figure(arguments);
    if (!poses) {
        return fail(poses.error());
    }
    if (auto written = write_sheet(arguments.output, *look, *poses, figure_sheet()); !written) {
        return fail(written.error());
    }
    return kExitDone;
}

}  // namespace raks::cli
