#include <sndfile.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/ffmpeg_tags.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

// After a seek in Vorbis, libsndfile 1.2.0 is wrong for up to 1000 samples, and 1000 samples late
// in the last page (a page holds up to about a second). So seeks go this far before the target and
// read on to it. From some places they are late by as much however far they go; from the start they
// are not, so that they go there first.
constexpr double kVorbisPrerollSeconds = 2.0;
constexpr double kLeastMissing = 0.01;  // seconds: less is padding

struct CloseSndfile {
    void operator()(SNDFILE* file) const noexcept { sf_close(file); }
};
using SndfileHandle = std::unique_ptr<SNDFILE, CloseSndfile>;

// libsndfile's name of the container format.
std::string format_name(int format) {
    SF_FORMAT_INFO info{};
    info.format = format & SF_FORMAT_TYPEMASK;
    const bool is_known = sf_command(nullptr, SFC_GET_FORMAT_INFO, &info, sizeof info) == 0;
    return is_known && info.name != nullptr ? info.name : "audio";
}

// libsndfile's reason. For a head that it cannot make sense of (a rate of 0, samples of 0 bits) it
// reports an internal error, which is put in plain words here.
std::string why_not_opened() {
    const std::string reason = sf_strerror(nullptr);
    const bool is_of_head = reason.find("nternal error") != std::string::npos;
    return is_of_head ? "its header is damaged (rate, channels or kind of samples)" : reason;
}

// libsndfile reads through these, so that it sees the window only.
WindowCursor& cursor_of(void* user_data) { return *static_cast<WindowCursor*>(user_data); }

SF_VIRTUAL_IO window_functions() {
    return {.get_filelen = [](void* data) -> sf_count_t { return cursor_of(data).window.size(); },
            .seek = [](sf_count_t offset, int whence, void* data) -> sf_count_t {
                return cursor_of(data).seek(offset, whence);
            },
            .read = [](void* bytes, sf_count_t count, void* data) -> sf_count_t {
                const auto size = static_cast<std::size_t>(std::max<sf_count_t>(count, 0));
                return static_cast<sf_count_t>(
                    cursor_of(data).read(std::span(static_cast<char*>(bytes), size)));
            },
            .write = nullptr,
            .tell = [](void* data) -> sf_count_t { return cursor_of(data).at; }};
}

class SndfileReader final : public AudioFileReader {
 public:
    SndfileReader(DecoderInput input,
                  std::unique_ptr<WindowCursor> cursor,
                  SndfileHandle file,
                  const SF_INFO& head)
        : input_(std::move(input)),
          cursor_(std::move(cursor)),
          file_(std::move(file)),
          claimed_frames_(head.frames) {
        add_note(warning_, input_.path, input_.note);
        info_.rate = SampleRate(head.samplerate);
        info_.channels = head.channels;
        info_.format = format_name(head.format);
        info_.tags = read_tags(input_.window);
        if ((head.format & SF_FORMAT_SUBMASK) == SF_FORMAT_VORBIS) {
            preroll_ = static_cast<sf_count_t>(kVorbisPrerollSeconds * head.samplerate);
        }
        // Without a length in the head libsndfile gives SF_COUNT_MAX.
        if (head.frames > 0 && head.frames < SF_COUNT_MAX) {
            info_.claimed_seconds = static_cast<double>(head.frames) / head.samplerate;
            info_.claimed_frames = head.frames;
        }
    }

    std::size_t read(std::span<float> interleaved) override {
        const auto wanted = static_cast<sf_count_t>(interleaved.size()) / info_.channels;
        const sf_count_t got =
            is_behind_end_ ? 0 : sf_readf_float(file_.get(), interleaved.data(), wanted);
        position_ += got;
        if (got <= 0 && !is_behind_end_ && !has_noted_end_) {
            has_noted_end_ = true;
            note_end();
        }
        return got > 0 ? static_cast<std::size_t>(got) : 0;
    }

    // A frame beyond the claimed end is no error: read() returns 0 there.
    Expected<void> seek(std::int64_t frame) override {
        is_behind_end_ = info_.claimed_seconds && frame >= claimed_frames_;
        position_ = frame;
        const sf_count_t from = std::max<sf_count_t>(frame - preroll_, 0);
        if (is_behind_end_) {
            return {};
        }
        const bool is_at_start = preroll_ == 0 || sf_seek(file_.get(), 0, SEEK_SET) == 0;
        if (!is_at_start || sf_seek(file_.get(), from, SEEK_SET) != from) {
            return fail(fmt::format("{}: cannot go to {:.2f} s: {}",
                                    input_.path.string(),
                                    static_cast<double>(frame) / info_.rate.hertz(),
                                    sf_strerror(file_.get())));
        }
        read_past(frame - from);
        return {};
    }

 private:
    // Decodes and discards frames.
    void read_past(sf_count_t frames) {
        constexpr sf_count_t kChunk = 4096;
        std::vector<float> chunk(static_cast<std::size_t>(kChunk * info_.channels));
        while (frames > 0) {
            const sf_count_t got =
                sf_readf_float(file_.get(), chunk.data(), std::min(frames, kChunk));
            if (got <= 0) {
                return;
            }
            frames -= got;
        }
    }

    // At the end: notes a file that is shorter than its head says, an error of the decoder, and a
    // file that grows.
    void note_end() {
        const double rate = info_.rate.hertz();
        // With all its bytes there, a codec's estimate of the length was too long.
        const bool is_short =
            info_.claimed_frames && position_ < claimed_frames_ && !input_.is_complete;
        const double missing =
            input_.missing_seconds +
            (is_short ? static_cast<double>(claimed_frames_ - position_) / rate : 0.0);
        if (is_short || missing >= kLeastMissing || input_.is_cut ||
            sf_error(file_.get()) != SF_ERR_NO_ERROR) {
            add_note(warning_,
                     input_.path,
                     cut_off_note(static_cast<double>(position_) / rate, missing));
        }
        if (input_.window.has_grown()) {
            add_note(warning_, input_.path, kHasGrown);
        }
    }

    DecoderInput input_;
    std::unique_ptr<WindowCursor> cursor_;  // what file_ reads: outlives it
    SndfileHandle file_;
    sf_count_t claimed_frames_;
    sf_count_t preroll_ = 0;  // frames before a seek's target that are read past
    std::int64_t position_ = 0;
    bool is_behind_end_ = false;
    bool has_noted_end_ = false;
};

}  // namespace

Expected<AudioFileReaderPtr> open_by_sndfile(const DecoderInput& input) {
    auto cursor = std::make_unique<WindowCursor>(WindowCursor{input.window});
    SF_VIRTUAL_IO functions = window_functions();
    SF_INFO head{};
    SndfileHandle file(sf_open_virtual(&functions, SFM_READ, &head, cursor.get()));
    if (!file) {
        return fail(input.path.string() + ": is not audio that can be read: " + why_not_opened());
    }
    if (auto checked = check_head(input.path, head.samplerate, head.channels); !checked) {
        return fail(checked.error());
    }
    return std::make_unique<SndfileReader>(input, std::move(cursor), std::move(file), head);
}

}  // namespace raks::audio
