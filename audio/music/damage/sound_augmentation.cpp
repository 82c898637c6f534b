#include "audio/music/damage/sound_augmentation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "audio/io/lossy_codec.hpp"
#include "audio/music/damage/sound_damage.hpp"
#include "base/decibels.hpp"

namespace raks::audio {
namespace {

// Second-order filter, direct form I; coefficients from Bristow-Johnson's cookbook, divided by a0.
struct Biquad {
    double b0 = 1.0;
    double b1 = 0.0;
    double b2 = 0.0;
    double a1 = 0.0;
    double a2 = 0.0;

    void run(std::vector<float>& samples) const {
        double x1 = 0.0;
        double x2 = 0.0;
        double y1 = 0.0;
        double y2 = 0.0;
        for (float& sample : samples) {
            const double x = static_cast<double>(sample);
            const double y = b0 * x + b1 * x1 + b2 * x2 - a1 * y1 - a2 * y2;
            x2 = x1;
            x1 = x;
            y2 = y1;
            y1 = y;
            sample = static_cast<float>(y);
        }
    }
};

// The two numbers that all of the cookbook's filters start from.
struct Corner {
    double cosine = 0.0;
    double alpha = 0.0;
};

Corner corner(double hertz, double rate, double q) {
    constexpr double kHighest = 0.45;  // of the rate: above half of it a filter is unstable
    const double angle = 2.0 * std::numbers::pi * std::min(hertz / rate, kHighest);
    return {std::cos(angle), std::sin(angle) / (2.0 * q)};
}

// Low- and high-pass of 12 dB an octave, about Butterworth.
Biquad low_pass(double hertz, double rate) {
    const auto [c, alpha] = corner(hertz, rate, 0.7);
    const double a0 = 1.0 + alpha;
    return {0.5 * (1.0 - c) / a0,
            (1.0 - c) / a0,
            0.5 * (1.0 - c) / a0,
            -2.0 * c / a0,
            (1.0 - alpha) / a0};
}

Biquad high_pass(double hertz, double rate) {
    const auto [c, alpha] = corner(hertz, rate, 0.7);
    const double a0 = 1.0 + alpha;
    return {0.5 * (1.0 + c) / a0,
            -(1.0 + c) / a0,
            0.5 * (1.0 + c) / a0,
            -2.0 * c / a0,
            (1.0 - alpha) / a0};
}

// Boost or cut around a frequency; `gain` is the square root of the amplitude's factor.
Biquad bell(double hertz, double rate, double decibel) {
    const auto [c, alpha] = corner(hertz, rate, 0.9);
    const double gain = std::pow(10.0, decibel / 40.0);
    const double a0 = 1.0 + alpha / gain;
    return {(1.0 + alpha * gain) / a0,
            -2.0 * c / a0,
            (1.0 - alpha * gain) / a0,
            -2.0 * c / a0,
            (1.0 - alpha / gain) / a0};
}

// Peak gain 1 at the centre.
Biquad band_pass(double hertz, double rate, double q) {
    const auto [c, alpha] = corner(hertz, rate, q);
    const double a0 = 1.0 + alpha;
    return {alpha / a0, 0.0, -alpha / a0, -2.0 * c / a0, (1.0 - alpha) / a0};
}

// A voice-like sound: a saw wave through three formants, in syllables of random length that keep to
// no beat.
void add_voice(double rate, std::vector<float>& samples, Dice& dice) {
    std::vector<float> voice(samples.size());
    const double level = dice.uniform(0.1, 0.5);
    double pitch = dice.log_uniform(90.0, 350.0);
    double phase = 0.0;
    for (std::size_t at = 0; at < voice.size();) {
        const auto length = static_cast<std::size_t>(dice.uniform(0.08, 0.5) * rate);
        const bool is_pause = dice.chance(0.3);
        // Each syllable begins near the pitch of the last one.
        pitch = std::clamp(pitch * std::exp(dice.normal(0.15)), 80.0, 500.0);
        const double glide = dice.normal(0.1) / static_cast<double>(length);
        for (std::size_t i = 0; i < length && at < voice.size(); ++i, ++at) {
            const double share = static_cast<double>(i) / static_cast<double>(length);
            // Fast rise, slow fall.
            const double envelope = std::min(1.0, 20.0 * share) * (1.0 - share);
            phase += pitch * (1.0 + glide * static_cast<double>(i)) / rate;
            phase -= std::floor(phase);
            voice[at] = is_pause ? 0.0F : static_cast<float>(envelope * (2.0 * phase - 1.0));
        }
    }
    // One band-pass a formant, in parallel; the formants are the same for all syllables.
    std::vector<float> sum(voice.size());
    for (const double formant :
         {dice.uniform(300.0, 900.0), dice.uniform(900.0, 2300.0), dice.uniform(2300.0, 3500.0)}) {
        std::vector<float> band = voice;
        band_pass(formant, rate, 6.0).run(band);
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += band[i];
        }
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        samples[i] += static_cast<float>(level * 4.0) * sum[i];
    }
}

// Noise of 8 to 45 dB below the music: a first-order low-pass over white noise gives its colour.
void add_noise(std::vector<float>& samples, Dice& dice) {
    const double rms = std::sqrt(mean_square(samples, 1e-9));
    const double level = rms * amplitude_of_decibels(-dice.uniform(8.0, 45.0));
    const double colour = dice.uniform(0.0, 0.97);  // 0 white, towards 1 brown
    // The level of the coloured noise: variance 1 / (1 - colour^2), and 1.7 is about sqrt(3) for
    // uniform white noise.
    const double scale = level * std::sqrt(1.0 - colour * colour) * 1.7;
    double state = 0.0;
    for (float& sample : samples) {
        state = colour * state + dice.uniform(-1.0, 1.0);
        sample += static_cast<float>(scale * state);
    }
}

}  // namespace

// In the order of the way to the recording: voice, loudspeaker, microphone, level.
void augment_sound(int sample_rate,
                   std::vector<float>& samples,
                   Dice& dice,
                   const SoundEffects& effects) {
    const double rate = sample_rate;
    const auto happens = [&](SoundEffect effect, double chance) {
        return effects.has(effect) && dice.chance(chance);
    };
    if (happens(SoundEffect::voice, 0.25)) {
        add_voice(rate, samples, dice);
    }
    const int bells = effects.has(SoundEffect::equalizer) ? dice.whole(0, 2) : 0;
    for (int i = 0; i < bells; ++i) {
        bell(dice.log_uniform(60.0, 9000.0), rate, dice.uniform(-9.0, 9.0)).run(samples);
    }
    if (happens(SoundEffect::overdrive, 0.3)) {
        const double drive = dice.uniform(1.0, 5.0);
        for (float& sample : samples) {
            sample = static_cast<float>(std::tanh(drive * static_cast<double>(sample)) / drive);
        }
    }
    if (happens(SoundEffect::band, 0.25)) {
        low_pass(dice.log_uniform(3000.0, 12'000.0), rate).run(samples);
    }
    if (happens(SoundEffect::band, 0.15)) {
        high_pass(dice.uniform(60.0, 250.0), rate).run(samples);
    }
    if (happens(SoundEffect::noise, 0.4)) {
        add_noise(samples, dice);
    }
    if (effects.has(SoundEffect::gain)) {
        const auto gain = static_cast<float>(amplitude_of_decibels(-dice.uniform(0.0, 30.0)));
        for (float& sample : samples) {
            sample *= gain;
        }
    }
}

namespace {

// Everything before the sampling rate and the codec change, which come last in augment_for_genre().
void augment_sounding(int rate,
                      std::vector<float>& samples,
                      Dice& dice,
                      const SoundEffects& effects) {
    // Every effect asks the dice only when it is enabled.
    const auto happens = [&](SoundEffect effect, double chance) {
        return effects.has(effect) && dice.chance(chance);
    };
    // About a third of the pieces are only made softer.
    if (happens(SoundEffect::gain, 0.35)) {
        change_gain(-dice.uniform(0.0, 30.0), samples);
        return;
    }
    if (happens(SoundEffect::room, 0.3)) {
        add_room(rate, dice.uniform(0.15, 0.9), dice.uniform(0.15, 0.7), samples, dice);
    }
    if (happens(SoundEffect::band, 0.3)) {
        cut_above(rate, dice.log_uniform(3'000.0, 9'000.0), samples);
    }
    if (happens(SoundEffect::noise, 0.25)) {
        add_white_noise(dice.uniform(6.0, 30.0), samples, dice);
    }
    augment_sound(rate, samples, dice, effects);
}

}  // namespace

Expected<void> augment_for_genre(int rate,
                                 std::vector<float>& samples,
                                 Dice& dice,
                                 const SoundEffects& effects) {
    augment_sounding(rate, samples, dice, effects);
    if (effects.has(SoundEffect::resampling) && dice.chance(0.1)) {
        change_rate(rate, dice.log_uniform(11'025.0, 32'000.0), samples);
    }
    if (effects.has(SoundEffect::codec) && dice.chance(0.3)) {
        const auto codec = dice.chance(0.5) ? LossyCodec::mp3 : LossyCodec::opus;
        // Bit rates that MP3 encoders have as well.
        const int bits = dice.pick({16'000, 24'000, 32'000, 48'000, 64'000, 96'000});
        return pass_lossy_codec(codec, rate, bits, samples);
    }
    return {};
}

Expected<void> alter_recording(
    int rate, int copy, std::vector<float>& samples, Dice& dice, const SoundEffects& effects) {
    // Speed first: room and codec act on the altered sound, as they would in reality.
    if (effects.has(SoundEffect::speed)) {
        change_speed(dice.uniform(0.92, 1.08), samples);
    }
    if (copy % kRoomEvery == 0 && effects.has(SoundEffect::room)) {
        const double seconds = dice.log_uniform(0.2, 1.2);
        add_room(rate, seconds, dice.uniform(0.3, 0.7), samples, dice);
        return {};
    }
    return augment_for_genre(rate, samples, dice, effects);
}

}  // namespace raks::audio
