#include "engine/show/clip_transport.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr double kFarStep = 10.0;       // frames
constexpr std::size_t kMostDigits = 9;  // a clip has at most 10 million frames

}  // namespace

ClipTransport::ClipTransport(std::size_t frame_count, double frames_per_second)
    : frame_count_(frame_count), frames_per_second_(frames_per_second) {}

ClipTransport::ClipTransport(std::size_t frame_count, double frames_per_second, std::size_t frame)
    : ClipTransport(frame_count, frames_per_second) {
    stand_at(static_cast<double>(frame));
}

void ClipTransport::advance(double seconds) {
    if (!is_paused_) {
        position_ = std::fmod(position_ + std::max(seconds, 0.0) * frames_per_second_,
                              static_cast<double>(frame_count_));
    }
}

std::size_t ClipTransport::frame() const noexcept {
    return std::min(static_cast<std::size_t>(position_), frame_count_ - 1);
}

void ClipTransport::stand_at(double frame) {
    position_ = std::clamp(frame, 0.0, static_cast<double>(frame_count_ - 1));
    is_paused_ = true;
}

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
    if (event.has_control) {
        return false;
    }
    if (type(event.key)) {
        return true;
    }
    const double step = event.has_shift ? kFarStep : 1.0;
    const auto shown = static_cast<double>(frame());
    switch (event.key) {
        case Key::space:
            is_paused_ = event.is_repeat ? is_paused_ : !is_paused_;
            return true;
        case Key::left:
            stand_at(shown - step);
            return true;
        case Key::right:
            stand_at(shown + step);
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

std::string ClipTransport::status() const {
    std::string line = fmt::format("frame {} of {}   {:.2f} s",
                                   frame(),
                                   frame_count_,
                                   static_cast<double>(frame()) / frames_per_second_);
    line += is_paused_ ? "   paused" : "";
    line += typed_.empty() ? "" : "   go to " + typed_ + "_";
    return line;
}

}  // namespace raks::engine
