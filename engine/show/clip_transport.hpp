#pragma once

#include <cstddef>
#include <string>

#include "base/key.hpp"

namespace raks::engine {

/// Which frame of a clip is shown: plays in a loop, pauses, steps, jumps to a number.
///
/// Keys: space pauses and goes on; left and right step one frame (with shift ten) and pause; Home,
/// End; digits and Enter go to that frame, backspace takes a digit back, Esc all of them.
class ClipTransport {
 public:
    /// `frame_count` >= 1, `frames_per_second` > 0. With `frame` it stands there, paused.
    ClipTransport(std::size_t frame_count, double frames_per_second);
    /// The same, paused at `frame` (clamped to the clip).
    ClipTransport(std::size_t frame_count, double frames_per_second, std::size_t frame);

    /// Moves on by `seconds` of time; the frame after the last is the first.
    void advance(double seconds);
    /// Carries out a key of the list above. False: the key means nothing here (nor does Esc when no
    /// digit was typed).
    bool handle(const KeyEvent& key);

    /// The frame to show, from 0.
    [[nodiscard]] std::size_t frame() const noexcept;
    /// True while time does not move the frame.
    [[nodiscard]] bool is_paused() const noexcept { return is_paused_; }
    /// "frame 123 of 706   2.05 s   paused   go to 45_": frames count from 0.
    [[nodiscard]] std::string status() const;

 private:
    void stand_at(double frame);
    bool type(Key key);

    std::size_t frame_count_;
    double frames_per_second_;
    double position_ = 0.0;  // frames, [0, frame_count)
    bool is_paused_ = false;
    std::string typed_;
};

}  // namespace raks::engine
