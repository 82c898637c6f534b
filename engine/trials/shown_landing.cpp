#include "engine/trials/shown_landing.hpp"

#include <algorithm>
#include <cmath>

#include "motion/evaluate/body_track.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {
namespace {

constexpr double kShownPosesPerSecond = 60.0;
// Seconds after the start of the dance, or of its last count 1, from which landings are judged.
constexpr double kBlendIn = 4.0;
// Seconds of dancing that are needed for a judgement.
constexpr double kLeastSeconds = 10.0;

// Linear interpolation of the points (xs, ys) at x; beyond the ends the outermost segment goes on.
double interpolated(std::span<const double> xs, std::span<const double> ys, double x) {
    const auto above = std::upper_bound(xs.begin() + 1, xs.end() - 1, x);
    const auto to = static_cast<std::size_t>(above - xs.begin());
    const double share = (x - xs[to - 1]) / (xs[to] - xs[to - 1]);
    return ys[to - 1] + share * (ys[to] - ys[to - 1]);
}

}  // namespace

SoundLine::SoundLine(std::span<const AudibleBeat> heard, const audio::GeneratedMusic& music)
    // Seconds are counted from the first beat, so that doubles keep their precision.
    : origin_(heard.front().heard) {
    for (const AudibleBeat& beat : heard) {
        host_.push_back(to_seconds(beat.heard - origin_));
        stream_.push_back(to_seconds(music.beats[beat.beat].time));
    }
}

double SoundLine::stream_seconds_at(HostTime host) const {
    return interpolated(host_, stream_, to_seconds(host - origin_));
}

HostTime SoundLine::host_at(double stream_seconds) const {
    return origin_ + nanos_from_seconds(interpolated(stream_, host_, stream_seconds));
}

bool SoundLine::covers(HostTime host) const {
    const double at = to_seconds(host - origin_);
    return at >= host_.front() && at <= host_.back();
}

std::vector<double> loop_latencies_ms(std::span<const AudibleBeat> heard,
                                      const audio::GeneratedMusic& music,
                                      std::span<const ShownPicture> pictures) {
    std::vector<double> latencies;
    // The clock's line changes with the drift: each beat is dated by the line of the picture that
    // followed it.
    for (const AudibleBeat& beat : heard) {
        const auto next = std::lower_bound(
            pictures.begin(), pictures.end(), beat.heard, [](const auto& picture, HostTime time) {
                return picture.at < time;
            });
        // No picture came after this beat: its clock is not known.
        if (next == pictures.end()) {
            break;
        }
        const HostTime handed_over = next->clock.host_at(music.beats[beat.beat].time);
        latencies.push_back(1e3 * to_seconds(beat.heard - handed_over));
    }
    return latencies;
}

std::vector<double> picture_leads_ms(std::span<const ShownPicture> pictures,
                                     const SoundLine& sound) {
    std::vector<double> leads;
    for (const ShownPicture& picture : pictures) {
        if (sound.covers(picture.at)) {
            leads.push_back(1e3 *
                            (to_seconds(picture.moment) - sound.stream_seconds_at(picture.at)));
        }
    }
    return leads;
}

namespace {

// The poses that were on the screen at regular times from the first picture's on, interpolated
// between pictures.
std::vector<motion::Pose> on_regular_grid(std::span<const ShownPicture> pictures) {
    std::vector<motion::Pose> poses;
    std::size_t after = 1;
    for (std::size_t i = 0;; ++i) {
        const HostTime at =
            pictures.front().at + nanos_from_seconds(static_cast<double>(i) / kShownPosesPerSecond);
        // The first picture not before the grid time; its predecessor lies before it.
        while (after < pictures.size() && pictures[after].at < at) {
            ++after;
        }
        if (after == pictures.size()) {
            return poses;
        }
        const ShownPicture& from = pictures[after - 1];
        const ShownPicture& to = pictures[after];
        const double share = to_seconds(at - from.at) / to_seconds(to.at - from.at);
        poses.push_back(motion::interpolate(from.pose, to.pose, static_cast<float>(share)));
    }
}

// Seconds after `start` at which the beats were out, beginning with the first downbeat after
// `from`, or with the downbeat `bars_later` bars later.
std::vector<double> counts_in_sound(const audio::GeneratedMusic& music,
                                    const SoundLine& sound,
                                    HostTime start,
                                    double from,
                                    std::size_t bars_later) {
    std::vector<double> counts;
    std::size_t downbeats = 0;
    for (const audio::ReferenceBeat& beat : music.beats) {
        const HostTime heard = sound.host_at(to_seconds(beat.time));
        const double time = to_seconds(heard - start);
        // Beats outside the recording have no known host time.
        if (!sound.covers(heard)) {
            continue;
        }
        downbeats += beat.bar_position == 1 && time > from ? 1 : 0;
        if (downbeats > bars_later) {
            counts.push_back(time);
        }
    }
    return counts;
}

}  // namespace

std::optional<ShownLanding> shown_landing(std::span<const ShownPicture> pictures,
                                          const SoundLine& sound,
                                          const audio::GeneratedMusic& music,
                                          const motion::FigureModel& figure,
                                          const motion::Skeleton& skeleton) {
    // Judged from the first picture that dances on by the count that lasts.
    const auto first = std::find_if(pictures.begin(), pictures.end(), [&](const auto& picture) {
        return picture.is_dancing && picture.reanchors == pictures.back().reanchors;
    });
    if (first == pictures.end() || pictures.back().octave != 1.0 ||
        to_seconds(pictures.back().at - first->at) < kLeastSeconds) {
        return std::nullopt;
    }
    const auto danced = pictures.subspan(static_cast<std::size_t>(first - pictures.begin()));
    const motion::BodyTrack track =
        motion::body_track(skeleton, on_regular_grid(danced), kShownPosesPerSecond);
    // Both halves of the figure are tried as the first.
    const auto landing = [&](std::size_t bars_later) {
        return motion::landing_errors(
            track, figure, counts_in_sound(music, sound, first->at, kBlendIn, bars_later));
    };
    ShownLanding shown{landing(0), landing(1)};
    // The half at which fewer landings are missing is reported as the figure's first.
    if (shown.other_half.missing < shown.report.missing) {
        std::swap(shown.report, shown.other_half);
    }
    return shown;
}

}  // namespace raks::engine
