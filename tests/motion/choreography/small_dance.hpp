#pragma once

#include <gtest/gtest.h>

#include <string>

#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// The dance of a file's text, which must be good.
inline AuthoredDance dance_of(const std::string& text) {
    auto dance = parse_authored_dance(text, "x.toml");
    EXPECT_TRUE(dance) << dance.error().message;
    return dance ? *dance : AuthoredDance{};
}

/// A dance file in which every kind of thing is said once.
inline const std::string kSmallDance = R"(format = "raks-choreography"
version = 1
dance = "rock"
tempo = [90, 120, 150]
beats_per_bar = 4
licence = "CC0-1.0"

[style]
knee = 24
iso = 0.4

[body]
hip.y = { wave = 2, every = 1, peak = 0.5, skew = 0.3 }
arms.up = -60
arm.l.front = 45
hands.fist = 0.6

[expect]
hip_travel = [1, 60]

[[figure]]
name = "rock_step"
beats = 4
steps = [
  { foot = "l", at = 0, to = [16, 6], on = "heel", air = 0.6 },
  { foot = "r", at = 2, to = [-16, 0], on = "touch", weight = 0.2, lift = 3 } ]
body.chest.yaw = { keys = [[0, 8], [2, -8]], snap = 0.3, over = 0.1 }
body.arms.front = [ 50, { wave = 8, every = 2, peak = 0, lag = 0, vary = 0.5 } ]

[[figure]]
name = "sway"
beats = 2
mirror = true
style.knee = 30
expect.jerk = [400, 2500]
steps = [ { foot = "l", at = 0, weight = -1, land = 0.05, turn = 10 } ]
)";

/// The file with its first `what` in place of `with`.
inline std::string replaced(const std::string& what, const std::string& with) {
    std::string text = kSmallDance;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
}

}  // namespace raks::motion
