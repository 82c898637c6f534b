#include "training/discovery/repeat_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/statistics.hpp"
#include "training/discovery/danced_beats.hpp"
#include "training/discovery/first_count.hpp"
#include "training/discovery/motion_signals.hpp"
#include "training/discovery/repeat_likeness.hpp"
#include "training/discovery/repeat_period.hpp"
#include "training/discovery/repeat_segmentation.hpp"

namespace raks::motion {
namespace {

constexpr double kNoRepeats = 0.02;       // share of variance explained: less is chance
constexpr double kStretch = 9.0;          // seconds, of a clip that repeats in a part of it
constexpr double kStretchRepeats = 0.25;  // share explained in it: many stretches are tried
constexpr int kRounds = 4;                // of borders and template, until count 1 is sought
constexpr int kLastRounds = 2;            // of them after that
constexpr double kFastestTempo = 260.0;   // BPM
constexpr double kBarLine = 0.1;          // weight of repeats that begin on bar lines
constexpr double kOffBeat = 0.3;          // beats: later or earlier steps are said
constexpr double kKeepsBeat = 0.4;  // resultant of the starts' beat phases: less is another song
constexpr double kSureConfidence = 0.9;  // what training asks for

double frame_of(double row, const TrainingClip& clip) {
    return row / kSignalRate * clip.frames_per_second;
}

/// Of a dance this fast the rate is likelier wrong than the dancer that quick.
void warn_of_rate(FoundRepeats& found) {
    if (found.tempo() > kFastestTempo) {
        found.warnings.push_back(fmt::format(
            "its repeats of {} beats last {:.2f} s, {:.0f} BPM, faster than people dance: "
            "is the frame rate right? (--fps)",
            found.beats,
            found.seconds,
            found.tempo()));
    }
}

double median_length(std::span<const RepeatSpan> repeats) {
    std::vector<double> lengths;
    for (const RepeatSpan& repeat : repeats) {
        lengths.push_back(repeat.length);
    }
    return upper_median(std::move(lengths));
}

/// Borders and template in turn: each is found with the other fixed.
std::vector<RepeatSpan> refined(const FeatureTrack& track,
                                RepeatTemplate repeat,
                                double period,
                                int rounds) {
    std::vector<RepeatSpan> repeats;
    for (int round = 0; round < rounds; ++round) {
        repeats = segment_repeats(track, repeat, period);
        if (repeats.size() < 2) {
            return repeats;
        }
        repeat = template_of(track, repeats);
        period = median_length(repeats);
    }
    return repeats;
}

/// The repeats moved to begin at a phase, with the one before the first.
std::vector<RepeatSpan> moved_to(const std::vector<RepeatSpan>& repeats,
                                 double phase,
                                 std::size_t rows) {
    std::vector<RepeatSpan> moved;
    const auto add = [&](double start, double length) {
        if (start >= 0.0 && start + length <= static_cast<double>(rows)) {
            moved.push_back({start, length});
        }
    };
    const RepeatSpan& first = repeats.front();
    add(first.start - (1.0 - phase) * first.length, first.length);
    for (const RepeatSpan& repeat : repeats) {
        add(repeat.start + phase * repeat.length, repeat.length);
    }
    return moved;
}

/// The search for repeats of one clip, step by step.
class RepeatSearch {
 public:
    RepeatSearch(const TrainingClip& clip,
                 const DiscoveryOptions& options,
                 const MotionSignals& signals)
        : clip_(clip), options_(options), signals_(signals) {}

    Expected<FoundRepeats> run() {
        if (options_.music) {
            Expected<DancedBeats> beats = DancedBeats::within(*options_.music, signals_.seconds());
            if (!beats) {
                return fail(std::move(beats.error()));
            }
            beats_ = std::move(*beats);
        }
        const auto period = period_of_repeats();
        if (!period) {
            return fail(period.error());
        }
        std::vector<RepeatSpan> repeats;
        if (*period && (**period).explained >= kNoRepeats) {
            found_.explained = (**period).explained;
            repeats = refined(signals_.track,
                              folded_template(signals_.track, (**period).rows),
                              (**period).rows,
                              kRounds);
        }
        if (repeats.size() < 2) {
            repeats = repeats_of_a_stretch();
        }
        if (repeats.size() < 2) {
            return none();
        }
        count_beats(repeats);
        repeats = from_count_1(std::move(repeats));
        if (repeats.size() < 2) {
            return none();
        }
        if (auto done = put_borders(repeats); !done) {
            return fail(std::move(done.error()));
        }
        if (found_.repeats.empty()) {
            return none();
        }
        warn_of_rate(found_);
        return std::move(found_);
    }

 private:
    FoundRepeats none() {
        found_.repeats.clear();
        found_.none_because =
            "nothing in it repeats; --once learns it as a single phrase, raks train take beat by "
            "beat";
        return std::move(found_);
    }

    /// A clip of many figures may repeat in one stretch alone: the repeats like those of the
    /// stretch that repeats best.
    std::vector<RepeatSpan> repeats_of_a_stretch() {
        const FeatureTrack& track = signals_.track;
        const auto length = static_cast<std::size_t>(kStretch * kSignalRate);
        std::optional<RepeatPeriod> best;
        FeatureTrack stretch;
        for (std::size_t start = 0; start + length < track.rows(); start += length / 6) {
            const auto first =
                track.values.begin() + static_cast<std::ptrdiff_t>(start * track.columns);
            const auto count = static_cast<std::ptrdiff_t>(length * track.columns);
            const FeatureTrack part{track.columns, {first, first + count}};
            const auto period = best_period(part, search());
            if (period && period->explained > (best ? best->explained : kStretchRepeats)) {
                best = period;
                stretch = part;
            }
        }
        if (!best) {
            return {};
        }
        found_.explained = best->explained;
        const auto cycles =
            refined(stretch, folded_template(stretch, best->rows), best->rows, kRounds);
        return cycles.size() < 2
                   ? cycles
                   : refined(
                         track, template_of(stretch, cycles), median_length(cycles), kLastRounds);
    }

    /// What music allows: whole half bars.
    [[nodiscard]] PeriodSearch search() const {
        PeriodSearch search;
        if (beats_) {
            search.is_allowed = [this](double seconds) {
                return beats_->whole_beats(seconds, options_.beats, options_.beats_per_bar) > 0;
            };
        }
        return search;
    }

    /// With music only whole half bars; an error where the motion clearly repeats otherwise.
    Expected<std::optional<RepeatPeriod>> period_of_repeats() const {
        const auto any = best_period(signals_.track);
        if (!beats_) {
            return any;
        }
        const auto allowed = best_period(signals_.track, search());
        if (any && any->explained > kNoRepeats &&
            (!allowed || any->explained > 2.0 * allowed->explained + kNoRepeats)) {
            const double seconds = any->rows / kSignalRate;
            return fail(
                fmt::format("repeats every {:.2f} s, which is {:.1f} beats of {}: is it the song "
                            "that was danced to, and is --fps right?",
                            seconds,
                            seconds / beats_->interval(),
                            options_.music->name));
        }
        return allowed;
    }

    void count_beats(std::span<const RepeatSpan> repeats) {
        const double seconds = median_length(repeats) / kSignalRate;
        if (beats_) {
            found_.beats = beats_->whole_beats(seconds, options_.beats, options_.beats_per_bar);
        }
        // The median may have left what the music allows.
        if (found_.beats == 0) {
            found_.beats = options_.beats.value_or(beats_of_repeat(
                seconds, landings_of_repeat(signals_.landings, repeats), options_.beats_per_bar));
        }
    }

    std::vector<RepeatSpan> from_count_1(std::vector<RepeatSpan> repeats) {
        std::function<double(double)> bonus;
        if (beats_) {
            bonus = [&](double phase) {
                std::vector<double> starts;
                for (const RepeatSpan& repeat : repeats) {
                    starts.push_back((repeat.start + phase * repeat.length) / kSignalRate);
                }
                return kBarLine * beats_->share_on_bar_lines(starts);
            };
        }
        const auto phase =
            phase_of_count_1(signals_.landings, repeats, options_.role, found_.beats, bonus);
        if (!phase) {
            found_.warnings.emplace_back(
                "its feet do not step, so that count 1 is a guess: look at the page");
            return repeats;
        }
        const std::vector<RepeatSpan> moved = moved_to(repeats, *phase, signals_.track.rows());
        if (moved.empty()) {
            return repeats;
        }
        return refined(
            signals_.track, template_of(signals_.track, moved), median_length(moved), kLastRounds);
    }

    /// Frames of the borders: on the music's beats, where there is music.
    Expected<void> put_borders(std::span<const RepeatSpan> repeats) {
        std::vector<double> off;
        std::vector<double> lengths;
        for (const RepeatSpan& repeat : repeats) {
            FoundRepeat found{frame_of(repeat.start, clip_), frame_of(repeat.end(), clip_)};
            if (beats_) {
                const double seconds = repeat.start / kSignalRate;
                const auto on = beats_->beats_from(seconds, found_.beats);
                off.push_back(beats_->beats_after_nearest(seconds));
                if (!on) {
                    continue;
                }
                found.start = on->first * clip_.frames_per_second;
                found.end = on->second * clip_.frames_per_second;
            }
            const bool is_within =
                found.start >= 0.0 && found.end <= static_cast<double>(clip_.poses.size());
            const bool is_later =
                found_.repeats.empty() || found.start >= found_.repeats.back().end - 1e-6;
            if (is_within && is_later) {
                lengths.push_back((found.end - found.start) / clip_.frames_per_second);
                found_.repeats.push_back(found);
            }
        }
        if (lengths.empty()) {
            return {};
        }
        found_.seconds = upper_median(std::move(lengths));
        return check_music(off);
    }

    /// The starts keep one distance to the beats, or it is another song.
    Expected<void> check_music(std::span<const double> off) {
        double x = 0.0;
        double y = 0.0;
        for (const double beats : off) {
            x += std::cos(2.0 * M_PI * beats) / static_cast<double>(off.size());
            y += std::sin(2.0 * M_PI * beats) / static_cast<double>(off.size());
        }
        if (off.size() >= 4 && std::hypot(x, y) < kKeepsBeat) {
            return fail(fmt::format(
                "its repeats do not keep to the beats of {}: is it the song that was danced to?",
                options_.music->name));
        }
        const double mean = std::atan2(y, x) / (2.0 * M_PI);
        if (!off.empty() && std::abs(mean) > kOffBeat) {
            found_.warnings.push_back(
                fmt::format("its steps land {:.1f} beats {} the beats of {}; "
                            "is --offset right?",
                            std::abs(mean),
                            mean > 0.0 ? "after" : "before",
                            options_.music->name));
        }
        return {};
    }

    const TrainingClip& clip_;
    const DiscoveryOptions& options_;
    const MotionSignals& signals_;
    std::optional<DancedBeats> beats_;
    FoundRepeats found_;
};

}  // namespace

std::size_t FoundRepeats::good() const noexcept {
    return static_cast<std::size_t>(std::count_if(
        repeats.begin(), repeats.end(), [](const FoundRepeat& repeat) { return repeat.is_good; }));
}

Expected<FoundRepeats> find_repeats(const TrainingClip& clip, const DiscoveryOptions& options) {
    const MotionSignals signals = motion_signals(clip);
    if (auto sound = check_motion(clip, signals); !sound) {
        return fail(std::move(sound.error()));
    }
    return RepeatSearch(clip, options, signals).run();
}

void judge_repeats(std::span<const FoundIn> clips) {
    std::vector<ClipRepeat> all;
    std::vector<FoundRepeat*> found;
    for (const FoundIn& in : clips) {
        for (FoundRepeat& repeat : in.found->repeats) {
            all.push_back({in.clip, {repeat.start, repeat.end - repeat.start}, in.found->beats});
            found.push_back(&repeat);
        }
    }
    if (all.empty()) {
        return;
    }
    const RepeatLikeness likeness = compare_repeats(all);
    for (std::size_t i = 0; i < all.size(); ++i) {
        found[i]->distance = likeness.distance[i];
        found[i]->is_good = likeness.is_alike[i];
    }
}

std::vector<FigureLabel> labels_of(const FoundRepeats& found,
                                   const std::string& take,
                                   const std::string& figure,
                                   DanceRole role) {
    std::vector<FigureLabel> labels;
    for (const FoundRepeat& repeat : found.repeats) {
        FigureLabel label;
        label.take = take;
        label.role = role;
        label.start = static_cast<std::size_t>(std::lround(repeat.start));
        label.end = static_cast<std::size_t>(std::lround(repeat.end));
        label.figure = figure;
        label.beats = found.beats;
        // Two decimals, as they are written.
        const double share = repeat.distance / kAlikeDistance;
        const double sure = repeat.is_good ? 1.0 - (1.0 - kSureConfidence) * std::min(share, 1.0)
                                           : std::min(0.89, 0.89 / std::max(share, 1.0));
        label.confidence = std::round(100.0 * sure) / 100.0;
        labels.push_back(label);
    }
    return labels;
}

}  // namespace raks::motion
