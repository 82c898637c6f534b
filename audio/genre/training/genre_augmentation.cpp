#include "audio/genre/training/genre_augmentation.hpp"

#include "audio/beat/training/sound_augmentation.hpp"
#include "audio/genre/training/sound_damage.hpp"

namespace raks::audio {

void augment_for_genre(int rate, std::vector<float>& samples, Dice& dice) {
    if (dice.chance(0.35)) {
        change_gain(-dice.uniform(0.0, 30.0), samples);
        return;
    }
    if (dice.chance(0.3)) {
        add_room(rate, dice.uniform(0.15, 0.9), dice.uniform(0.15, 0.7), samples, dice);
    }
    if (dice.chance(0.3)) {
        cut_above(rate, dice.log_uniform(3'000.0, 9'000.0), samples);
    }
    if (dice.chance(0.25)) {
        add_white_noise(dice.uniform(6.0, 30.0), samples, dice);
    }
    augment_sound(rate, samples, dice);
}

}  // namespace raks::audio
