#pragma once

#include "audio/io/audio_file_backends.hpp"

namespace raks::audio {

/// What a file is brought to.
struct SoundForm {
    SampleRate rate{48'000};
    int channels = 2;
};

/// A reader of `inner` at another rate and with another number of channels. As any reader: the same
/// samples by any blocks, and after any seek. Frame k lies at the time k / form.rate; to stereo and
/// mono the channels are mixed by downmix.hpp, more than two get the two sides in their first two.
/// `note` becomes part of warning(). Errors: the resampler cannot be set up.
/// Threads: one at a time. Real-time: no.
[[nodiscard]] Expected<AudioFileReaderPtr> resample_reader(AudioFileReaderPtr inner,
                                                           const SoundForm& form,
                                                           const std::filesystem::path& path,
                                                           std::string note);

/// The nearest rate that Raks works at, 8 to 192 kHz: the rate itself, or a whole multiple or a
/// whole part of it.
[[nodiscard]] SampleRate nearest_supported(SampleRate rate) noexcept;

/// Number of frames at `to` of sound that has `frames` at `from`: to the last that begins in it.
[[nodiscard]] std::int64_t frames_at_rate(std::int64_t frames,
                                          SampleRate from,
                                          SampleRate to) noexcept;

}  // namespace raks::audio
