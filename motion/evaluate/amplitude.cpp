#include "motion/evaluate/amplitude.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/evaluate/place_series.hpp"

namespace raks::motion {
namespace {

// Largest horizontal distance of any two places.
double widest(const Places& places) {
    double widest = 0.0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            widest =
                std::max(widest, std::hypot(places[i].x - places[k].x, places[i].z - places[k].z));
        }
    }
    return widest;
}

// The places of the counted frames in [first, last).
Places counted_places(const Places& places,
                      std::size_t first,
                      std::size_t last,
                      const MetricFrames& frames) {
    Places counted;
    for (std::size_t f = first; f < last; ++f) {
        if (frames.is_counted(f)) {
            counted.push_back(places[f]);
        }
    }
    return counted;
}

// Highest speed of the counted frames; filtered first, as differences amplify noise.
double peak_speed(const Places& places,
                  double frames_per_second,
                  std::size_t first,
                  std::size_t last,
                  const MetricFrames& frames) {
    const std::vector<double> speed = speeds(smoothed(places), frames_per_second);
    double highest = 0.0;
    for (std::size_t f = first; f < last; ++f) {
        if (frames.is_counted(f)) {
            highest = std::max(highest, speed[f] / frames.pace_at(f));
        }
    }
    return highest;
}

}  // namespace

Amplitude amplitude_of(const BodyTrack& track,
                       std::size_t first,
                       std::size_t last,
                       const MetricFrames& frames) {
    Amplitude amplitude;
    amplitude.hips_travel = widest(counted_places(joint_places(track, kHips), first, last, frames));
    // Keeps the larger of both feet.
    const auto raise = [](double& highest, double value) { highest = std::max(highest, value); };
    // Of the stretch, divided by the pace frame by frame.
    const auto peak = [&](const Places& places) {
        return peak_speed(places, track.frames_per_second, first, last, frames);
    };
    for (const Side side : kSides) {
        const Places toe = toe_places(track, side);
        raise(amplitude.toe_travel, widest(counted_places(toe, first, last, frames)));
        raise(amplitude.peak_toe_speed, peak(toe));
        raise(amplitude.peak_ball_speed, peak(foot_places(track, side, kBall)));
    }
    return amplitude;
}

double peak_toe_speed(const BodyTrack& track, const MetricFrames& frames) {
    const auto peak = [&](Side side) {
        return peak_speed(
            toe_places(track, side), track.frames_per_second, 0, track.frames(), frames);
    };
    return std::max(peak(Side::left), peak(Side::right));
}

}  // namespace raks::motion
