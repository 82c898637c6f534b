#include "engine/live/sound_tap.hpp"

#include <algorithm>
#include <cstring>

#include "base/assert.hpp"

namespace raks::engine {
namespace {

// Two seconds of stereo at 192 kHz, or eight at 48.
constexpr std::size_t kRoom{768'000};

}  // namespace

SoundTap::SoundTap() : ring_(kRoom) {}

// Head and samples are written at once: the reader sees a whole piece, or none.
void SoundTap::put(StreamTime begins,
                   SampleRate rate,
                   std::span<const float> interleaved,
                   std::size_t channels) noexcept RAKS_NONBLOCKING {
    const std::size_t frames = std::min(interleaved.size() / channels, kMostFrames);
    const Head head{begins.time_since_epoch().count(),
                    source_.load(std::memory_order_relaxed),  // a number by itself
                    rate.hertz(),
                    static_cast<std::uint32_t>(frames),
                    0};
    std::memcpy(filled_.data(), &head, sizeof head);
    for (std::size_t i = 0; i < frames; ++i) {
        const float* const frame = &interleaved[i * channels];
        filled_[kHead + 2 * i] = frame[0];
        filled_[kHead + 2 * i + 1] = frame[channels > 1 ? 1 : 0];
    }
    const std::span<const float> piece = std::span(filled_).first(kHead + 2 * frames);
    if (ring_.writable() >= piece.size()) {
        ring_.write(piece);
    } else {
        dropped_.fetch_add(frames, std::memory_order_relaxed);  // relaxed: a statistic
    }
}

bool SoundTap::take(Piece& piece) {
    std::array<float, kHead> bytes{};
    if (ring_.read(bytes) < kHead) {
        return false;
    }
    Head head{};
    std::memcpy(&head, bytes.data(), sizeof head);
    piece.source = head.source;
    piece.begins = StreamTime(Nanos(head.begins_ns));
    piece.rate = head.rate;
    piece.stereo.resize(2 * std::size_t{head.frames});
    ring_.read(piece.stereo);
    return true;
}

}  // namespace raks::engine
