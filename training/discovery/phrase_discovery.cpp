#include "training/discovery/phrase_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "base/statistics.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/motion_features.hpp"
#include "training/discovery/danced_beats.hpp"
#include "training/discovery/motion_signals.hpp"

namespace raks::motion {
namespace {

constexpr double kLikely = 0.05;      // a way to count that is less probable is not said
constexpr double kSameTempo = 0.04;   // of a tempo: counts so near are not told apart
constexpr double kOffTempo = 0.02;    // of a tempo that was asked for: more is said
constexpr double kBesideBeat = 0.15;  // beats that a clip may begin after, or end before, its beat
constexpr double kFastHand = 7.0;     // m/s about the chest, a few moments of a clip: no person
constexpr double kPossible = 0.01;    // a way that is less probable is never taken
constexpr double kSameOctave = 0.5;   // octaves from the others' tempo

Skeleton body_of(const TrainingClip& clip) {
    FigureModel size;
    size.source_hips_height = clip.hips_height;
    return source_body(size);
}

double beats_to_bpm(int beats, double seconds) { return 60.0 * beats / seconds; }

// The hands' speed about the chest that is exceeded in a twentieth of the time.
double hand_speed(const TrainingClip& clip, std::span<const Pose> poses, const Skeleton& body) {
    std::vector<double> speeds;
    for (std::size_t i = 0; i + 1 < poses.size(); ++i) {
        const WorldPose here = world_body(body, poses[i]);
        const WorldPose next = world_body(body, poses[i + 1]);
        for (const Bone hand : {Bone::left_hand, Bone::right_hand}) {
            const glm::vec3 moved = (next.position(hand) - next.position(Bone::chest)) -
                                    (here.position(hand) - here.position(Bone::chest));
            speeds.push_back(static_cast<double>(glm::length(moved)) * clip.frames_per_second);
        }
    }
    return speeds.empty() ? 0.0 : lower_percentile(std::move(speeds), 0.95);
}

// The ways to count that differ, each as likely, beside the others, as the likeliest about its
// tempo: a long clip has more of them about a fast tempo than about a slow one. Half and twice as
// many beats as the first are kept for agree_on_octaves, though they be unlikely.
std::vector<PhraseCount> told_apart(std::span<const PhraseCount> counts) {
    std::vector<PhraseCount> apart;
    for (const PhraseCount& count : counts) {
        const bool is_apart =
            std::none_of(apart.begin(), apart.end(), [&](const PhraseCount& other) {
                return std::abs(other.bpm / count.bpm - 1.0) < kSameTempo;
            });
        if (is_apart) {
            apart.push_back(count);
        }
    }
    const double sum =
        std::accumulate(apart.begin(), apart.end(), 0.0, [](double so_far, const PhraseCount& one) {
            return so_far + one.probability;
        });
    for (PhraseCount& count : apart) {
        count.probability /= sum;
    }
    const int beats = apart.front().beats;
    std::erase_if(apart, [beats](const PhraseCount& count) {
        const bool is_octave = 2 * count.beats == beats || count.beats == 2 * beats;
        return count.beats != beats && count.probability < (is_octave ? kPossible : kLikely);
    });
    return apart;
}

// The part of the clip that is danced, and what is said of it.
class PhraseSearch {
 public:
    PhraseSearch(const TrainingClip& clip, const DiscoveryOptions& options)
        : clip_(clip), options_(options), body_(body_of(clip)), poses_(clip.poses) {
        bridge_faults(poses_, clip.faults);
        first_ = leading_rest_poses(clip.poses, clip.frames_per_second);
    }

    Expected<FoundRepeats> run() {
        const std::span<const Pose> danced = std::span(poses_).subspan(first_);
        const double speed = hand_speed(clip_, danced, body_);
        if (speed > kFastHand) {
            found_.warnings.push_back(
                fmt::format("its hands move at {:.0f} m/s, faster than people's: is the frame rate "
                            "right ({:.6g} a second), and the unit? (--fps, --unit)",
                            speed,
                            clip_.frames_per_second));
        }
        const Expected<void> done = options_.music ? count_by_music() : count_by_motion(danced);
        if (!done) {
            return fail(done.error());
        }
        if (found_.beats < 2) {
            return fail("has less than two beats of movement");
        }
        if (first_ > 0) {
            found_.warnings.push_back(
                fmt::format("it begins with {:.2f} s of a rest pose, which is left out",
                            static_cast<double>(first_) / clip_.frames_per_second));
        }
        return std::move(found_);
    }

 private:
    [[nodiscard]] double seconds() const {
        return static_cast<double>(poses_.size() - first_) / clip_.frames_per_second;
    }

    void take(double start, double end, int beats) {
        found_.beats = beats;
        found_.seconds = end - start;
        found_.repeats = {
            {start * clip_.frames_per_second, end * clip_.frames_per_second, 0.0, true}};
    }

    void take_all(int beats) {
        const double start = static_cast<double>(first_) / clip_.frames_per_second;
        take(start, start + seconds(), beats);
    }

    Expected<void> count_by_motion(std::span<const Pose> danced) {
        if (options_.beats) {
            take_all(*options_.beats);
            return {};
        }
        if (options_.bpm) {
            const double beats = seconds() * *options_.bpm / 60.0;
            take_all(static_cast<int>(std::lround(beats)));
            const double bpm = beats_to_bpm(found_.beats, seconds());
            if (found_.beats >= 2 && std::abs(bpm / *options_.bpm - 1.0) > kOffTempo) {
                found_.warnings.push_back(fmt::format(
                    "its {:.2f} s are {:.1f} beats at {:.5g} BPM; learnt as {} beats at {:.1f} BPM",
                    seconds(),
                    beats,
                    *options_.bpm,
                    found_.beats,
                    bpm));
            }
            return {};
        }
        const std::vector<PhraseCount> counts = count_phrase(
            PhraseSignals(danced, clip_.frames_per_second, body_), options_.beats_per_bar);
        if (counts.empty()) {
            return fail(fmt::format("lasts {:.2f} s, too short to tell its tempo (--bpm, --beats)",
                                    seconds()));
        }
        take_all(counts.front().beats);
        found_.counts = told_apart(counts);
        return {};
    }

    Expected<void> count_by_music() {
        const double length = static_cast<double>(poses_.size()) / clip_.frames_per_second;
        const auto beats = DancedBeats::within(*options_.music, length);
        if (!beats) {
            return fail(beats.error());
        }
        const double slack = kBesideBeat * beats->interval();
        const double start = static_cast<double>(first_) / clip_.frames_per_second;
        const std::vector<double> inside = beats->between(start - slack, length + slack);
        if (inside.size() < 3) {
            return fail(fmt::format("has less than two beats of {}; is --offset right?",
                                    options_.music->name));
        }
        const double from = std::max(inside.front(), start);
        const double to = std::min(inside.back(), length);
        take(from, to, static_cast<int>(inside.size()) - 1);
        for (const double beat : inside) {
            found_.beat_frames.push_back(beat * clip_.frames_per_second);
        }
        if (from - start > slack || length - to > slack) {
            found_.warnings.push_back(
                fmt::format("{:.2f} s before the first beat of {} and {:.2f} s behind its last one "
                            "are left out",
                            from - start,
                            options_.music->name,
                            length - to));
        }
        return {};
    }

    const TrainingClip& clip_;
    const DiscoveryOptions& options_;
    Skeleton body_;
    std::vector<Pose> poses_;
    std::size_t first_ = 0;
    FoundRepeats found_;
};

}  // namespace

Expected<FoundRepeats> whole_phrase(const TrainingClip& clip, const DiscoveryOptions& options) {
    if (auto sound = check_motion(clip, motion_signals(clip)); !sound) {
        return fail(std::move(sound.error()));
    }
    return PhraseSearch(clip, options).run();
}

std::vector<FoundRepeats> phrase_parts(const FoundRepeats& phrase, int beats_per_bar) {
    if (phrase.beats <= kMostFigureBeats) {
        return {phrase};
    }
    const FoundRepeat& whole = phrase.repeats.front();
    const double frames = whole.end - whole.start;
    const auto frame_of = [&](int beat) {
        return phrase.beat_frames.empty() ? whole.start + frames * beat / phrase.beats
                                          : phrase.beat_frames[static_cast<std::size_t>(beat)];
    };
    const int bars = (phrase.beats + beats_per_bar - 1) / beats_per_bar;
    const int bars_a_figure = kMostFigureBeats / beats_per_bar;
    const int count = (bars + bars_a_figure - 1) / bars_a_figure;
    std::vector<FoundRepeats> parts;
    for (int i = 0; i < count; ++i) {
        const int first = bars * i / count * beats_per_bar;
        const int last = std::min(bars * (i + 1) / count * beats_per_bar, phrase.beats);
        FoundRepeats part;
        part.beats = last - first;
        part.repeats = {{frame_of(first), frame_of(last), 0.0, true}};
        part.seconds = phrase.seconds * (frame_of(last) - frame_of(first)) / frames;
        parts.push_back(std::move(part));
    }
    return parts;
}

void agree_on_octaves(const std::vector<FoundRepeats*>& phrases) {
    std::vector<double> tempi;
    for (const FoundRepeats* phrase : phrases) {
        if (!phrase->repeats.empty()) {
            tempi.push_back(phrase->tempo());
        }
    }
    if (tempi.size() < 2) {
        return;
    }
    const double common = upper_median(std::move(tempi));
    for (FoundRepeats* phrase : phrases) {
        const auto octaves = [&](double bpm) { return std::abs(std::log2(bpm / common)); };
        if (phrase->repeats.empty() || octaves(phrase->tempo()) < kSameOctave) {
            continue;
        }
        for (std::size_t i = 1; i < phrase->counts.size(); ++i) {
            const PhraseCount other = phrase->counts[i];
            if (octaves(other.bpm) < kSameOctave &&
                (other.beats == 2 * phrase->beats || 2 * other.beats == phrase->beats)) {
                std::swap(phrase->counts[0], phrase->counts[i]);
                phrase->beats = other.beats;
                break;
            }
        }
    }
}

}  // namespace raks::motion
