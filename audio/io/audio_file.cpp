#include "audio/io/audio_file.hpp"

#include <sndfile.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <system_error>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/downmix.hpp"
#include "base/assert.hpp"
#include "base/file.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = 12;        // enough to tell the formats apart
constexpr std::size_t kChunkFrames = 16'384;  // decoded at once

// Whether libsndfile is asked first, by the file's first bytes. MP3 is not among them although
// libsndfile reads it: its mpg123 prints on stderr and its seeks are off by 58 samples.
bool is_for_sndfile(std::string_view head) {
    constexpr std::size_t kKindAt = 8;
    struct Magic {
        std::string_view start;
        std::string_view kind = "";  // of such files, behind their size
    };
    // RIFF files of other kinds go to FFmpeg: named .mp3, libsndfile would take them for MP3.
    constexpr std::array<Magic, 11> kMagic{{{"RIFF", "WAVE"},
                                            {"RIFX", "WAVE"},
                                            {"RF64", "WAVE"},
                                            {"riff"},
                                            {"FORM"},
                                            {"fLaC"},
                                            {"OggS"},
                                            {"caff"},
                                            {".snd"},
                                            {"dns."},
                                            {"Creative"}}};
    return std::any_of(kMagic.begin(), kMagic.end(), [head](const Magic& magic) {
        return head.starts_with(magic.start) &&
               (magic.kind.empty() ||
                (head.size() > kKindAt && head.substr(kKindAt).starts_with(magic.kind)));
    });
}

}  // namespace

Expected<void> check_head(const fs::path& path, int hertz, int channels) {
    if (!SampleRate(hertz).is_supported()) {
        return fail(path.string() + ": has a sample rate of " + std::to_string(hertz) +
                    " Hz, must be 8000 to 192000");
    }
    if (channels < 1 || channels > kMaxFileChannels) {
        return fail(path.string() + ": has " + std::to_string(channels) +
                    " channels, must be 1 to " + std::to_string(kMaxFileChannels));
    }
    return {};
}

// Reads the head once, to choose the decoder by content.
Expected<std::unique_ptr<AudioFileReader>> open_audio_file(const fs::path& path) {
    const auto head = read_file_start(path, kHeadBytes);
    if (!head) {
        return fail(head.error());
    }
    if (head->empty()) {
        return fail(path.string() + ": is empty");
    }
    if (is_for_sndfile(*head)) {
        // A file that libsndfile refuses may still be a video (AVI is RIFF, Theora is Ogg). If both
        // refuse it, libsndfile's reason is given.
        auto reader = open_by_sndfile(path);
        if (reader) {
            return reader;
        }
        auto second = open_by_ffmpeg(path);
        return second ? std::move(second) : std::move(reader);
    }
    return open_by_ffmpeg(path);
}

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
        downmix_to_mono(std::span(chunk).first(frames * channels),
                        channels,
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
    SF_INFO format{};
    format.samplerate = rate.hertz();
    format.channels = channels;
    format.format = SF_FORMAT_WAV | SF_FORMAT_PCM_16;
    SNDFILE* file = sf_open(pending->part().c_str(), SFM_WRITE, &format);
    if (file == nullptr) {
        return fail(path.string() + ": cannot be written: " + sf_strerror(nullptr));
    }
    // Without it libsndfile lets values beyond [-1, 1] wrap around.
    sf_command(file, SFC_SET_CLIPPING, nullptr, SF_TRUE);
    const auto count = static_cast<sf_count_t>(interleaved.size());
    const bool wrote = sf_write_float(file, interleaved.data(), count) == count;
    const bool closed = sf_close(file) == 0;
    std::error_code error;
    // A full disk may show only in the size.
    if (!wrote || !closed || fs::file_size(pending->part(), error) < 2 * interleaved.size()) {
        return fail(path.string() + ": cannot be written whole; is the disk full?");
    }
    return pending->commit();
}

}  // namespace raks::audio
