// Generator: which synthesis makes a figure's motion.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace raks::motion {

/// How a figure's motion is generated from its states.
enum class Generator : std::uint8_t {
    /// The most likely trajectory, varied smoothly, with planted feet.
    trajectories,
    /// The paper's (Ofli 2008, section 5): one Gaussian draw a frame, smoothed; feet free.
    frames,
};
/// Names, in the order of Generator.
inline constexpr std::array<std::string_view, 2> kGeneratorNames = {"trajectories", "frames"};

}  // namespace raks::motion
