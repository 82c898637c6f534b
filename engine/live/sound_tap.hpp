#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/channels/audio_ring.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// The sound that is danced to, in stereo, on its way from the audio thread to one reader who keeps
/// it. What the reader is too slow for is dropped whole and counted.
///
/// Threads: what is marked *audio* and *reader* from that one alone. Real-time: put().
class SoundTap {
 public:
    /// Frames that are put at once, at most.
    static constexpr std::size_t kMostFrames = 512;

    /// Sound without a hole.
    struct Piece {
        std::uint32_t source = 0;   ///< of set_source(), when it was put
        StreamTime begins{};        ///< when its first frame sounds, in the stream of its source
        std::int32_t rate = 0;      ///< frames a second
        std::vector<float> stereo;  ///< interleaved
    };

    SoundTap();

    /// What is put from now on is of another stream. Threads: main.
    void set_source(std::uint32_t number) noexcept { source_.store(number); }

    /// *audio* Up to kMostFrames frames of 1 or more channels, of which two are kept.
    void put(StreamTime begins,
             SampleRate rate,
             std::span<const float> interleaved,
             std::size_t channels) noexcept RAKS_NONBLOCKING;

    /// *reader* The next piece; false: there is none.
    [[nodiscard]] bool take(Piece& piece);
    /// Frames that were dropped so far. Threads: any.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 private:
    // What stands before the samples of a piece, in so many samples of the ring.
    struct Head {
        std::int64_t begins_ns;
        std::uint32_t source;
        std::int32_t rate;
        std::uint32_t frames;
        std::uint32_t unused;
    };
    static constexpr std::size_t kHead = sizeof(Head) / sizeof(float);

    AudioRing ring_;
    std::atomic<std::uint32_t> source_{0};
    std::array<float, kHead + 2 * kMostFrames> filled_{};  // audio thread's
    std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace raks::engine
