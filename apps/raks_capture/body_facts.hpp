// Body facts: what a report says of a solved dance: lengths, feet, and what it looks like.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "motion/skeleton/motion_clip.hpp"

namespace raks::apps {

/// A bone that both sides of the body have.
struct BoneLength {
    std::string name;    ///< "upper arm"
    double left = 0.0;   ///< metres
    double right = 0.0;  ///< metres
};

/// How a foot stands. It counts as planted where the ball is at most 2 cm over its usual lowest
/// place (the 5th percentile of its height).
struct FootFacts {
    double planted = 0.0;  ///< share of the frames
    double median = 0.0;   ///< speed over the floor while planted, m/s
    double ninety = 0.0;   ///< its 90th percentile
    double lowest = 0.0;   ///< of ball and toes, over the floor; metres
};

/// A drawn bone: from one place to another, as seen along z; metres.
struct StickLine {
    double from_x = 0.0;
    double from_y = 0.0;
    double to_x = 0.0;
    double to_y = 0.0;
};

/// The body at a moment, drawn about its hips.
struct StickPicture {
    double time = 0.0;  ///< seconds from the first frame
    std::vector<StickLine> lines;
};

/// What is said of a dance.
struct BodyFacts {
    double seconds = 0.0;
    std::vector<BoneLength> lengths;
    FootFacts left;
    FootFacts right;
    std::vector<StickPicture> strip;
};

/// Measures a dance whose joints have the names of VRM's bones, as Raks writes them (in metres, y
/// up), with `pictures` moments in even steps. Nothing: the clip has no such legs.
[[nodiscard]] std::optional<BodyFacts> body_facts(const motion::MotionClip& clip,
                                                  std::size_t pictures = 12);

}  // namespace raks::apps
