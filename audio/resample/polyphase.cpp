#include "audio/resample/polyphase.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "base/simd_lanes.hpp"

namespace raks::audio {
namespace {

// As libspeexdsp at quality 5.
constexpr double kTaps = 80.0;      // at the lower rate
constexpr double kFalling = 0.922;  // -6 dB, of the lower rate's band, where the rate falls
constexpr double kRising = 0.94;    // and where it rises
constexpr double kBeta = 10.0;      // of the Kaiser window

constexpr std::size_t kMostWeights = 65'536;
constexpr std::size_t kRoom = 1024;  // input samples beside those that a row needs

// Modified Bessel function of order 0, by its series. (std::cyl_bessel_i takes 10 times as long.)
double bessel(double x) {
    double term = 1.0;
    double sum = 1.0;
    for (int k = 1; term > 1e-12 * sum; ++k) {
        const double ratio = x / (2.0 * k);
        term *= ratio * ratio;
        sum += term;
    }
    return sum;
}

// Kaiser window, 1 in the middle (x = 0), 0 beyond +-1.
double kaiser(double x) {
    static const double scale = 1.0 / bessel(kBeta);
    return std::abs(x) < 1.0 ? scale * bessel(kBeta * std::sqrt(1.0 - x * x)) : 0.0;
}

double sinc(double x) { return std::abs(x) < 1e-9 ? 1.0 : std::sin(M_PI * x) / (M_PI * x); }

// Row of an output sample that lies `fraction` of a sample behind the input sample in the middle.
// The weights of each sum to 1, so that all pass a constant alike.
void fill_row(std::span<float> row, double fraction, double cutoff) {
    const auto half = 0.5 * static_cast<double>(row.size());  // taps are even in number
    std::vector<double> weights(row.size());
    for (std::size_t i = 0; i < row.size(); ++i) {
        const double t = static_cast<double>(i) - (half - 1.0) - fraction;
        weights[i] = sinc(cutoff * t) * kaiser(t / half);
    }
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::transform(weights.begin(), weights.end(), row.begin(), [sum](double weight) {
        return static_cast<float>(weight / sum);
    });
}

// Where a run of outputs reads.
struct Walk {
    const float* buffer;
    const float* rows;
    std::size_t taps;
    std::size_t phases;
    std::size_t step;
    std::size_t at;
    std::size_t phase;
};

// The samples and the weights of one output.
struct Product {
    const float* samples;
    const float* weights;
};

// The next output's; the walk goes on to the one after it.
RAKS_LANES_INLINE Product next_product(Walk& walk, std::size_t whole, std::size_t part) noexcept {
    const Product product{walk.buffer + walk.at, walk.rows + walk.phase * walk.taps};
    walk.at += whole;
    walk.phase += part;
    if (walk.phase >= walk.phases) {
        walk.phase -= walk.phases;
        ++walk.at;
    }
    return product;
}

// sum += samples x weights, lane by lane.
RAKS_LANES_INLINE void add_lanes(Lanes& sum, const Product& product, std::size_t i) noexcept {
    sum += lanes_at(product.samples + i) * lanes_at(product.weights + i);
}

// Sums of the lanes of four outputs, which end in lanes 0 to 3: of lanes i and i + 4 first, then of
// i and i + 2, then of the two that are left.
RAKS_LANES_INLINE Lanes add_up(const std::array<Lanes, 4>& sums) noexcept {
    const Lanes first = __builtin_shufflevector(sums[0], sums[1], 0, 1, 2, 3, 8, 9, 10, 11) +
                        __builtin_shufflevector(sums[0], sums[1], 4, 5, 6, 7, 12, 13, 14, 15);
    const Lanes second = __builtin_shufflevector(sums[2], sums[3], 0, 1, 2, 3, 8, 9, 10, 11) +
                         __builtin_shufflevector(sums[2], sums[3], 4, 5, 6, 7, 12, 13, 14, 15);
    // In pairs of lanes: of outputs 0, 2, 1 and 3.
    const Lanes pairs = __builtin_shufflevector(first, second, 0, 1, 8, 9, 4, 5, 12, 13) +
                        __builtin_shufflevector(first, second, 2, 3, 10, 11, 6, 7, 14, 15);
    return __builtin_shufflevector(pairs, pairs, 0, 4, 2, 6, 0, 4, 2, 6) +
           __builtin_shufflevector(pairs, pairs, 1, 5, 3, 7, 1, 5, 3, 7);
}

// `count` outputs, four at a time, and what is left in the same way.
RAKS_SIMD_CLONES void make_samples(Walk& walk, std::size_t count, float* __restrict out) noexcept {
    Walk here = walk;
    const std::size_t whole = here.step / here.phases;
    const std::size_t part = here.step % here.phases;
    const std::size_t taps = here.taps;
    while (count > 0) {
        std::array<Product, 4> products;  // NOLINT: filled below
        const std::size_t group = std::min(count, products.size());
        for (std::size_t k = 0; k < products.size(); ++k) {
            products[k] = k < group ? next_product(here, whole, part) : products[0];
        }
        std::array<Lanes, 4> sums{};
        for (std::size_t i = 0; i < taps; i += kLanes) {
            add_lanes(sums[0], products[0], i);
            add_lanes(sums[1], products[1], i);
            add_lanes(sums[2], products[2], i);
            add_lanes(sums[3], products[3], i);
        }
        const Lanes made = add_up(sums);
        if (group == products.size()) {
            std::memcpy(out, &made, products.size() * sizeof(float));
        } else {
            std::memcpy(out, &made, group * sizeof(float));
        }
        out += group;
        count -= group;
    }
    walk = here;
}

}  // namespace

std::optional<PolyphaseResampler> PolyphaseResampler::create(SampleRate from, SampleRate to) {
    const int divisor = std::gcd(from.hertz(), to.hertz());
    const auto phases = static_cast<std::size_t>(to.hertz() / divisor);
    const auto step = static_cast<std::size_t>(from.hertz() / divisor);
    const double wanted =
        kTaps * std::max(1.0, static_cast<double>(step) / static_cast<double>(phases));
    const std::size_t taps = (static_cast<std::size_t>(wanted) + kLanes - 1) / kLanes * kLanes;
    if (phases * taps > kMostWeights) {
        return std::nullopt;
    }
    return PolyphaseResampler(phases, step, taps);
}

PolyphaseResampler::PolyphaseResampler(std::size_t phases, std::size_t step, std::size_t taps)
    : phases_(phases), step_(step), taps_(taps), rows_(phases * taps), buffer_(taps + kRoom) {
    const double ratio = static_cast<double>(phases) / static_cast<double>(step);
    const double cutoff = ratio < 1.0 ? kFalling * ratio : kRising;
    for (std::size_t phase = 0; phase < phases; ++phase) {
        fill_row(std::span(rows_).subspan(phase * taps, taps),
                 static_cast<double>(phase) / static_cast<double>(phases),
                 cutoff);
    }
    reset();
}

// The first output sample lies on the first input sample: what its row wants before is silence.
void PolyphaseResampler::reset() noexcept RAKS_NONBLOCKING {
    std::fill(buffer_.begin(), buffer_.end(), 0.0F);
    filled_ = taps_ / 2 - 1;
    at_ = phase_ = 0;
}

PolyphaseResampler::Progress PolyphaseResampler::process(
    std::span<const float> input, std::span<float> output) noexcept RAKS_NONBLOCKING {
    Progress progress;
    while (true) {
        // How many rows lie on samples that are in: the last one starts at most `spare` further.
        if (filled_ >= at_ + taps_) {
            const std::size_t spare = filled_ - at_ - taps_;
            const std::size_t ready = ((spare + 1) * phases_ - 1 - phase_) / step_ + 1;
            const std::size_t count = std::min(ready, output.size() - progress.made);
            Walk walk{buffer_.data(), rows_.data(), taps_, phases_, step_, at_, phase_};
            make_samples(walk, count, output.data() + progress.made);
            at_ = walk.at;
            phase_ = walk.phase;
            progress.made += count;
            if (count < ready) {
                return progress;  // no room for more
            }
        }
        if (progress.taken == input.size()) {
            return progress;
        }
        // A step may lead beyond the samples that are in: then some of the next are passed over.
        const std::size_t gone = std::min(at_, filled_);
        std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(gone),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(filled_),
                  buffer_.begin());
        filled_ -= gone;
        at_ -= gone;
        const std::size_t count = std::min(buffer_.size() - filled_, input.size() - progress.taken);
        std::copy_n(input.begin() + static_cast<std::ptrdiff_t>(progress.taken),
                    count,
                    buffer_.begin() + static_cast<std::ptrdiff_t>(filled_));
        filled_ += count;
        progress.taken += count;
    }
}

}  // namespace raks::audio
