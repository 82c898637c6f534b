#include "audio/io/decoders.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/chained_reader.hpp"
#include "audio/io/flac_length.hpp"
#include "audio/io/hearing_survey.hpp"
#include "audio/io/mended_head.hpp"
#include "audio/io/ogg_links.hpp"
#include "audio/io/resampled_reader.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = 12;  // enough to tell the formats apart
constexpr int kLeastHertz = 1'000;      // of a file; brought into Raks' range
constexpr int kMostHertz = 3'000'000;   // DSD of the highest rate, as FFmpeg decodes it

// Whether libsndfile is asked first, by the file's first bytes. MP3 is not among them although
// libsndfile reads it: its mpg123 prints on stderr and its seeks are off by 58 samples.
bool is_for_sndfile(std::string_view head) {
    constexpr std::size_t kKindAt = 8;
    struct Magic {
        std::string_view start;
        std::string_view kind = "";  // of such files, behind their size
    };
    // RIFF files of other kinds go to FFmpeg: named .mp3, libsndfile would take them for MP3.
    constexpr std::array<Magic, 12> kMagic{{{"RIFF", "WAVE"},
                                            {"RIFX", "WAVE"},
                                            {"RF64", "WAVE"},
                                            {"BW64", "WAVE"},
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
    if (hertz < kLeastHertz || hertz > kMostHertz) {
        return fail(fmt::format("{}: has a sample rate of {} Hz, must be {} to {}",
                                path.string(),
                                hertz,
                                kLeastHertz,
                                kMostHertz));
    }
    if (channels < 1 || channels > kMaxFileChannels) {
        return fail(path.string() + ": has " + std::to_string(channels) +
                    " channels, must be 1 to " + std::to_string(kMaxFileChannels));
    }
    return {};
}

void add_note(std::string& warning, const fs::path& path, std::string_view note) {
    if (!note.empty()) {
        warning += (warning.empty() ? path.string() + ": " : "; ") + std::string(note);
    }
}

std::string cut_off_note(double at_seconds, double missing_seconds) {
    std::string note = fmt::format("is damaged or cut off at {:.2f} s", at_seconds);
    return missing_seconds < 0.005 ? note
                                   : note + fmt::format("; {:.2f} s are missing", missing_seconds);
}

namespace {

// A file that libsndfile refuses may still be a video (AVI is RIFF, Theora is Ogg). If both refuse
// it, libsndfile's reason is given.
Expected<AudioFileReaderPtr> open_by_either(const DecoderInput& input) {
    auto reader = open_by_sndfile(input);
    if (reader) {
        return reader;
    }
    auto second = open_by_ffmpeg(input);
    return second ? std::move(second) : std::move(reader);
}

// FFmpeg knows the time of each page, so that it can tell where some are missing; and libsndfile
// (1.2.0) throws a packet of Opus away where a granule position is too small for it.
Expected<AudioFileReaderPtr> open_ogg_link(const DecoderInput& input, const OggLink& link) {
    if (!link.has_hole && !link.has_loose_stamps) {
        return open_by_either(input);
    }
    auto reader = open_by_ffmpeg(input);
    return reader ? std::move(reader) : open_by_sndfile(input);
}

Expected<AudioFileReaderPtr> open_ogg(const fs::path& path, const FileWindow& window) {
    const OggPages pages = read_ogg_pages(window);
    if (pages.links.empty()) {
        return open_by_either({path, window});
    }
    std::vector<DecoderInput> inputs;
    for (const OggLink& link : pages.links) {
        inputs.push_back({path, window.part(link.begin, link.end)});
        inputs.back().has_loose_stamps = link.has_loose_stamps && !link.has_hole;
    }
    inputs.back().is_cut = pages.is_cut;
    if (inputs.size() == 1) {
        return open_ogg_link(inputs.front(), pages.links.front());
    }
    return open_chain(inputs, [pages](const DecoderInput& input, std::size_t index) {
        return open_ogg_link(input, pages.links[index]);
    });
}

Expected<AudioFileReaderPtr> open_flac(const fs::path& path, const FileWindow& window) {
    const FlacLength length = read_flac_length(window);
    if (length.starts.size() == 1) {
        DecoderInput input{path, length.window};
        if (length.claimed > 0 && length.found > length.claimed) {
            input.note = "holds more sound than its header says; it is read to its end";
        }
        return open_by_either(input);
    }
    std::vector<DecoderInput> inputs;
    for (std::size_t i = 0; i < length.starts.size(); ++i) {
        const bool is_last = i + 1 == length.starts.size();
        const std::int64_t end = is_last ? window.size() : length.starts[i + 1];
        inputs.push_back({path, read_flac_length(window.part(length.starts[i], end)).window});
    }
    return open_chain(inputs,
                      [](const DecoderInput& input, std::size_t) { return open_by_either(input); });
}

// A file of one of the kinds whose heads are mended.
Expected<AudioFileReaderPtr> open_mended(const fs::path& path, const FileWindow& window) {
    const MendedHead head = mend_head(window);
    DecoderInput input{path, head.window};
    input.missing_seconds = head.missing_seconds;
    input.is_complete = head.is_complete;
    if (head.has_no_length) {
        input.note = "its header gives no length; it is read to the end of the file";
    }
    return open_by_either(input);
}

// Chooses the decoder by content.
Expected<AudioFileReaderPtr> open_decoder(const fs::path& name, const FileWindow& file) {
    const std::string head = file.bytes(0, kHeadBytes);
    if (head.empty()) {
        return fail(name.string() + ": is empty");
    }
    if (head.starts_with("OggS")) {
        return open_ogg(name, file);
    }
    if (head.starts_with("fLaC")) {
        return open_flac(name, file);
    }
    return is_for_sndfile(head) ? open_mended(name, file) : open_by_ffmpeg({name, file});
}

// Brings rates outside Raks' range into it.
Expected<AudioFileReaderPtr> open_at_known_rate(const fs::path& name, const FileWindow& file) {
    auto reader = open_decoder(name, file);
    if (!reader || (*reader)->info().rate.is_supported()) {
        return reader;
    }
    const AudioFileInfo& info = (*reader)->info();
    const SoundForm form{nearest_supported(info.rate), info.channels};
    std::string note = fmt::format("has {} Hz; resampled to {} Hz, as Raks works at 8000 to 192000",
                                   info.rate.hertz(),
                                   form.rate.hertz());
    return resample_reader(std::move(*reader), form, name, std::move(note));
}

}  // namespace

Expected<AudioFileReaderPtr> open_by_decoders(const fs::path& name, const FileWindow& file) {
    const auto open = [&name, &file] { return open_at_known_rate(name, file); };
    auto reader = open();
    if (!reader) {
        return reader;
    }
    return survey_reader(std::move(*reader), name, open);
}

}  // namespace raks::audio
