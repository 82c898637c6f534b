#include "engine/trials/dynamics_trial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>

#include "audio/resample/resampler.hpp"
#include "base/statistics.hpp"
#include "engine/offline/offline_driver.hpp"

namespace raks::engine {
namespace {

using audio::SectionKind;

constexpr double kLeftOut = 8.0;       // s at the start of songs: the dancer begins
constexpr double kFullFrom = 6.0;      // s: from then on the full section is measured
constexpr double kSongSeconds = 90.0;  // and its first beat at:
constexpr double kSongBegins = 2.0;
constexpr double kSteadySong = 64.0;

// Records what DancedMusic holds.
class RecordMusic final : public OfflineDriver::Sink {
 public:
    void on_hop(const PerformedHop& hop) override {
        poses.on_hop(hop);
        const double now = to_seconds(hop.music.time);
        if (!danced.danceable_from && hop.music.grid.confidence >= BeatGrid::kDanceable) {
            danced.danceable_from = now;
        }
        if (!danced.first_danced && hop.dancer.is_dancing) {
            danced.first_danced = now;
            danced.first_count =
                now - (hop.dancer.rate > 0.0 ? hop.dancer.phase / hop.dancer.rate : 0.0);
        }
        danced.hops.push_back(hop.dancer);
        if (hop.music.ahead.bar >= static_cast<int>(bars_.size())) {
            bars_.push_back({now, hop.music.ahead.repeats[0]});
        }
    }

    // What bars of parts that come again are to be compared with.
    [[nodiscard]] std::vector<motion::RepeatedBar> repeats() const {
        std::vector<motion::RepeatedBar> repeats;
        for (std::size_t bar = 0; bar + 1 < bars_.size(); ++bar) {
            const auto first = static_cast<std::size_t>(std::max(0, bars_[bar].repeats));
            if (bars_[bar].repeats >= 0 && bars_[first].begins >= kLeftOut) {
                repeats.push_back({{bars_[bar].begins, bars_[bar + 1].begins},
                                   {bars_[first].begins, bars_[first + 1].begins}});
            }
        }
        return repeats;
    }

    DancedMusic danced;
    CollectPoses poses{kTrialPosesPerSecond};

 private:
    struct HeardBar {
        double begins = 0.0;  // seconds
        int repeats = -1;
    };
    std::vector<HeardBar> bars_;  // by Foresight::bar
};

Expected<OfflineDriver> driver_for(std::span<const float> mono,
                                   SampleRate rate,
                                   const TrialCast& cast,
                                   Knowledge knowledge) {
    if (knowledge == Knowledge::live) {
        return OfflineDriver::create(rate, cast.models, cast.cast);
    }
    auto analyzer = make_song_analyzer(rate, cast.models);
    if (!analyzer) {
        return fail(std::move(analyzer.error()));
    }
    analyzer->process(mono);
    auto plan = std::make_shared<const audio::SongPlan>(analyzer->finish());
    return OfflineDriver::create(rate, std::move(plan), StreamTime{}, cast.cast);
}

// Music of the dance's own style at its likely tempo; drums where it has none.
audio::MusicPlan own_music(const DanceInfo& dance, std::uint64_t seed, double seconds) {
    audio::MusicPlan plan;
    plan.style = audio::style_from_name(dance.style).value_or(audio::Style::drums);
    plan.tempo = {{0.0, dance.likely.bpm()}};
    plan.seconds = seconds;
    plan.channels = 1;
    plan.seed = seed;
    return plan;
}

// Mean of the speeds in [from, to) seconds.
double mean_between(std::span<const double> speeds, double from, double to) {
    const auto frame = [&](double seconds) {
        return std::min(static_cast<std::size_t>(seconds * motion::kDynamicsRate), speeds.size());
    };
    double sum = 0.0;
    for (std::size_t f = frame(from); f < frame(to); ++f) {
        sum += speeds[f];
    }
    return frame(to) > frame(from) ? sum / static_cast<double>(frame(to) - frame(from)) : 0.0;
}

// Speeds in the sections of contrast_music.
MusicalityRatios ratios_of(std::span<const double> speeds,
                           const audio::GeneratedMusic& music,
                           double bar_seconds) {
    const auto from = [&](std::size_t section) { return to_seconds(music.sections[section].from); };
    const double end = to_seconds(music.sections.back().to);
    MusicalityRatios ratios;
    ratios.full = mean_between(speeds, kFullFrom, from(1));
    const auto ratio = [&](double first, double last) {
        return mean_between(speeds, first, last) / std::max(ratios.full, 1e-3);
    };
    ratios.breakdown = ratio(from(1) + 1.0, from(2));
    ratios.silence = ratio(from(2) + 0.5, from(3));
    ratios.bar_after = ratio(from(3), from(3) + bar_seconds);
    ratios.drop = ratio(from(3), from(3) + 8.0);
    ratios.end_to_2 = ratio(end, end + 2.0);
    ratios.end_to_5 = ratio(end + 2.0, end + 5.0);
    ratios.end_to_13 = ratio(end + 5.0, end + 13.0);
    return ratios;
}

// Generated music and the dance to it.
struct DancedPiece {
    audio::GeneratedMusic music;
    DancedMusic dance;

    [[nodiscard]] motion::DynamicsMeasures measures(const motion::Skeleton& skeleton,
                                                    int beats_per_bar) const {
        motion::BarBeats beats{{}, beats_per_bar};
        for (const audio::ReferenceBeat& beat : music.beats) {
            beats.times.push_back(to_seconds(beat.time));
        }
        const motion::DanceStretch stretch{kLeftOut, to_seconds(music.events.back().time)};
        return motion::measure_dynamics(
            motion::dynamics_track(skeleton, dance.poses, kTrialPosesPerSecond, stretch), beats);
    }
};

Expected<DancedPiece> dance_piece(const audio::MusicPlan& plan,
                                  const TrialCast& cast,
                                  Knowledge knowledge) {
    auto music = audio::generate(plan);
    if (!music) {
        return fail(std::move(music.error()));
    }
    auto dance = dance_to(music->mono(), music->rate, cast, knowledge);
    if (!dance) {
        return fail(std::move(dance.error()));
    }
    return DancedPiece{std::move(*music), std::move(*dance)};
}

std::vector<double> speeds_of(const DancedMusic& dance, const motion::Skeleton& skeleton) {
    return motion::body_speeds(motion::dynamics_track(skeleton, dance.poses, kTrialPosesPerSecond));
}

// How the dance begins: DynamicsResult's last two members.
void measure_beginning(const DancedPiece& piece, double bar_seconds, DynamicsResult& result) {
    if (piece.dance.first_danced && piece.dance.danceable_from) {
        result.bars_to_begin =
            (*piece.dance.first_danced - *piece.dance.danceable_from) / bar_seconds;
    }
    if (piece.dance.first_count) {
        double nearest = 1e9;
        for (const audio::ReferenceBeat& beat : piece.music.beats) {
            const double off = *piece.dance.first_count - to_seconds(beat.time);
            if (beat.bar_position == 1 && std::abs(off) < std::abs(nearest)) {
                nearest = off;
            }
        }
        result.first_count_off = nearest;
    }
}

}  // namespace

Expected<DancedMusic> dance_to(std::span<const float> mono,
                               SampleRate rate,
                               const TrialCast& cast,
                               Knowledge knowledge) {
    auto driver = driver_for(mono, rate, cast, knowledge);
    if (!driver) {
        return fail(std::move(driver.error()));
    }
    RecordMusic record;
    driver->feed(mono, record);
    driver->finish(record);
    record.danced.poses = std::move(record.poses.dancers[cast.measured]);
    record.danced.repeats = record.repeats();
    return std::move(record.danced);
}

audio::MusicPlan contrast_music(const DanceInfo& dance, std::uint64_t seed) {
    audio::MusicPlan plan = own_music(dance, seed, 0.0);
    const double beat = dance.likely.seconds_per_beat();
    const int bar = audio::beats_per_bar(plan.style);
    const auto bars = [&](double seconds) {
        return std::max(static_cast<int>(std::lround(seconds / (bar * beat))), 1) * bar;
    };
    const int stop = std::max(static_cast<int>(std::lround(2.0 / beat)), 1);
    plan.form = {{SectionKind::full, bars(20.0)},
                 {SectionKind::filtered, bars(14.0) - stop},
                 {SectionKind::stop, stop},
                 {SectionKind::drop, bars(16.0)}};
    int beats = 0;
    for (const audio::FormSection& section : plan.form) {
        beats += section.beats;
    }
    plan.seconds = beats * beat + 14.0;
    return plan;
}

audio::MusicPlan song_music(const DanceInfo& dance, std::uint64_t seed) {
    audio::MusicPlan plan = own_music(dance, seed, kSongSeconds);
    plan.first_beat_seconds = kSongBegins;
    plan.form = audio::song_form_of(plan);
    return plan;
}

Expected<DynamicsResult> run_dynamics_trial(const DanceInfo& dance,
                                            const TrialCast& cast,
                                            std::uint64_t seed,
                                            Knowledge knowledge) {
    const motion::Skeleton& skeleton = cast.skeleton();
    DynamicsResult result;
    const auto contrast = dance_piece(contrast_music(dance, seed), cast, knowledge);
    if (!contrast) {
        return fail(contrast.error());
    }
    const int bar = audio::beats_per_bar(contrast_music(dance, seed).style);
    const double bar_seconds = bar * dance.likely.seconds_per_beat();
    result.ratios = ratios_of(speeds_of(contrast->dance, skeleton), contrast->music, bar_seconds);
    const auto song = dance_piece(song_music(dance, seed), cast, knowledge);
    if (!song) {
        return fail(song.error());
    }
    result.phrased = song->measures(skeleton, bar);
    auto loudness = loudness_by_frame(song->music.mono(), song->music.rate);
    if (!loudness) {
        return fail(std::move(loudness.error()));
    }
    // Without what rings out and the silence after it, which would outweigh all else.
    loudness->resize(std::min(loudness->size(),
                              static_cast<std::size_t>(to_seconds(song->music.events.back().time) *
                                                       motion::kDynamicsRate)));
    result.follows_loudness =
        motion::loudness_correlation(speeds_of(song->dance, skeleton), *loudness);
    measure_beginning(*song, bar_seconds, result);
    const auto steady = dance_piece(own_music(dance, seed, kSteadySong), cast, knowledge);
    if (!steady) {
        return fail(steady.error());
    }
    result.steady = steady->measures(skeleton, bar);
    return result;
}

Expected<std::vector<double>> loudness_by_frame(std::span<const float> mono, SampleRate rate) {
    constexpr std::size_t kFrame = 256;  // samples
    audio::Resampler resampler;
    if (auto prepared = resampler.prepare(
            rate, SampleRate(static_cast<int>(kFrame * static_cast<int>(motion::kDynamicsRate))));
        !prepared) {
        return fail(std::move(prepared.error()));
    }
    std::vector<double> loudness;
    std::array<float, kFrame> frame{};
    std::size_t filled = 0;
    while (!mono.empty()) {
        const auto [taken, made] = resampler.process(mono, std::span(frame).subspan(filled));
        mono = mono.subspan(taken);
        filled += made;
        if (filled == kFrame) {
            double sum = 0.0;
            for (const float sample : frame) {
                sum += static_cast<double>(sample) * static_cast<double>(sample);
            }
            loudness.push_back(10.0 * std::log10(sum / kFrame + 1e-8));
            filled = 0;
        }
    }
    return loudness;
}

Expected<MusicFollowing> music_following(std::span<const float> mono,
                                         SampleRate rate,
                                         const TrialCast& cast,
                                         Knowledge knowledge) {
    const auto dance = dance_to(mono, rate, cast, knowledge);
    if (!dance) {
        return fail(dance.error());
    }
    const auto loudness = loudness_by_frame(mono, rate);
    if (!loudness) {
        return fail(loudness.error());
    }
    const std::vector<double> average = motion::gaussian_average(*loudness, 30.0);
    // As the correlation, without the first 6 s.
    std::vector<double> rest(
        average.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(360, average.size())),
        average.end());
    const motion::DynamicsTrack track =
        motion::dynamics_track(cast.skeleton(), dance->poses, kTrialPosesPerSecond);
    return MusicFollowing{motion::loudness_correlation(motion::body_speeds(track), *loudness),
                          percentile(rest, 0.95) - percentile(rest, 0.05),
                          motion::measure_repeats(track, dance->repeats)};
}

}  // namespace raks::engine
