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

/// What is to be played; `notes` times a PlayedNote follow. The answer (base/talk_answer.hpp) is as
/// many samples as the piece has. The arguments of raks-soundfont are the soundfonts.
struct SoundfontPiece {
    std::uint32_t magic = 0x52530001;  ///< other builds have another one
    std::uint32_t has_band = 0;        ///< 0: the first soundfont plays everything
    std::uint64_t notes = 0;
    double seconds = 0.0;
    PlayerRoom room;
    PlayerBand band;
};

static_assert(std::is_trivially_copyable_v<SoundfontPiece>);

/// Takes the answer. Good: `samples`, which has room for those of the piece, holds them, all
/// finite, or why there are none. Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_played(int socket,
                                  TalkDeadline deadline,
                                  Expected<std::vector<float>>& samples);

}  // namespace raks::audio
