#include "audio/music/damage/genre_augmentation.hpp"

#include "audio/io/lossy_codec.hpp"
#include "audio/music/damage/sound_damage.hpp"

namespace raks::audio {
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
