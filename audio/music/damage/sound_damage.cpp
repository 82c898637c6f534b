#include "audio/music/damage/sound_damage.hpp"

#include <algorithm>
#include <cmath>

#include "audio/io/lossy_codec.hpp"
#include "base/decibels.hpp"

namespace raks::audio {
// Convolution with a sparse impulse response whose energy is wet^2, beside the direct sound.
void add_room(int rate, double seconds, double wet, std::vector<float>& samples, Dice& dice) {
    // Velvet noise: sparse reflections of random sign sound like dense ones and cost little.
    constexpr double kReflectionsASecond = 700.0;
    struct Reflection {
        std::size_t delay;
        float gain;
    };
    std::vector<Reflection> reflections;
    double energy = 0.0;
    for (double at = 0.004; at < seconds; at += 2.0 * dice.uniform() / kReflectionsASecond) {
        // 60 dB down after `seconds`.
        const double gain = std::pow(10.0, -3.0 * at / seconds) * (dice.chance(0.5) ? 1.0 : -1.0);
        reflections.push_back({static_cast<std::size_t>(at * rate), static_cast<float>(gain)});
        energy += gain * gain;
    }
    const auto scale = static_cast<float>(wet / std::sqrt(std::max(energy, 1e-9)));
    std::vector<float> result(samples.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        result[i] = static_cast<float>(1.0 - wet) * samples[i];
    }
    for (const Reflection& reflection : reflections) {
        const float gain = scale * reflection.gain;
        for (std::size_t i = reflection.delay; i < samples.size(); ++i) {
            result[i] += gain * samples[i - reflection.delay];
        }
    }
    samples = std::move(result);
}

void add_white_noise(double ratio_db, std::vector<float>& samples, Dice& dice) {
    // Uniform noise of [-1, 1) has an rms of 1 / sqrt(3).
    const double rms = std::sqrt(mean_square(samples, 1e-12));
    const double level = rms * amplitude_of_decibels(-ratio_db) * std::sqrt(3.0);
    for (float& sample : samples) {
        sample += static_cast<float>(level * dice.uniform(-1.0, 1.0));
    }
}

void cut_above(int rate, double hertz, std::vector<float>& samples) {
    // Close to half the rate the filter would be unstable.
    if (hertz > 0.45 * rate) {
        return;
    }
    // Butterworth of order 6: three sections (Bristow-Johnson's cookbook), each with its own Q.
    for (const double q : {0.5176, 0.7071, 1.9319}) {
        const double angle = 2.0 * M_PI * hertz / rate;
        const double alpha = std::sin(angle) / (2.0 * q);
        const double a0 = 1.0 + alpha;
        const double b = 0.5 * (1.0 - std::cos(angle)) / a0;
        const double a1 = -2.0 * std::cos(angle) / a0;
        const double a2 = (1.0 - alpha) / a0;
        // Transposed direct form II.
        double z1 = 0.0;
        double z2 = 0.0;
        for (float& sample : samples) {
            const double x = static_cast<double>(sample);
            const double y = b * x + z1;
            z1 = 2.0 * b * x - a1 * y + z2;
            z2 = b * x - a2 * y;
            sample = static_cast<float>(y);
        }
    }
}

void change_gain(double db, std::vector<float>& samples) {
    const auto gain = static_cast<float>(amplitude_of_decibels(db));
    for (float& sample : samples) {
        sample *= gain;
    }
}

// Reads the samples at steps of `ratio`; behind the end there is silence.
void change_speed(double ratio, std::vector<float>& samples) {
    std::vector<float> result(
        static_cast<std::size_t>(static_cast<double>(samples.size()) / ratio));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double at = static_cast<double>(i) * ratio;
        const auto whole = static_cast<std::size_t>(at);
        const auto share = static_cast<float>(at - std::floor(at));
        const float next = whole + 1 < samples.size() ? samples[whole + 1] : 0.0F;
        result[i] =
            whole < samples.size() ? samples[whole] + share * (next - samples[whole]) : 0.0F;
    }
    samples = std::move(result);
}

// Down and up again: without filters the upper frequencies fold down.
void change_rate(int rate, double low_rate, std::vector<float>& samples) {
    const double ratio = rate / low_rate;
    if (ratio <= 1.0) {
        return;
    }
    const std::size_t size = samples.size();
    change_speed(ratio, samples);
    change_speed(1.0 / ratio, samples);
    samples.resize(size);
}

Expected<void> damage(Damage kind, int rate, std::vector<float>& samples) {
    // A fixed seed for each kind: measurements are repeatable.
    Dice dice(13, static_cast<std::uint64_t>(kind));
    switch (kind) {
        case Damage::none:
            break;
        case Damage::quieter_12_db:
            change_gain(-12.0, samples);
            break;
        case Damage::low_pass_4_khz:
            cut_above(rate, 4'000.0, samples);
            break;
        case Damage::mp3_24_kbit:
            return pass_lossy_codec(LossyCodec::mp3, rate, 24'000, samples);
        case Damage::noise_10_db:
            add_white_noise(10.0, samples, dice);
            break;
        case Damage::room_600_ms:
            add_room(rate, 0.6, 0.5, samples, dice);
            break;
    }
    return {};
}

}  // namespace raks::audio
