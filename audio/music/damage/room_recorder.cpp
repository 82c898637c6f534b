#include "audio/music/damage/room_recorder.hpp"

#include <cmath>
#include <cstddef>

#include "audio/music/damage/sound_damage.hpp"
#include "audio/resample/interpolation.hpp"
#include "base/decibels.hpp"

namespace raks::audio {

std::vector<float> record_in_room(int rate,
                                  std::span<const float> music,
                                  const RoomRecorder& recorder,
                                  Dice& dice) {
    constexpr double kSpeedOfSound = 343.0;
    const double pace = 1.0 + recorder.drift_ppm * 1e-6;
    // What begins to sound before the recorder runs still echoes when it does.
    const auto before = static_cast<std::size_t>(recorder.reverberation * rate);
    const auto size = static_cast<std::size_t>(std::llround(recorder.seconds * rate));
    const double first = (recorder.offset - recorder.metres / kSpeedOfSound) * rate -
                         pace * static_cast<double>(before);
    std::vector<float> heard = read_between(music, first, pace, before + size);
    if (recorder.reverberation > 0.0) {
        // Amplitudes 1 - wet and wet of direct and reverberant sound.
        const double ratio = amplitude_of_decibels(recorder.direct_to_reverberant_db);
        add_room(rate, recorder.reverberation, 1.0 / (1.0 + ratio), heard, dice);
    }
    heard.erase(heard.begin(), heard.begin() + static_cast<std::ptrdiff_t>(before));
    add_white_noise(recorder.signal_to_noise_db, heard, dice);
    return heard;
}

}  // namespace raks::audio
