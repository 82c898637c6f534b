#pragma once

#include <string_view>

#include "base/music_state.hpp"

/// The words that reports have for what music does.
namespace raks::apps {

/// "stopped", "playing", "breakdown", "build-up".
[[nodiscard]] constexpr std::string_view name_of(MusicPart part) noexcept {
    switch (part) {
        case MusicPart::stopped:
            return "stopped";
        case MusicPart::playing:
            return "playing";
        case MusicPart::breakdown:
            return "breakdown";
        case MusicPart::build_up:
            return "build-up";
    }
    return "";
}

/// "stop", "entry", "breakdown", "build-up", "drop", "end"; "none".
[[nodiscard]] constexpr std::string_view name_of(MusicEvent::Kind kind) noexcept {
    switch (kind) {
        case MusicEvent::Kind::none:
            return "none";
        case MusicEvent::Kind::stop:
            return "stop";
        case MusicEvent::Kind::entry:
            return "entry";
        case MusicEvent::Kind::breakdown:
            return "breakdown";
        case MusicEvent::Kind::build_up:
            return "build-up";
        case MusicEvent::Kind::drop:
            return "drop";
        case MusicEvent::Kind::end:
            return "end";
    }
    return "";
}

/// "low", "middle", "high".
[[nodiscard]] constexpr std::string_view name_of(MusicAccent::Band band) noexcept {
    switch (band) {
        case MusicAccent::Band::low:
            return "low";
        case MusicAccent::Band::middle:
            return "middle";
        case MusicAccent::Band::high:
            return "high";
    }
    return "";
}

}  // namespace raks::apps
