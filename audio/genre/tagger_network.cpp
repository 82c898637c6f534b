#include "audio/genre/tagger_network.hpp"

#include <algorithm>
#include <cstring>

#include "base/assert.hpp"
#include "base/simd_lanes.hpp"
#include "models/dense_product.hpp"
#include "models/fast_log.hpp"

namespace raks::audio {
namespace {

// A row holds one band or channel over time. Before and behind the patch lie as many zeros as the
// longest filter reaches; the lanes behind the patch's last frame, up to whole groups, are zeros as
// well.
constexpr std::size_t kLead = 64;
constexpr std::size_t kStride = 320;
// Frames whose sums are made together: six registers of eight lanes, so that a weight is loaded
// once for all of them and no sum waits for the one before.
constexpr std::size_t kVectors = 6;
constexpr std::size_t kGroup = kVectors * kLanes;
constexpr std::size_t kGroups = (kTagFrames + kGroup - 1) / kGroup;
static_assert(kLead + kGroups * kGroup + 64 <= kStride);
constexpr std::size_t kTimeTaps = 8;     // a long filter is taken as rows of so many taps
constexpr std::size_t kMiddleTaps = 7;   // of all others
constexpr std::size_t kMiddleReach = 3;  // frames before that these cover
constexpr std::size_t kFirstRow = TaggerNetwork::kFront;  // in features_
constexpr std::size_t kSecondRow = kFirstRow + TaggerNetwork::kFirstLive;
constexpr std::size_t kThirdRow = kSecondRow + TaggerNetwork::kMiddle;
constexpr std::size_t kRows = kThirdRow + TaggerNetwork::kMiddle;
static_assert(2 * kRows == TaggerNetwork::kPooled);

// Sums side by side: every lane is added up by itself and in the same order.
using Sums = std::array<float, kGroup>;

// sums += over rows r and taps t of weights[r][t] x input[r stride + t + lane].
template <std::size_t kTaps>
RAKS_LANES_INLINE void add_filter(const float* input,
                                  std::size_t rows,
                                  std::size_t stride,
                                  const float* weights,
                                  Sums& sums) noexcept {
    Lanes sum[kVectors];  // NOLINT: a std::array does not stay in registers
    std::memcpy(&sum, sums.data(), sizeof sum);
    for (std::size_t row = 0; row < rows; ++row) {
#pragma GCC unroll 8
        for (std::size_t tap = 0; tap < kTaps; ++tap) {
            const float weight = weights[tap];
#pragma GCC unroll 8
            for (std::size_t i = 0; i < kVectors; ++i) {
                sum[i] += lanes_at(input + tap + i * kLanes) * weight;
            }
        }
        input += stride;
        weights += kTaps;
    }
    std::memcpy(sums.data(), &sum, sizeof sum);
}

// Rectifies, scales and shifts; keeps what is largest so far.
inline void keep_largest(const Sums& sums, float scale, float shift, float* largest) noexcept {
    for (std::size_t i = 0; i < kGroup; ++i) {
        const float rectified = sums[i] > 0.0F ? sums[i] : 0.0F;
        const float value = rectified * scale + shift;
        largest[i] = largest[i] > value ? largest[i] : value;
    }
}

// One convolution over the bands: of each filter and frame the largest over all places of the
// filter. `reach`: frames before that a filter covers. `row_stride`: from a filter's row to the
// next.
template <std::size_t kTaps>
[[gnu::always_inline]] inline void convolve_bands(const TaggerNetwork::Convolution& layer,
                                                  const float* bands,
                                                  std::size_t places,
                                                  std::size_t reach,
                                                  std::size_t rows,
                                                  std::size_t row_stride,
                                                  float* features) noexcept {
    for (std::size_t group = 0; group < kGroups; ++group) {
        const std::size_t at = kLead + group * kGroup;
        for (std::size_t filter = 0; filter < layer.filters; ++filter) {
            std::fill_n(features + filter * kStride + at, kGroup, -1e30F);
        }
        for (std::size_t place = 0; place < places; ++place) {
            for (std::size_t filter = 0; filter < layer.filters; ++filter) {
                Sums sums;  // NOLINT: filled at once
                sums.fill(layer.bias[filter]);
                add_filter<kTaps>(bands + place * kStride + at - reach,
                                  rows,
                                  row_stride,
                                  layer.weights.data() + filter * rows * kTaps,
                                  sums);
                keep_largest(sums,
                             layer.scale[filter],
                             layer.shift[filter],
                             features + filter * kStride + at);
            }
        }
    }
}

RAKS_SIMD_CLONES void convolve_timbre(const TaggerNetwork::Convolution& layer,
                                      const float* bands,
                                      float* features) noexcept {
    convolve_bands<kMiddleTaps>(
        layer, bands, kTagBands - layer.rows + 1, kMiddleReach, layer.rows, kStride, features);
}

// A filter of n frames, n even, reaches (n - 1) / 2 frames before. `taps_a_row`: kTimeTaps; a
// stride that the compiler knew would tempt it to keep the rows' common samples in registers, of
// which there are too few.
RAKS_SIMD_CLONES void convolve_time(const TaggerNetwork::Convolution& layer,
                                    const float* bands,
                                    std::size_t taps_a_row,
                                    float* features) noexcept {
    convolve_bands<kTimeTaps>(layer,
                              bands,
                              kTagBands,
                              (layer.taps - 1) / 2,
                              layer.taps / kTimeTaps,
                              taps_a_row,
                              features);
}

// What a filter's sum starts from in each frame: its bias, and what dead channels add where they
// lie inside the patch.
void start_sums(const TaggerNetwork::Convolution& layer,
                std::size_t filter,
                std::size_t first_frame,
                Sums& sums) noexcept {
    for (std::size_t i = 0; i < kGroup; ++i) {
        const std::size_t frame = first_frame + i;
        float sum = 0.0F;
        for (std::size_t tap = 0; tap < kMiddleTaps; ++tap) {
            const bool is_inside =
                frame + tap >= kMiddleReach && frame + tap < kTagFrames + kMiddleReach;
            sum += is_inside ? layer.dead[tap * layer.filters + filter] : 0.0F;
        }
        sums[i] = sum + layer.bias[filter];
    }
}

// One convolution over all channels.
RAKS_SIMD_CLONES void convolve_channels(const TaggerNetwork::Convolution& layer,
                                        const float* channels,
                                        float* out) noexcept {
    for (std::size_t filter = 0; filter < layer.filters; ++filter) {
        for (std::size_t group = 0; group < kGroups; ++group) {
            const std::size_t at = kLead + group * kGroup;
            Sums sums;  // NOLINT: filled at once
            start_sums(layer, filter, group * kGroup, sums);
            add_filter<kMiddleTaps>(channels + at - kMiddleReach,
                                    layer.rows,
                                    kStride,
                                    layer.weights.data() + filter * layer.rows * kMiddleTaps,
                                    sums);
            float* const to = out + filter * kStride + at;
            std::fill_n(to, kGroup, -1e30F);
            keep_largest(sums, layer.scale[filter], layer.shift[filter], to);
        }
    }
}

// Beyond the patch's ends every channel is zero, whatever the filters made of zeros.
void clear_behind(float* rows, std::size_t count) noexcept {
    for (std::size_t row = 0; row < count; ++row) {
        float* const begin = rows + row * kStride + kLead + kTagFrames;
        std::fill_n(begin, kStride - kLead - kTagFrames, 0.0F);
    }
}

// log10(1 + 10000 x).
RAKS_SIMD_CLONES void compress(float* __restrict values, std::size_t count) noexcept {
    constexpr float kLog10OfE = 0.434294482F;
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = kLog10OfE * models::fast_log(1.0F + 10'000.0F * values[i]);
    }
}

}  // namespace

void compress_mel(std::span<float> values) noexcept RAKS_NONBLOCKING {
    compress(values.data(), values.size());
}

TaggerRun::TaggerRun()
    : bands_(kTagBands * kStride),
      features_(kRows * kStride),
      live_(TaggerNetwork::kMiddle * kStride) {}

// A layer's live filters, in live_, are added to their rows of the middle.
void TaggerRun::add_places(const TaggerNetwork& network, std::size_t layer) noexcept {
    const std::size_t row = layer < 2 ? kSecondRow : kThirdRow;
    const TaggerNetwork::Places& places = network.places[layer];
    for (std::size_t filter = 0; filter < places.size(); ++filter) {
        const float* const from = live_.data() + filter * kStride + kLead;
        float* const to = features_.data() + (row + places[filter]) * kStride + kLead;
        for (std::size_t frame = 0; frame < kTagFrames; ++frame) {
            to[frame] += from[frame];
        }
    }
}

void TaggerRun::compute(const TaggerNetwork& network,
                        std::span<const float, kTagFrames * kTagBands> mel) noexcept
    RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    for (std::size_t band = 0; band < kTagBands; ++band) {
        float* const row = bands_.data() + band * kStride + kLead;
        for (std::size_t frame = 0; frame < kTagFrames; ++frame) {
            row[frame] = mel[frame * kTagBands + band] * network.input_scale + network.input_shift;
        }
    }
    // The front.
    float* feature = features_.data();
    for (const TaggerNetwork::Convolution& layer : network.timbre) {
        convolve_timbre(layer, bands_.data(), feature);
        feature += layer.filters * kStride;
    }
    for (const TaggerNetwork::Convolution& layer : network.times) {
        convolve_time(layer, bands_.data(), kTimeTaps, feature);
        feature += layer.filters * kStride;
    }
    clear_behind(features_.data(), TaggerNetwork::kFront);
    // The middle: the second and third layer are added to what goes in.
    float* const first = features_.data() + kFirstRow * kStride;
    float* const second = features_.data() + kSecondRow * kStride;
    float* const third = features_.data() + kThirdRow * kStride;
    convolve_channels(network.middle[0], features_.data(), first);
    clear_behind(first, TaggerNetwork::kFirstLive);
    for (std::size_t i = 0; i < TaggerNetwork::kMiddle; ++i) {
        std::fill_n(second + i * kStride + kLead,
                    kTagFrames,
                    network.constants[0][i] + network.constants[1][i]);
    }
    std::copy_n(first, TaggerNetwork::kFirstLive * kStride, live_.data());
    add_places(network, 0);
    convolve_channels(network.middle[1], first, live_.data());
    add_places(network, 1);
    for (std::size_t i = 0; i < TaggerNetwork::kMiddle; ++i) {
        for (std::size_t frame = 0; frame < kTagFrames; ++frame) {
            const std::size_t at = i * kStride + kLead + frame;
            third[at] = second[at] + network.constants[2][i];
        }
    }
    convolve_channels(network.middle[2], second, live_.data());
    add_places(network, 2);
    // Largest and mean over the patch of each row in turn.
    std::array<float, TaggerNetwork::kPooled> pooled{};
    for (std::size_t row = 0; row < kRows; ++row) {
        const std::span<const float> frames(features_.data() + row * kStride + kLead, kTagFrames);
        float sum = 0.0F;
        float largest = frames.front();
        for (const float value : frames) {
            sum += value;
            largest = std::max(largest, value);
        }
        pooled[2 * row] = largest;
        pooled[2 * row + 1] = sum / static_cast<float>(kTagFrames);
    }
    std::copy_n(network.dense_bias.data(), kTagFeatures, embedding_.begin());
    models::add_product(
        pooled.data(), pooled.size(), network.dense.data(), kTagFeatures, embedding_.data());
    for (std::size_t i = 0; i < kTagFeatures; ++i) {
        embedding_[i] =
            std::max(0.0F, embedding_[i]) * network.embedding_scale[i] + network.embedding_shift[i];
    }
    std::copy_n(network.tags_bias.data(), kTags, logits_.begin());
    models::add_product(
        embedding_.data(), kTagFeatures, network.tags.data(), kTags, logits_.data());
}

}  // namespace raks::audio
