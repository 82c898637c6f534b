#include "engine/live/file_sound.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace raks::engine {
namespace {

// Largest change of the gain per frame: from 0 to 1 in 10 ms at 48 kHz, without a click.
constexpr float kGainStep = 1.0F / 480.0F;

}  // namespace

FileSound::FileSound(std::unique_ptr<audio::FilePlayer> player)
    : player_(std::move(player)),
      file_rate_(player_->first_info().rate),
      device_rate_(file_rate_),
      pulled_(2 * kPullFrames),
      stereo_(2 * kPullFrames) {}

Expected<void> FileSound::prepare(SampleRate device_rate, StreamTime until) {
    device_rate_ = device_rate;
    // When another clock takes over at another rate, stream time must not jump.
    frames_out_ = device_rate.index_at(until);
    return resampler_.prepare(file_rate_, device_rate, 2);
}

// Pulls the next frames of the file; returns how many. 0: none are ready, or the file has ended.
std::size_t FileSound::refill(Ear* ear) noexcept {
    const audio::PulledAudio got = player_->pull(pulled_);
    // Set at each pull: a seek after the end makes the source go on.
    is_source_ended_ = got.is_ended;
    if (got.frames == 0) {
        return 0;
    }
    const double seconds = static_cast<double>(got.position) / file_rate_.hertz();
    // relaxed, all three: numbers by themselves
    if (!player_->is_seeking()) {
        position_seconds_.store(seconds, std::memory_order_relaxed);
    }
    // Frames until the end that set_end() asked for: rounded, so that it is exact to the sample.
    const double left = end_seconds_.load(std::memory_order_relaxed) - seconds;
    const double frames_left = std::round(left * file_rate_.hertz());
    if (frames_left < 1.0) {
        is_source_ended_ = true;
        return 0;
    }
    const std::size_t frames = frames_left < static_cast<double>(got.frames)
                                   ? static_cast<std::size_t>(frames_left)
                                   : got.frames;
    if (ear != nullptr) {
        ear->on_pulled(got, std::span(pulled_).first(2 * frames));
    }
    return frames;
}

// Fills `stereo` at the device's rate; returns how many of its frames hold the file's sound.
std::size_t FileSound::pull(std::span<float> stereo, Ear* ear) noexcept {
    std::size_t made = 0;
    while (2 * made < stereo.size()) {
        if (pending_ == 0) {
            pending_ = refill(ear);
            pending_at_ = 0;
            // Not ready or at the end: the rest of the block stays silent.
            if (pending_ == 0) {
                break;
            }
        }
        // The resampler may take only part of what was pulled; the rest stays pending for the next
        // round.
        const auto progress = resampler_.process(
            std::span(pulled_).subspan(2 * pending_at_, 2 * pending_), stereo.subspan(2 * made));
        pending_at_ += progress.taken;
        pending_ -= progress.taken;
        made += progress.made;
    }
    return made;
}

FileSound::Filled FileSound::fill(std::span<float> interleaved,
                                  int channels,
                                  Ear* ear) noexcept RAKS_NONBLOCKING {
    const std::size_t stride = static_cast<std::size_t>(channels);
    const std::size_t frames = interleaved.size() / stride;
    // What is not filled below is silence.
    std::fill(interleaved.begin(), interleaved.end(), 0.0F);
    Filled filled{.first = device_rate_.time_of(frames_out_)};
    // relaxed: switches that order nothing. A pause fades out before it stops: no click.
    const bool is_pausing = is_paused_.load(std::memory_order_relaxed);
    const bool is_held_back = is_held_back_.load(std::memory_order_relaxed);
    // What does not sound yet has nothing to fade out when it is let go.
    if (is_pausing && is_held_back) {
        gain_ = 0.0F;
    }
    if ((is_pausing && gain_ == 0.0F) || is_held_back) {
        filled.is_still = true;
        return filled;
    }
    const float volume = is_pausing ? 0.0F : volume_.load(std::memory_order_relaxed);
    // In pieces that fit the buffers, whatever size the device asks for.
    for (std::size_t at = 0; at < frames; at += kPullFrames) {
        const std::size_t wanted = std::min(kPullFrames, frames - at);
        const std::size_t made = pull(std::span(stereo_).first(2 * wanted), ear);
        for (std::size_t frame = 0; frame < made; ++frame) {
            // The gain moves frame by frame towards the volume.
            gain_ += std::clamp(volume - gain_, -kGainStep, kGainStep);
            float* const out = &interleaved[(at + frame) * stride];
            const float left = stereo_[2 * frame] * gain_;
            const float right = stereo_[2 * frame + 1] * gain_;
            // A mono device gets the mean of both channels; beyond two, the channels stay silent.
            out[0] = channels == 1 ? 0.5F * (left + right) : left;
            if (channels > 1) {
                out[1] = right;
            }
        }
        // Counts only frames with sound: stream time stands still while the decoder is behind.
        frames_out_ += static_cast<std::int64_t>(made);
        filled.has_sound = filled.has_sound || made > 0;
        if (made < wanted) {
            break;
        }
    }
    // release: pairs with the acquire in is_finished(): all samples are out by then. A seek back
    // makes it false again.
    is_finished_.store(is_source_ended_ && !filled.has_sound, std::memory_order_release);
    return filled;
}

void FileSound::set_volume(float volume) noexcept {
    volume_.store(std::clamp(volume, 0.0F, 2.0F), std::memory_order_relaxed);
}

void FileSound::set_paused(bool is_paused) noexcept {
    is_paused_.store(is_paused, std::memory_order_relaxed);
}

bool FileSound::is_paused() const noexcept { return is_paused_.load(std::memory_order_relaxed); }

double FileSound::position_seconds() const noexcept {
    return position_seconds_.load(std::memory_order_relaxed);
}

void FileSound::seek(double seconds) {
    if (!player_->can_seek()) {
        return;
    }
    // Shown at once: the player reaches the new place only with a later pull.
    const double wanted = std::max(0.0, seconds);
    player_->seek(0, wanted);
    position_seconds_.store(wanted, std::memory_order_relaxed);  // relaxed: for display
    // Until the next block tells: nobody must take the file for finished meanwhile. relaxed: a
    // block that is under way may still say the old state, as if the seek had come behind it.
    is_finished_.store(false, std::memory_order_relaxed);
}

bool FileSound::is_finished() const noexcept {
    return is_finished_.load(std::memory_order_acquire);
}

void FileSound::set_end(double seconds) noexcept {
    end_seconds_.store(seconds, std::memory_order_relaxed);
}

}  // namespace raks::engine
