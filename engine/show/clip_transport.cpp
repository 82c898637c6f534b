#include "engine/show/clip_transport.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

namespace raks::engine {
namespace {

// Frames that a step with Shift takes.
constexpr double kFarStep = 10.0;
// What a key changes the rate by; with Shift less.
constexpr double kRateStep = 0.25;
constexpr double kSmallRateStep = 0.05;
// A clip has at most 10 million frames; more digits would only overflow.
constexpr std::size_t kMostDigits = 9;

// Comma and full stop are what steps by a frame elsewhere.
Key named_key(Key key) {
    if (key == key_of(U',')) {
        return Key::left;
    }
    return key == key_of(U'.') ? Key::right : key;
}

}  // namespace

ClipTransport::ClipTransport(std::size_t frame_count, double frames_per_second)
    : frame_count_(frame_count), frames_per_second_(frames_per_second) {}

ClipTransport::ClipTransport(std::size_t frame_count, double frames_per_second, std::size_t frame)
    : ClipTransport(frame_count, frames_per_second) {
    stand_at(static_cast<double>(frame));
}

// The position is in frames and may lie between two of them, so that any picture rate plays the
// clip at its own speed. Backward it goes round, too.
void ClipTransport::advance(double seconds) {
    if (is_paused_) {
        return;
    }
    const auto count = static_cast<double>(frame_count_);
    position_ = std::fmod(position_ + rate_ * std::max(seconds, 0.0) * frames_per_second_, count);
    position_ += position_ < 0.0 ? count : 0.0;
}

void ClipTransport::go_to(std::size_t frame) { stand_at(static_cast<double>(frame)); }

void ClipTransport::go_to_share(double share) {
    position_ = std::clamp(share, 0.0, 1.0) * static_cast<double>(frame_count_ - 1);
}

void ClipTransport::set_rate(double rate) {
    rate_ = std::isnan(rate) ? 1.0 : std::clamp(rate, kLowestRate, kHighestRate);
}

// Steps lie on a grid and pass over 0, where nothing would move.
void ClipTransport::step_rate(double step) {
    const double stepped = std::round((rate_ + step) / std::abs(step)) * std::abs(step);
    set_rate(std::abs(stepped) < 1e-9 ? step : stepped);
}

std::size_t ClipTransport::frame() const noexcept {
    // Rounding of fmod may leave the position at the very end.
    return std::min(static_cast<std::size_t>(position_), frame_count_ - 1);
}

// Stands still at a frame: a step or a jump is made to look at it.
void ClipTransport::stand_at(double frame) {
    position_ = std::clamp(frame, 0.0, static_cast<double>(frame_count_ - 1));
    is_paused_ = true;
}

// Digits collect into a frame number; Enter goes there. True: the key belonged to the number.
bool ClipTransport::type(Key key) {
    if (key >= Key{U'0'} && key <= Key{U'9'}) {
        if (typed_.size() < kMostDigits) {
            typed_ += static_cast<char>(key);
        }
        return true;
    }
    if (typed_.empty()) {
        return false;
    }
    if (key == Key::backspace) {
        typed_.pop_back();
    } else if (key == Key::escape) {
        typed_.clear();
    } else if (key == Key::enter) {
        std::size_t wanted = 0;
        const auto read = std::from_chars(typed_.data(), typed_.data() + typed_.size(), wanted);
        // A number that does not fit is dropped, as if nothing had been typed.
        if (read.ec == std::errc()) {
            stand_at(static_cast<double>(wanted));
        }
        typed_.clear();
    } else {
        return false;
    }
    return true;
}

bool ClipTransport::handle(const KeyEvent& event) {
    // Keys with Control held belong to the window.
    if (event.has_control) {
        return false;
    }
    // Typing comes first: while digits stand there, Esc takes them back instead of ending the
    // program.
    if (type(event.key)) {
        return true;
    }
    if (event.key == key_of(U'r')) {
        set_rate(1.0);
        return true;
    }
    // Steps go from the frame that is shown, not from the position between two frames.
    const double step = event.has_shift ? kFarStep : 1.0;
    const double rate_step = event.has_shift ? kSmallRateStep : kRateStep;
    const auto shown = static_cast<double>(frame());
    switch (named_key(event.key)) {
        case Key::space:
            // A held space must not flicker between pause and play.
            is_paused_ = event.is_repeat ? is_paused_ : !is_paused_;
            return true;
        case Key::left:
            stand_at(shown - step);
            return true;
        case Key::right:
            stand_at(shown + step);
            return true;
        case Key::up:
            step_rate(rate_step);
            return true;
        case Key::down:
            step_rate(-rate_step);
            return true;
        case Key::home:
            stand_at(0.0);
            return true;
        case Key::end:
            stand_at(static_cast<double>(frame_count_ - 1));
            return true;
        default:
            return false;
    }
}

render::OverlayTransport ClipTransport::picture() const {
    render::OverlayTransport picture;
    picture.frame = frame();
    picture.frame_count = frame_count_;
    picture.frames_per_second = frames_per_second_;
    picture.rate = rate_;
    picture.is_paused = is_paused_;
    picture.typed = typed_;
    return picture;
}

std::vector<render::HelpRow> transport_keys() {
    return {{"CLIP", {"Space"}, "pause, go on"},
            {"CLIP", {"Left", "Right"}, "a frame back, on"},
            {"CLIP", {",", "."}, "a frame back, on"},
            {"CLIP", {"Shift+Left", "Shift+Right"}, "ten frames back, on"},
            {"CLIP", {"Home", "End"}, "first, last frame"},
            {"CLIP", {"0-9", "Enter"}, "go to this frame"},
            {"CLIP", {"Down", "Up"}, "slower, faster"},
            {"CLIP", {"Shift+Down", "Shift+Up"}, "in small steps"},
            {"CLIP", {"R"}, "at its own rate again"}};
}

}  // namespace raks::engine
