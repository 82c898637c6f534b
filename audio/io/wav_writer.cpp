#include "audio/io/wav_writer.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "base/assert.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kChunkSamples = 16'384;                         // written at once
constexpr std::int64_t kMaxSamples = (std::int64_t{1} << 31) - 1024;  // WAV ends at 4 GiB

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

}  // namespace

Expected<WavWriter> WavWriter::create(const std::filesystem::path& path,
                                      std::int64_t frames,
                                      int channels,
                                      SampleRate rate) {
    RAKS_ASSERT(channels >= 1 && frames >= 0);
    if (frames > kMaxSamples / channels) {
        return fail(path.string() + ": would be larger than 4 GiB, the limit of WAV");
    }
    auto file = PendingFile::create(path);
    if (!file) {
        return fail(file.error());
    }
    const std::int64_t samples = frames * channels;
    const WavHead head = wav_head(static_cast<std::size_t>(samples), channels, rate);
    if (auto wrote = file->write({reinterpret_cast<const char*>(&head), sizeof head}); !wrote) {
        return fail(wrote.error());
    }
    return WavWriter(std::move(*file), samples);
}

Expected<void> WavWriter::write(std::span<const float> interleaved) {
    missing_ -= static_cast<std::int64_t>(interleaved.size());
    RAKS_ASSERT(missing_ >= 0);
    std::vector<std::int16_t> chunk;
    while (!interleaved.empty()) {
        const auto piece = interleaved.first(std::min(interleaved.size(), kChunkSamples));
        chunk.resize(piece.size());
        std::transform(piece.begin(), piece.end(), chunk.begin(), to_16_bits);
        const auto* const bytes = reinterpret_cast<const char*>(chunk.data());
        if (auto wrote = file_.write({bytes, sizeof(std::int16_t) * chunk.size()}); !wrote) {
            return wrote;
        }
        interleaved = interleaved.subspan(piece.size());
    }
    return {};
}

Expected<void> WavWriter::commit() {
    RAKS_ASSERT(missing_ == 0);
    return file_.commit();
}

Expected<void> write_wav(const std::filesystem::path& path,
                         std::span<const float> interleaved,
                         int channels,
                         SampleRate rate) {
    auto writer = WavWriter::create(
        path, static_cast<std::int64_t>(interleaved.size()) / channels, channels, rate);
    if (!writer) {
        return fail(writer.error());
    }
    auto wrote = writer->write(interleaved);
    return wrote ? writer->commit() : wrote;
}

}  // namespace raks::audio
