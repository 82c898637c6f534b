#include "engine/trials/figure_alone.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "engine/setup/settings.hpp"
#include "motion/choreography/authored_dance.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

// Beats of music before the first count 1 that is used: by then the dancer has settled.
constexpr double kBeatsBefore = 20.0;
// A count 1 is chosen at least this many beats ahead, as poses may be asked for from 2 beats before
// it on.
constexpr double kEarliest = 2.0;
// Twelve repeats: each of the eight variants of a figure occurs, and the measures' noise is halved.
constexpr int kRepeats = 12;
constexpr double kFramesPerSecond = 60.0;
// Beats of poses before the first and after the last repeat.
constexpr double kMargin = 0.5;

// A music state as a perfect tracker would give it: exact steady beats, full confidence, some usual
// loudness.
MusicState steady_music(HopIndex hop, const FigureOnBeat& on) {
    MusicState state;
    state.hop = hop;
    state.time = state.audio_end = time_of_hop(hop);
    state.grid.tempo = on.tempo;
    state.grid.beats_per_bar = on.beats_per_bar;
    state.grid.confidence = 1.0F;
    state.is_silent = false;
    state.loudness_lufs = -16.0F;
    state.level_dbfs = -16.0F;
    state.genre = DanceId{0};  // the one of a repertoire of one
    return state;
}

// The beat of the music, at least kEarliest ahead of `now`, on which the figure begins again.
// Whole: rounding takes out the phase's small error.
double next_count_one(const motion::DancerStatus& status, double now) {
    const double begun = std::round(now - status.phase);
    return begun + status.counts * std::ceil((now + kEarliest - begun) / status.counts);
}

// Dances a figure kRepeats times and measures it. Errors: the library has no such figure.
Expected<motion::TakeMeasures> measure_alone(
    const motion::AuthoredDance& dance,
    const motion::AuthoredFigure& figure,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    std::uint64_t seed) {
    const std::vector<std::string_view> names = library->figure_names();
    const auto found = std::find(names.begin(), names.end(), figure.name);
    if (found == names.end()) {
        return fail(fmt::format("{}: was not learnt; run raks train figure",
                                motion::where_in(dance, figure)));
    }
    motion::FigureTake take;
    take.frames_per_second = kFramesPerSecond;
    take.tempo = dance.written;
    take.first_beat = -kMargin;
    // A mirrored figure begins on the left and on the right in turn: both sides make one repeat.
    take.beats = figure.beats * (figure.is_mirrored ? 2 : 1);
    take.repeats = kRepeats;
    take.beats_per_bar = dance.beats_per_bar;
    // Beats of the poses, at 60 a second of the written tempo; computed from the index, so that no
    // error adds up.
    const double beats_a_frame = dance.written.beats_per_second() / kFramesPerSecond;
    std::vector<double> beats;
    for (double beat = -kMargin; beat < kRepeats * take.beats + kMargin;
         beat = -kMargin + static_cast<double>(beats.size()) * beats_a_frame) {
        beats.push_back(beat);
    }
    const auto poses = dance_alone(
        library,
        skeleton,
        {static_cast<std::size_t>(found - names.begin()), dance.written, dance.beats_per_bar, seed},
        beats);
    if (!poses) {
        return fail(poses.error());
    }
    take.poses = *poses;
    return motion::measure_take(take, skeleton);
}

}  // namespace

Expected<std::vector<motion::Pose>> dance_alone(
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    const FigureOnBeat& on,
    std::span<const double> beats) {
    motion::Dancer dancer;
    if (auto prepared = dancer.prepare(library, skeleton, on.seed, motion::Dynamics::off);
        !prepared) {
        return fail(prepared.error());
    }
    using Kind = motion::DancerCommand::Kind;
    // Chosen and locked before the first hop: the dancer begins with this figure and repeats it.
    dancer.command({Kind::select_figure, {}, static_cast<double>(on.figure)});
    dancer.command({Kind::lock_figure, {}, 1.0});
    const auto track = std::make_unique<motion::PoseTrack>();
    std::vector<motion::Pose> poses;
    std::optional<double> count_one;  // beat of the music
    // Hops run until the last pose is taken.
    for (HopIndex hop = 0; poses.size() < beats.size(); ++hop) {
        const MusicState state = steady_music(hop, on);
        dancer.advance(state, *track);
        const double now = state.grid.beats_at(state.time).count();
        if (!count_one && now > kBeatsBefore) {
            count_one = next_count_one(dancer.status(), now);
        }
        // Beats count from count_one; poses are taken once their time has been danced.
        const auto next = [&] {
            return state.grid.time_of(Beats(*count_one + beats[poses.size()]));
        };
        while (count_one && poses.size() < beats.size() && next() <= state.time) {
            poses.push_back(track->at(next()));
        }
    }
    return poses;
}

Expected<std::vector<DancedWrittenFigure>> danced_written_figures(
    const std::string& dance,
    const std::shared_ptr<const motion::DanceLibrary>& library,
    const motion::Skeleton& skeleton,
    std::uint64_t seed) {
    const auto path =
        data_path(std::filesystem::path("config") / "choreographies" / (dance + ".toml"));
    // Only dances with a file in config/choreographies were written.
    std::vector<DancedWrittenFigure> figures;
    if (!path) {
        return figures;
    }
    const auto written = motion::load_authored_dance(*path);
    if (!written) {
        return fail(written.error());
    }
    for (const motion::AuthoredFigure& figure : written->figures) {
        auto measures = measure_alone(*written, figure, library, skeleton, seed);
        if (!measures) {
            return fail(measures.error());
        }
        // Both kinds of faults are reported: expectations of the file, and poses that no body
        // takes.
        motion::AuthoredFigure expected = figure;
        // A head that stays where it is has no way that hands could trail.
        if (library->still_part(figure.name) != motion::StillPart::nothing) {
            expected.expectation.hand_delay.reset();
        }
        std::vector<std::string> faults = faults_in_measures(*written, expected, *measures);
        for (std::string& fault : faults_in_poses(*written, figure, *measures)) {
            faults.push_back(std::move(fault));
        }
        figures.push_back({figure.name, std::move(*measures), std::move(faults)});
    }
    return figures;
}

}  // namespace raks::engine
