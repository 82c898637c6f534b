#include "audio/io/audio_file.hpp"

#include <algorithm>
#include <memory>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunkFrames = 16'384;  // decoded at once

}  // namespace

// Decodes chunk by chunk and checks the limit as it goes: the claimed length may be wrong.
Expected<MonoAudio> read_all_mono(const fs::path& path, double max_seconds) {
    auto reader = open_audio_file(path);
    if (!reader) {
        return fail(reader.error());
    }
    const AudioFileInfo& info = (*reader)->info();
    const auto channels = static_cast<std::size_t>(info.channels);
    const auto limit = static_cast<std::size_t>(max_seconds * info.rate.hertz());
    MonoAudio audio{.rate = info.rate, .samples = {}, .warning = {}, .tags = info.tags};
    std::vector<float> chunk(kChunkFrames * channels);
    while (const std::size_t frames = (*reader)->read(chunk)) {
        const std::size_t before = audio.samples.size();
        if (before + frames > limit) {
            return fail(path.string() + ": is longer than " +
                        std::to_string(static_cast<long>(max_seconds)) +
                        " s, the limit for reading a whole file");
        }
        audio.samples.resize(before + frames);
        hear_mono(std::span(chunk).first(frames * channels),
                  channels,
                  info.hearing,
                  std::span(audio.samples).subspan(before));
    }
    audio.warning = (*reader)->warning();
    return audio;
}

}  // namespace raks::audio
