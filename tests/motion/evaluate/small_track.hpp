#pragma once

#include <cstddef>

#include "motion/evaluate/body_track.hpp"

namespace raks::motion::test {

/// A body whose 19 joints and feet all lie at the origin.
inline BodyTrack resting_track(std::size_t frames, double frames_per_second = 60.0) {
    BodyTrack track;
    track.frames_per_second = frames_per_second;
    track.joints.resize(frames);
    track.feet.resize(frames);
    return track;
}

}  // namespace raks::motion::test
