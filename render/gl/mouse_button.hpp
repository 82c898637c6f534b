#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "base/time.hpp"

namespace raks::render {

/// The buttons that the window reports.
enum class MouseButton : std::uint8_t { left, right, middle };

/// Which presses are the second of a double click. Pure arithmetic over HostTime, so that a test
/// can drive it. Threads: one.
class DoubleClick {
 public:
    static constexpr Nanos kMostTime = std::chrono::milliseconds(400);  ///< between both presses
    static constexpr float kMostWay = 8.0F;  ///< pixels between both, to each side

    /// A button went down at (x, y), in pixels: whether the same one did so shortly before, at the
    /// same place. A third press begins anew.
    [[nodiscard]] bool press(MouseButton button, float x, float y, HostTime at) noexcept {
        const bool is_second = last_ && last_->button == button && at - last_->at <= kMostTime &&
                               is_near(x, last_->x) && is_near(y, last_->y);
        last_ = is_second ? std::nullopt : std::optional(Press{button, x, y, at});
        return is_second;
    }

 private:
    struct Press {
        MouseButton button;
        float x;
        float y;
        HostTime at;
    };
    static bool is_near(float a, float b) noexcept {
        return a - b <= kMostWay && b - a <= kMostWay;
    }

    std::optional<Press> last_;  // a first one
};

}  // namespace raks::render
