#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/key.hpp"
#include "render/overlay/overlay.hpp"

namespace raks::engine {

/// Which frame of a clip is shown: plays in a loop at any rate, pauses, steps, jumps to a number.
/// Whatever shows something frame by frame has one: a clip, points, a model.
///
/// Keys: space pauses and goes on; left and right (or , and .) step one frame, with shift ten, and
/// pause; up and down change the rate by 0.25, with shift by 0.05, and R makes it 1 again; Home,
/// End; digits and Enter go to that frame, backspace takes a digit back, Esc all of them.
class ClipTransport {
 public:
    static constexpr double kLowestRate = -2.0;  ///< backward, twice as fast
    static constexpr double kHighestRate = 4.0;  ///< forward, four times as fast

    /// `frame_count` >= 1, `frames_per_second` > 0. With `frame` it stands there, paused.
    ClipTransport(std::size_t frame_count, double frames_per_second);
    /// The same, paused at `frame` (clamped to the clip).
    ClipTransport(std::size_t frame_count, double frames_per_second, std::size_t frame);

    /// Moves on by `seconds` of time at its rate; the frame after the last is the first.
    void advance(double seconds);
    /// Carries out a key of the list above. False: the key means nothing here (nor does Esc when no
    /// digit was typed).
    bool handle(const KeyEvent& key);
    /// Stands at a frame (clamped to the clip).
    void go_to(std::size_t frame);
    /// To a place of the clip, [0, 1]; playing or pausing as before.
    void go_to_share(double share);
    /// Pauses, goes on.
    void toggle_pause() noexcept { is_paused_ = !is_paused_; }
    /// Frames go by `rate` times as fast as in the clip; clamped to the bounds above.
    void set_rate(double rate);

    /// The frame to show, from 0.
    [[nodiscard]] std::size_t frame() const noexcept;
    /// Where it is, from the first frame on; between two frames, too.
    [[nodiscard]] double seconds() const noexcept { return position_ / frames_per_second_; }
    /// True while time does not move the frame.
    [[nodiscard]] bool is_paused() const noexcept { return is_paused_; }
    [[nodiscard]] double rate() const noexcept { return rate_; }  ///< as set_rate
    /// What the overlay shows of it; lives until the next call of anything here.
    [[nodiscard]] render::OverlayTransport picture() const;

 private:
    void stand_at(double frame);
    void step_rate(double step);
    bool type(Key key);

    std::size_t frame_count_;
    double frames_per_second_;
    double position_ = 0.0;  // frames, [0, frame_count)
    double rate_ = 1.0;
    bool is_paused_ = false;
    std::string typed_;
};

/// The rows of the help list for the keys above.
[[nodiscard]] std::vector<render::HelpRow> transport_keys();

}  // namespace raks::engine
