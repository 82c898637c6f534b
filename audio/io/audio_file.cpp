#include "audio/io/audio_file.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/assert.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kChunkFrames = 16'384;  // decoded or written at once

// The head of 16-bit WAV: all numbers are little-endian, as this machine's are.
struct WavHead {
    std::array<char, 4> riff{'R', 'I', 'F', 'F'};
    std::uint32_t riff_bytes = 0;  // of all that follows
    std::array<char, 8> wave{'W', 'A', 'V', 'E', 'f', 'm', 't', ' '};
    std::uint32_t form_bytes = 16;
    std::uint16_t kind = 1;  // PCM
    std::uint16_t channels = 0;
    std::uint32_t rate = 0;
    std::uint32_t bytes_per_second = 0;
    std::uint16_t bytes_per_frame = 0;
    std::uint16_t bits = 16;
    std::array<char, 4> data{'d', 'a', 't', 'a'};
    std::uint32_t data_bytes = 0;
};
static_assert(sizeof(WavHead) == 44 && std::endian::native == std::endian::little);

WavHead wav_head(std::size_t samples, int channels, SampleRate rate) {
    WavHead head;
    head.data_bytes = static_cast<std::uint32_t>(2 * samples);
    head.riff_bytes = head.data_bytes + sizeof(WavHead) - 8;
    head.channels = static_cast<std::uint16_t>(channels);
    head.rate = static_cast<std::uint32_t>(rate.hertz());
    head.bytes_per_frame = static_cast<std::uint16_t>(2 * channels);
    head.bytes_per_second = head.rate * head.bytes_per_frame;
    return head;
}

// The upper half of a 32-bit sample, which is what libsndfile writes: old files stay the same.
std::int16_t to_16_bits(float sample) {
    const double scaled = static_cast<double>(sample) * 2147483647.0;
    const double clipped =
        std::isnan(scaled) ? 0.0 : std::clamp(scaled, -2147483648.0, 2147483647.0);
    return static_cast<std::int16_t>(std::llrint(clipped) >> 16);
}

bool write_samples(std::FILE* file, std::span<const float> samples) {
    std::vector<std::int16_t> chunk;
    while (!samples.empty()) {
        chunk.resize(std::min(samples.size(), kChunkFrames));
        std::transform(samples.begin(),
                       samples.begin() + static_cast<std::ptrdiff_t>(chunk.size()),
                       chunk.begin(),
                       to_16_bits);
        if (std::fwrite(chunk.data(), sizeof(std::int16_t), chunk.size(), file) != chunk.size()) {
            return false;
        }
        samples = samples.subspan(chunk.size());
    }
    return true;
}

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
    MonoAudio audio{.rate = info.rate, .samples = {}, .warning = {}};
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

Expected<void> write_wav(const fs::path& path,
                         std::span<const float> interleaved,
                         int channels,
                         SampleRate rate) {
    constexpr std::size_t kMaxSamples = (std::size_t{1} << 31U) - 1024;  // WAV ends at 4 GiB
    RAKS_ASSERT(channels >= 1 && interleaved.size() % static_cast<std::size_t>(channels) == 0);
    if (interleaved.size() > kMaxSamples) {
        return fail(path.string() + ": would be larger than 4 GiB, the limit of WAV");
    }
    // Written under another name and renamed at the end: readers never see half a file.
    auto pending = PendingFile::create(path);
    if (!pending) {
        return fail(pending.error());
    }
    std::FILE* const file = std::fopen(pending->part().c_str(), "wb");
    if (file == nullptr) {
        return fail(path.string() + ": cannot be written");
    }
    const WavHead head = wav_head(interleaved.size(), channels, rate);
    const bool wrote =
        std::fwrite(&head, sizeof head, 1, file) == 1 && write_samples(file, interleaved);
    // A full disk may show only when the rest goes out.
    if (std::fclose(file) != 0 || !wrote) {
        return fail(path.string() + ": cannot be written whole; is the disk full?");
    }
    return pending->commit();
}

}  // namespace raks::audio
