#include "audio/features/loudness.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/assert.hpp"
#include "base/decibels.hpp"

namespace raks::audio {
namespace {

constexpr float kLowestLufs = -120.0F;  // what silence, -inf LUFS, is reported as
constexpr double kOffset = -0.691;      // BS.1770: a sine of 997 Hz has its level in LUFS

}  // namespace

// BS.1770 gives its filters at 48 kHz. These are the analogue ones behind them, warped to the rate
// by the bilinear transform (De Man 2014, "Evaluation of implementations of the EBU R128 loudness
// measurement"), as in libebur128.
LoudnessMeter::LoudnessMeter(SampleRate rate)
    : block_samples_(static_cast<std::size_t>(rate.hertz() / kBlocksASecond)) {
    RAKS_ASSERT(rate.hertz() % kBlocksASecond == 0);
    const auto warped = [rate](double hertz) { return std::tan(M_PI * hertz / rate.hertz()); };
    constexpr double kShelfQ = 0.7071752369554196;
    const double shelf = warped(1681.974450955533);
    const double high = std::pow(10.0, 3.999843853973347 / 20.0);
    const double middle = std::pow(high, 0.4996667741545416);
    const double scale = 1.0 / (1.0 + shelf / kShelfQ + shelf * shelf);
    shelf_.b = {scale * (high + middle * shelf / kShelfQ + shelf * shelf),
                scale * 2.0 * (shelf * shelf - high),
                scale * (high - middle * shelf / kShelfQ + shelf * shelf)};
    shelf_.a = {scale * 2.0 * (shelf * shelf - 1.0),
                scale * (1.0 - shelf / kShelfQ + shelf * shelf)};
    constexpr double kPassQ = 0.5003270373238773;
    const double pass = warped(38.13547087602444);
    const double pass_scale = 1.0 / (1.0 + pass / kPassQ + pass * pass);
    pass_ = {pass_scale * 2.0 * (pass * pass - 1.0),
             pass_scale * (1.0 - pass / kPassQ + pass * pass)};
}

// The open block's sum goes on behind both filters, sample by sample.
void LoudnessMeter::add_to_open(std::span<const float> mono) noexcept {
    const Shelf shelf = shelf_;
    const std::array<double, 2> pass = pass_;
    Memory memory = memory_;
    double energy = open_;
    for (const float sample : mono) {
        const auto x = static_cast<double>(sample);
        const double y = shelf.b[0] * x + memory.shelf1;
        memory.shelf1 = shelf.b[1] * x - shelf.a[0] * y + memory.shelf2;
        memory.shelf2 = shelf.b[2] * x - shelf.a[1] * y;
        const double z = y + memory.pass1;
        memory.pass1 = memory.pass2 - (y + y) - pass[0] * z;
        memory.pass2 = y - pass[1] * z;
        energy += z * z;
    }
    memory_ = memory;
    open_ = energy;
}

void LoudnessMeter::add(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    while (!mono.empty()) {
        const std::size_t count = std::min(mono.size(), block_samples_ - in_open_);
        add_to_open(mono.first(count));
        in_open_ += count;
        mono = mono.subspan(count);
        if (in_open_ == block_samples_) {
            blocks_[next_] = open_;
            next_ = (next_ + 1) % kBlocks;
            open_ = 0.0;
            in_open_ = 0;
        }
    }
}

// All blocks anew: a sum that is carried on would drift over hours.
float LoudnessMeter::momentary() const noexcept RAKS_NONBLOCKING {
    const double sum = std::accumulate(blocks_.begin(), blocks_.end(), 0.0);
    const double mean = sum / static_cast<double>(kBlocks * block_samples_);
    return std::max(kLowestLufs, static_cast<float>(kOffset + decibels_of_power(mean)));
}

void LoudnessMeter::reset() noexcept RAKS_NONBLOCKING {
    memory_ = {};
    blocks_.fill(0.0);
    open_ = 0.0;
    in_open_ = next_ = 0;
}

}  // namespace raks::audio
