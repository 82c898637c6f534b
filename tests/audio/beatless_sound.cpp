#include "tests/audio/beatless_sound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "base/random.hpp"

namespace raks::audio::test {
namespace {

std::vector<float> silence(double seconds) {
    return std::vector<float>(static_cast<std::size_t>(seconds * kBeatlessRate));
}

}  // namespace

std::vector<float> white_noise(double seconds, double level, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> mono = silence(seconds);
    for (std::size_t i = 0; i < mono.size(); ++i) {
        mono[i] = static_cast<float>(level * random.normal(i));
    }
    return mono;
}

// Kellet's filter of three poles, within .5 dB of 3 dB an octave from 10 Hz on at 44.1 kHz.
std::vector<float> pink_noise(double seconds, double level, std::uint64_t seed) {
    std::vector<float> mono = white_noise(seconds, 1.0, seed);
    std::array<double, 3> low{};
    double power = 0.0;
    for (float& sample : mono) {
        const auto white = static_cast<double>(sample);
        low[0] = 0.99765 * low[0] + 0.0990460 * white;
        low[1] = 0.96300 * low[1] + 0.2965164 * white;
        low[2] = 0.57000 * low[2] + 1.0526913 * white;
        const double pink = low[0] + low[1] + low[2] + 0.1848 * white;
        power += pink * pink;
        sample = static_cast<float>(pink);
    }
    const double gain = level / std::sqrt(power / static_cast<double>(mono.size()));
    for (float& sample : mono) {
        sample = static_cast<float>(gain * static_cast<double>(sample));
    }
    return mono;
}

std::vector<float> irregular_clicks(double seconds, double a_second, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> mono = silence(seconds);
    std::uint64_t draw = 0;
    double at = 0.0;
    for (;;) {
        at -= std::log(1.0 - random.uniform(draw++)) / a_second;
        if (at >= seconds - 0.01) {
            return mono;
        }
        const auto first = static_cast<std::size_t>(at * kBeatlessRate);
        // 2 ms of a tone that dies away.
        for (std::size_t i = 0; i < 200; ++i) {
            const double angle = 2.0 * std::numbers::pi * 2'000.0 * static_cast<double>(i) /
                                 static_cast<double>(kBeatlessRate);
            mono[first + i] += static_cast<float>(0.5 * std::exp(-static_cast<double>(i) / 30.0) *
                                                  std::cos(angle));
        }
    }
}

std::vector<float> applause(double seconds, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> mono = silence(seconds);
    std::uint64_t draw = 0;
    for (double at = 0.0; at < seconds - 0.1;) {
        const auto first = static_cast<std::size_t>(at * kBeatlessRate);
        const double level = 0.02 + 0.1 * random.uniform(draw++);
        for (std::size_t i = 0; i < 700; ++i) {
            const double fade = std::exp(-static_cast<double>(i) / 140.0);
            mono[first + i] += static_cast<float>(level * fade * random.normal(draw++));
        }
        at -= std::log(1.0 - random.uniform(draw++)) / 60.0;
    }
    return mono;
}

std::vector<float> speech(double seconds, std::uint64_t seed) {
    const CounterRandom random(seed);
    std::vector<float> mono = silence(seconds);
    std::uint64_t draw = 0;
    double pitch = 130.0;
    for (double at = 0.2; at < seconds - 0.5;) {
        const double length = 0.08 + 0.22 * random.uniform(draw++);
        const bool is_hiss = random.uniform(draw++) < 0.25;
        const double level = 0.05 + 0.2 * random.uniform(draw++);
        pitch = std::clamp(pitch * std::exp(0.1 * random.normal(draw++)), 90.0, 220.0);
        const double formant = 400.0 + 1800.0 * random.uniform(draw++);
        const auto first = static_cast<std::size_t>(at * kBeatlessRate);
        const auto count = static_cast<std::size_t>(length * kBeatlessRate);
        for (std::size_t i = 0; i < count; ++i) {
            const double t = static_cast<double>(i) / kBeatlessRate;
            const double edge = std::min({1.0, t / 0.03, (length - t) / 0.05});
            const double buzz = std::sin(2.0 * std::numbers::pi * formant * t) *
                                std::exp(-8.0 * std::fmod(t * pitch, 1.0));
            const double tone = is_hiss ? 0.3 * random.normal(draw++) : buzz;
            mono[first + i] += static_cast<float>(level * edge * tone);
        }
        const double gap = 0.08 * random.uniform(draw++);
        const bool is_pause = random.uniform(draw++) < 0.15;
        at += length + gap + (is_pause ? 0.3 : 0.0);
    }
    return mono;
}

}  // namespace raks::audio::test
