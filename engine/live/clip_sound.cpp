#include "engine/live/clip_sound.hpp"

#include <cmath>
#include <utility>

#include "audio/io/devices.hpp"

namespace raks::engine {

SoundStep sound_step(double clip, double heard) noexcept {
    constexpr double kFarthest = 0.25;  // seconds that are walked
    constexpr double kShare = 0.1;      // of the distance, a picture
    const double ahead = heard - clip;
    return std::abs(ahead) > kFarthest ? SoundStep{.seeks = true, .clip_seconds = 0.0}
                                       : SoundStep{.seeks = false, .clip_seconds = kShare * ahead};
}

Expected<std::unique_ptr<ClipSound>> ClipSound::open(const std::filesystem::path& file) {
    auto player = audio::FilePlayer::start({file});
    if (!player) {
        return fail(std::move(player.error()));
    }
    const auto system = audio::AudioSystem::open();
    if (!system) {
        return fail(system.error());
    }
    const auto choice = audio::choose_output(system->devices());
    if (!choice) {
        return fail(choice.error());
    }
    audio::StreamConfig wishes;
    wishes.latency_seconds = kPlayBuffer;
    auto stream = audio::DeviceStream::open_output(choice->device, wishes);
    if (!stream) {
        return fail(std::move(stream.error()));
    }
    std::unique_ptr<ClipSound> sound(new ClipSound(std::move(*player)));
    if (auto prepared = sound->sound_.prepare((*stream)->rate(), StreamTime{}); !prepared) {
        return fail(std::move(prepared.error()));
    }
    sound->sound_.fade_in();
    sound->sound_.set_paused(true);
    sound->stream_ = std::move(*stream);
    sound->stream_->connect(*sound);
    return sound;
}

double ClipSound::follow(double clip, bool sounds) {
    const HostTime now = HostClock::now();
    if (!is_lost_ && !stream_->is_alive(now)) {
        stream_->abandon();
        is_lost_ = true;
    }
    if (is_lost_ || !sounds) {
        sound_.set_paused(true);
        return 0.0;
    }
    sound_.set_paused(false);
    const double delay = to_seconds(stream_->heard_after());
    const SoundStep step = sound_step(clip, sound_.position_seconds() - delay);
    // What was sought is heard a moment later.
    constexpr Nanos kPatience = std::chrono::milliseconds(500);
    if (now - sought_ < kPatience) {
        return 0.0;
    }
    if (step.seeks) {
        sought_ = now;
        sound_.seek(clip + delay);
    }
    return step.clip_seconds;
}

void ClipSound::on_output(std::span<float> interleaved,
                          int channels,
                          const audio::BlockTime& /*time*/) noexcept RAKS_NONBLOCKING {
    static_cast<void>(sound_.fill(interleaved, channels, nullptr));
}

}  // namespace raks::engine
