#include "audio/io/downmix.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/assert.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kMostWeighted = 8;  // more channels have no known order
constexpr float kMinus3dB = 0.70710678F;  // 1 / sqrt(2)

// Factor of each channel on each side.
struct Weights {
    std::array<float, kMostWeighted> left{};
    std::array<float, kMostWeighted> right{};
};

// Weights of 3 to 8 channels. Three are left, right, centre; four are left, right, back left, back
// right; five have a centre, too; from six on the low channel follows the centre.
Weights weights_of(std::size_t channels) noexcept {
    Weights weights;
    weights.left[0] = 1.0F;
    weights.right[1] = 1.0F;
    const bool has_centre = channels != 4;
    if (has_centre) {
        weights.left[2] = kMinus3dB;
        weights.right[2] = kMinus3dB;
    }
    const std::size_t first_surround = channels == 4 ? 2 : (channels == 5 ? 3 : 4);
    for (std::size_t i = first_surround; i < channels; ++i) {
        const bool is_left = (i - first_surround) % 2 == 0;
        // The odd one of seven is the back centre.
        const bool is_alone = channels == 7 && i == 6;
        weights.left[i] = is_alone ? 0.5F : (is_left ? kMinus3dB : 0.0F);
        weights.right[i] = is_alone ? 0.5F : (is_left ? 0.0F : kMinus3dB);
    }
    // Both sides have the same sum; divided by it, equal full-scale channels give full scale.
    float sum = 0.0F;
    for (const float weight : weights.left) {
        sum += weight;
    }
    for (std::size_t i = 0; i < kMostWeighted; ++i) {
        weights.left[i] /= sum;
        weights.right[i] /= sum;
    }
    return weights;
}

// One stereo frame.
struct Sides {
    float left;
    float right;
};

// One frame of 3 to 8 channels.
Sides mix_weighted(const float* frame, std::size_t channels, const Weights& weights) noexcept {
    Sides sides{0.0F, 0.0F};
    for (std::size_t i = 0; i < channels; ++i) {
        // A channel without weight must not bring its NaN along.
        sides.left += weights.left[i] != 0.0F ? weights.left[i] * frame[i] : 0.0F;
        sides.right += weights.right[i] != 0.0F ? weights.right[i] * frame[i] : 0.0F;
    }
    return sides;
}

// One frame of more than eight channels: each side is the mean of its channels.
Sides mix_alternating(const float* frame, std::size_t channels) noexcept {
    Sides sides{0.0F, 0.0F};
    for (std::size_t i = 0; i < channels; ++i) {
        (i % 2 == 0 ? sides.left : sides.right) += frame[i];
    }
    const std::size_t rights = channels / 2;
    const std::size_t lefts = channels - rights;
    return {sides.left / static_cast<float>(lefts), sides.right / static_cast<float>(rights)};
}

// Calls store(frame number, Sides) for each frame; weights are computed once a block.
template <typename Store>
void for_each_frame(std::span<const float> interleaved,
                    std::size_t channels,
                    const Store& store) noexcept {
    const std::size_t frames = interleaved.size() / channels;
    const Weights weights =
        channels > 2 && channels <= kMostWeighted ? weights_of(channels) : Weights{};
    for (std::size_t i = 0; i < frames; ++i) {
        const float* frame = interleaved.data() + i * channels;
        if (channels <= 2) {
            store(i, Sides{frame[0], frame[channels - 1]});
        } else if (channels <= kMostWeighted) {
            store(i, mix_weighted(frame, channels, weights));
        } else {
            store(i, mix_alternating(frame, channels));
        }
    }
}

}  // namespace

void downmix_to_stereo(std::span<const float> interleaved,
                       std::size_t channels,
                       std::span<float> stereo) noexcept {
    RAKS_ASSERT(channels >= 1 && stereo.size() / 2 >= interleaved.size() / channels);
    for_each_frame(interleaved, channels, [stereo](std::size_t i, Sides sides) noexcept {
        stereo[2 * i] = sides.left;
        stereo[2 * i + 1] = sides.right;
    });
}

void downmix_to_mono(std::span<const float> interleaved,
                     std::size_t channels,
                     std::span<float> mono) noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(channels >= 1 && mono.size() >= interleaved.size() / channels);
    if (channels == 1) {
        std::copy(interleaved.begin(), interleaved.end(), mono.begin());
        return;
    }
    for_each_frame(interleaved, channels, [mono](std::size_t i, Sides sides) noexcept {
        mono[i] = 0.5F * (sides.left + sides.right);
    });
}

}  // namespace raks::audio
