#include "audio/io/chained_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "audio/io/resampled_reader.hpp"

namespace raks::audio {
namespace {

// A stream and its place in the whole, in frames at the first stream's rate.
struct Link {
    DecoderInput input;
    std::size_t number = 0;  // among the inputs
    std::int64_t begin = 0;
    std::int64_t end = 0;
};

// Frames that the reader gives: as claimed, or counted by reading to the end.
std::int64_t frames_of_link(AudioFileReader& reader) {
    const AudioFileInfo& info = reader.info();
    if (info.claimed_frames) {
        return *info.claimed_frames;
    }
    std::vector<float> chunk(4096 * static_cast<std::size_t>(info.channels));
    std::int64_t frames = 0;
    while (const std::size_t got = reader.read(chunk)) {
        frames += static_cast<std::int64_t>(got);
    }
    return frames;
}

class ChainedReader final : public AudioFileReader {
 public:
    ChainedReader(const std::filesystem::path& path, OpenLink open)
        : path_(path), open_(std::move(open)) {}

    // Opens each link for its length.
    Expected<void> measure(const std::vector<DecoderInput>& inputs) {
        std::optional<Error> first_fault;
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            auto opened = open_(inputs[i], i);
            if (!opened) {
                first_fault = first_fault ? first_fault : opened.error();
                ++lost_links_;
                continue;
            }
            take_length(inputs[i], i, **opened);
        }
        if (links_.empty()) {
            return fail(*first_fault);
        }
        info_.claimed_frames = links_.back().end;
        info_.claimed_seconds =
            static_cast<double>(links_.back().end) / static_cast<double>(info_.rate.hertz());
        say_what_changed(inputs.size());
        return {};
    }

    std::size_t read(std::span<float> interleaved) override {
        const auto width = static_cast<std::size_t>(info_.channels);
        const std::size_t wanted = interleaved.size() / width;
        std::size_t done = 0;
        while (done < wanted && position_ < links_.back().end) {
            const std::size_t index = link_at(position_);
            if (!reader_ || index != open_link_) {
                open_at(index, position_);
            }
            const auto left = static_cast<std::size_t>(links_[index].end - position_);
            const std::size_t count = std::min(wanted - done, left);
            read_link(interleaved.subspan(done * width, count * width));
            done += count;
            position_ += static_cast<std::int64_t>(count);
        }
        return done;
    }

    Expected<void> seek(std::int64_t frame) override {
        position_ = frame;
        reader_.reset();  // opened again where it is needed
        return {};
    }

 private:
    void take_length(const DecoderInput& input, std::size_t number, AudioFileReader& reader) {
        const AudioFileInfo& info = reader.info();
        if (links_.empty()) {
            info_ = info;
        }
        has_other_form_ =
            has_other_form_ || info.rate != info_.rate || info.channels != info_.channels;
        const std::int64_t begin = links_.empty() ? 0 : links_.back().end;
        const std::int64_t frames = frames_at_rate(frames_of_link(reader), info.rate, info_.rate);
        if (frames > 0 || links_.empty()) {
            links_.push_back({input, number, begin, begin + frames});
        }
    }

    void say_what_changed(std::size_t count) {
        if (has_other_form_) {
            add_note(warning_,
                     path_,
                     fmt::format("its streams differ in rate or channels; all are brought to the "
                                 "first's {} Hz and {} channel{}",
                                 info_.rate.hertz(),
                                 info_.channels,
                                 info_.channels == 1 ? "" : "s"));
        }
        if (lost_links_ > 0) {
            add_note(warning_,
                     path_,
                     fmt::format("{} of its {} streams cannot be read", lost_links_, count));
        }
    }

    // The link that holds this frame, which lies before the end.
    [[nodiscard]] std::size_t link_at(std::int64_t frame) const {
        const auto next = std::upper_bound(
            links_.begin(), links_.end(), frame, [](std::int64_t place, const Link& link) {
                return place < link.end;
            });
        return static_cast<std::size_t>(next - links_.begin());
    }

    // Opens a link at a frame of the whole. Where that fails it stays silent.
    void open_at(std::size_t index, std::int64_t frame) {
        const Link& link = links_[index];
        open_link_ = index;
        reader_.reset();
        auto opened = open_(link.input, link.number);
        if (opened && ((*opened)->info().rate != info_.rate ||
                       (*opened)->info().channels != info_.channels)) {
            opened = resample_reader(
                std::move(*opened), {info_.rate, info_.channels}, link.input.path, {});
        }
        const bool is_ready =
            opened && (frame == link.begin || (*opened)->seek(frame - link.begin));
        if (is_ready) {
            reader_ = std::move(*opened);
        } else {
            note_loss(frame);
        }
    }

    // Fills the block from the open link; what it does not give is silence.
    void read_link(std::span<float> block) {
        const auto width = static_cast<std::size_t>(info_.channels);
        std::size_t done = 0;
        while (reader_ && done < block.size()) {
            const std::size_t got = reader_->read(block.subspan(done));
            if (got == 0) {
                note_loss(position_ + static_cast<std::int64_t>(done / width));
                break;
            }
            done += got * width;
        }
        std::fill(block.begin() + static_cast<std::ptrdiff_t>(done), block.end(), 0.0F);
    }

    // Says once that something is missing.
    void note_loss(std::int64_t frame) {
        if (!has_loss_) {
            has_loss_ = true;
            add_note(warning_,
                     path_,
                     fmt::format("is damaged at {:.2f} s; it is silent where sound is missing",
                                 static_cast<double>(frame) / info_.rate.hertz()));
        }
    }

    std::filesystem::path path_;
    OpenLink open_;
    std::vector<Link> links_;
    std::size_t lost_links_ = 0;
    bool has_other_form_ = false;
    bool has_loss_ = false;
    std::int64_t position_ = 0;
    AudioFileReaderPtr reader_;  // of the link open_link_
    std::size_t open_link_ = 0;
};

}  // namespace

Expected<AudioFileReaderPtr> open_chain(const std::vector<DecoderInput>& links,
                                        const OpenLink& open) {
    auto reader = std::make_unique<ChainedReader>(links.front().path, open);
    if (auto measured = reader->measure(links); !measured) {
        return fail(measured.error());
    }
    return reader;
}

}  // namespace raks::audio
