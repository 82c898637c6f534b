#include "audio/sync/track_alignment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audio/sync/coarse_alignment.hpp"
#include "audio/sync/window_peaks.hpp"

namespace raks::audio {
namespace {

constexpr const char* kNothingHeard =
    "nothing stands out that {} hears too: was there music, and do they overlap in time? Louder "
    "music, less echo or a longer take help; or set its offset by hand";
constexpr double kRoughTolerance = 0.003;  // seconds; drift is known to some 50 ppm only
constexpr double kTolerance = 0.001;       // a strong reflection is further off
// Coarse alignments with a smaller share of the best one's score are not measured.
constexpr double kWorthMeasuring = 0.25;
// In 60 simulated rooms with much reverberation the one line that followed a reflection had a share
// of 0.89, 50 right ones up to 0.72, and one 0.91.
constexpr double kMostEcho = 0.8;
// Samples between the direct sound's peak in the stack and another one.
constexpr auto kEchoApart = static_cast<std::size_t>(0.0005 * SyncTrack::kRate);
constexpr double kNearlyAsGood = 0.8;  // share of the best alignment's score

// The windows along a line, and the line through them.
struct Measured {
    std::vector<AlignmentWindow> windows;
    double echo = 0.0;  // height of the stack's second peak over that of its first; 0: none
    std::vector<std::size_t> heard;  // indices of the windows with a point
    ClockFit fit;                    // of those
    std::size_t compared = 0;
    double score = 0.0;  // sum of the heights on the line

    [[nodiscard]] double mean_score() const {
        return score / static_cast<double>(std::max<std::size_t>(compared, 1));
    }
    // The points heard that lie on the line, or off it.
    [[nodiscard]] std::vector<ClockPoint> points(bool on_line) const {
        std::vector<ClockPoint> chosen;
        for (std::size_t i = 0; i < heard.size(); ++i) {
            if (fit.is_on_line[i] == on_line) {
                chosen.push_back(*windows[heard[i]].point);
            }
        }
        return chosen;
    }
    // Whether each window lies on the line.
    [[nodiscard]] std::vector<bool> on_line() const {
        std::vector<bool> result(windows.size());
        for (std::size_t i = 0; i < heard.size(); ++i) {
            result[heard[i]] = fit.is_on_line[i];
        }
        return result;
    }
};

Measured measure(WindowPeaks& peaks, const ClockLine& line, double tolerance) {
    Measured measured;
    WindowMeasurements windows = peaks.measure(line);
    const auto stacked = highest_peaks(windows.stack, 2, kEchoApart, 0.0);
    measured.echo = stacked.size() < 2 ? 0.0 : stacked[1].height / stacked[0].height;
    measured.windows = std::move(windows.windows);
    std::vector<ClockPoint> points;
    for (std::size_t i = 0; i < measured.windows.size(); ++i) {
        const AlignmentWindow& window = measured.windows[i];
        measured.compared += window.is_tried ? 1U : 0U;
        if (window.point) {
            measured.heard.push_back(i);
            points.push_back(*window.point);
        }
    }
    measured.fit.line = line;
    measured.fit.is_on_line.resize(points.size());
    if (auto fit = fit_clock_line(points, tolerance)) {
        measured.fit = std::move(*fit);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        measured.score += measured.fit.is_on_line[i] ? points[i].height : 0.0;
    }
    return measured;
}

// What speaks against the best alignment.
struct Doubts {
    const Measured* nearly_as_good = nullptr;
    const Measured* contradicts = nullptr;  // another line holds where the best one does not
    double next_best = 0.0;                 // its share of the best one's score
};

Doubts doubts_about(const Measured& best, const std::vector<Measured>& rivals) {
    Doubts doubts;
    const auto on_best = best.on_line();
    for (const Measured& rival : rivals) {
        if (rival.fit.used < 2 || !(best.score > 0.0)) {
            continue;
        }
        doubts.next_best = std::max(doubts.next_best, rival.score / best.score);
        if (rival.mean_score() > kNearlyAsGood * best.mean_score() &&
            2 * rival.fit.used >= best.fit.used) {
            doubts.nearly_as_good = &rival;
        }
        const auto on_rival = rival.on_line();
        std::size_t against = 0;
        for (std::size_t i = 0; i < on_rival.size(); ++i) {
            against += on_rival[i] && best.windows[i].is_tried && !on_best[i] ? 1U : 0U;
        }
        if (against >= kLeastWindows) {
            doubts.contradicts = &rival;
        }
    }
    return doubts;
}

// The search of the shorter track in the longer one, and its words.
class Alignment {
 public:
    Alignment(const SyncTrack& reference, const SyncTrack& track, double most_offset)
        : reference_(reference),
          track_(track),
          is_swapped_(track.fine().size() > reference.fine().size()),
          part_(is_swapped_ ? reference : track),
          whole_(is_swapped_ ? track : reference),
          most_offset_(most_offset) {}

    [[nodiscard]] Expected<TrackAlignment> run() {
        const auto coarse = plausible(find_coarse_alignments(part_.coarse(), whole_.coarse()));
        if (coarse.empty()) {
            return refuse(kNothingHeard);
        }
        WindowPeaks peaks(part_.fine(), whole_.fine());
        std::vector<Measured> all;
        all.reserve(coarse.size());
        for (const CoarseAlignment& one : coarse) {
            all.push_back(measure(peaks, one.line, kRoughTolerance));
        }
        const auto top = std::max_element(
            all.begin(), all.end(), [](const auto& a, const auto& b) { return a.score < b.score; });
        const Measured rough = std::move(*top);
        all.erase(top);
        // Without the drift that smears them, peaks stand out more.
        const Measured best = measure(peaks, rough.fit.line, kTolerance);
        if (best.fit.used == 0) {
            return refuse(kNothingHeard);
        }
        if (best.fit.used < kLeastWindows) {
            return refuse(
                fmt::format("a sound that {{}} hears too stands out in only {} of {} "
                            "stretches of 5 s, and {} are needed: louder music, less "
                            "echo or a longer take help; or set the offset by hand",
                            best.fit.used,
                            best.compared,
                            kLeastWindows));
        }
        return judge(best, doubts_about(rough, all));
    }

 private:
    [[nodiscard]] Expected<TrackAlignment> judge(const Measured& best, const Doubts& doubts) const {
        const ClockLine line = of_track(best.fit.line);
        if (std::abs(line.drift_ppm) > kMostDriftPpm) {
            return refuse(
                fmt::format("its clock drifts by {:.0f} ppm against that of {{}}, more "
                            "than {:.0f}: was one of them filmed, or converted, at "
                            "another speed?",
                            line.drift_ppm,
                            kMostDriftPpm));
        }
        if (doubts.contradicts != nullptr) {
            return contradiction(best.fit, doubts.contradicts->fit);
        }
        const auto others = fit_clock_line(best.points(false), kTolerance);
        if (others && others->used >= kLeastWindows) {
            return contradiction(best.fit, *others);
        }
        if (doubts.nearly_as_good != nullptr) {
            return refuse(
                fmt::format("offsets of {:.3f} s and {:.3f} s against {{}} fit nearly "
                            "equally well, as the music repeats itself; set one by "
                            "hand, or clap once in the next take",
                            line.offset,
                            of_track(doubts.nearly_as_good->fit.line).offset));
        }
        if (best.echo > kMostEcho) {
            return refuse(
                "echoes of the room are as strong as the sound itself against {}, so "
                "that one could pass for the other: put it nearer to the loudspeaker, "
                "or set the offset by hand");
        }
        TrackAlignment result;
        result.line = line;
        result.used = best.fit.used;
        result.heard = best.heard.size();
        result.compared = best.compared;
        result.spread = best.fit.spread;
        const auto used = static_cast<double>(best.fit.used);
        result.confidence = used / static_cast<double>(best.heard.size()) *
                            std::clamp(2.0 * (1.0 - doubts.next_best), 0.0, 1.0) *
                            std::clamp(2.5 * (1.0 - best.echo), 0.0, 1.0) *
                            (1.0 - std::exp2(-used / 4.0));
        return result;
    }
    [[nodiscard]] Expected<TrackAlignment> contradiction(const ClockFit& best,
                                                         const ClockFit& other) const {
        return refuse(
            fmt::format("{} stretches of 5 s give an offset of {:.3f} s against {{}}, "
                        "{} others {:.3f} s: was one of them cut, or did it lose "
                        "sound? Use one piece, or set the offset by hand",
                        best.used,
                        of_track(best.line).offset,
                        other.used,
                        of_track(other.line).offset));
    }
    // Those with an offset that is allowed and a score that may matter.
    [[nodiscard]] std::vector<CoarseAlignment> plausible(std::vector<CoarseAlignment> all) const {
        std::erase_if(all, [&](const CoarseAlignment& one) {
            return std::abs(of_track(one.line).offset) > most_offset_;
        });
        const double least = all.empty() ? 0.0 : kWorthMeasuring * all.front().score;
        std::erase_if(all, [&](const CoarseAlignment& one) { return one.score < least; });
        return all;
    }
    // From the track's clock to the reference's.
    [[nodiscard]] ClockLine of_track(const ClockLine& part_to_whole) const {
        return is_swapped_ ? part_to_whole.inverse() : part_to_whole;
    }
    // `why`: with {} where the reference's name stands.
    [[nodiscard]] tl::unexpected<Error> refuse(const std::string& why) const {
        return fail(fmt::format(
            "{}: {}", track_.name(), fmt::format(fmt::runtime(why), reference_.name())));
    }

    const SyncTrack& reference_;
    const SyncTrack& track_;
    bool is_swapped_;
    const SyncTrack& part_;
    const SyncTrack& whole_;
    double most_offset_;
};

}  // namespace

Expected<TrackAlignment> align_tracks(const SyncTrack& reference,
                                      const SyncTrack& track,
                                      double most_offset) {
    return Alignment(reference, track, most_offset).run();
}

}  // namespace raks::audio
