// What raks-train and the program raks-soundfont say to one another, over a stream socket: one
// piece, and its samples. Both are of the same build; raks-train trusts nothing that comes back.
#pragma once

#include <cstdint>
#include <type_traits>
#include <vector>

#include "audio/music/instruments/soundfont_band.hpp"
#include "base/expected.hpp"
#include "base/talking_child.hpp"

namespace raks::audio {

/// The descriptor of raks-soundfont: its end of the socket. Its arguments are the soundfonts.
inline constexpr int kSoundfontSocket = 3;

/// What is to be played; `notes` times a PlayedNote follow.
struct SoundfontPiece {
    std::uint32_t magic = 0x52530001;  ///< other builds have another one
    std::uint32_t has_band = 0;        ///< 0: the first soundfont plays everything
    std::uint64_t notes = 0;
    double seconds = 0.0;
    PlayerRoom room;
    PlayerBand band;
};

static_assert(std::is_trivially_copyable_v<SoundfontPiece>);

/// The answer; as many samples as the piece has follow or, of a soundfont that cannot be loaded,
/// the words of `words` bytes.
struct SoundfontAnswer {
    std::uint32_t magic = 0x52530002;  ///< other builds have another one
    std::uint32_t is_good = 0;         ///< 0 or 1
    std::uint32_t words = 0;           ///< at most kMostSoundfontWords
};

inline constexpr std::uint32_t kMostSoundfontWords = 1000;

/// Takes the answer. Good: `samples`, which has room for those of the piece, holds them, all
/// finite, or why there are none. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_played(int socket,
                                  TalkDeadline deadline,
                                  Expected<std::vector<float>>& samples);

}  // namespace raks::audio
