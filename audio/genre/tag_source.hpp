#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "audio/genre/tagger_network.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::audio {

/// What the music tagger says of a patch, and of all patches of this music so far.
struct TaggerWord {
    std::uint32_t patches = 0;                    ///< of this music so far; 0: nothing is said yet
    StreamTime until{};                           ///< end of the newest one
    std::array<float, kTagFeatures> embedding{};  ///< of the newest one
    std::array<float, kTags> logits{};            ///< of the newest one, before the sigmoid
    std::array<float, kTags> mean_logits{};       ///< of all of them
};

/// Numbers of the strongest words by their mean, the strongest first, of two alike the first; in
/// kTagNames. Real-time: yes.
[[nodiscard]] std::array<std::size_t, 3> strongest_tags(const TaggerWord& word) noexcept
    RAKS_NONBLOCKING;

/// One hop of sound for the tagger.
struct TaggerHop {
    static constexpr std::size_t kSamples = 160;  ///< 10 ms at 16 kHz
    HopIndex hop = 0;                             ///< after a gap it is not the one before plus 1
    bool is_other_music = false;                  ///< a jump: what was heard before is forgotten
    std::array<float, kSamples> samples{};        ///< nominally in [-1, 1]
};

/// Who is given each hop and has the tagger's newest word: the tagger itself, at once, or a thread
/// that hears in its own time (engine/live/tagger_thread.hpp).
/// Threads: one. Real-time: yes, where the implementation says so.
class TagSource {
 public:
    virtual ~TagSource() = default;
    /// Takes the next hop.
    virtual void hear(const TaggerHop& hop) noexcept RAKS_NONBLOCKING = 0;
    /// The newest word; it holds until the next call of any of these.
    [[nodiscard]] virtual const TaggerWord& word() noexcept RAKS_NONBLOCKING = 0;
};

}  // namespace raks::audio
