#include "audio/io/resampled_reader.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "audio/io/downmix.hpp"
#include "audio/resample/resampler.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kInnerFrames = 1024;  // read at once
// The resampler's filter is 80 samples long at the lower of the two rates; so many samples before
// a place decide what is there.
constexpr std::int64_t kFilterFrames = 128;

// Interleaved frames with `to` channels out of such with `from`.
void mix_channels(std::span<const float> in,
                  std::size_t from,
                  std::size_t to,
                  std::span<float> out) {
    if (from == to) {
        std::copy(in.begin(), in.end(), out.begin());
    } else if (to == 1) {
        downmix_to_mono(in, from, out);
    } else if (to == 2) {
        downmix_to_stereo(in, from, out);
    } else {
        const std::size_t frames = in.size() / from;
        std::fill(out.begin(), out.end(), 0.0F);
        for (std::size_t i = 0; i < frames; ++i) {
            downmix_to_stereo(in.subspan(i * from, from), from, out.subspan(i * to, 2));
        }
    }
}

class ResampledReader final : public AudioFileReader {
 public:
    ResampledReader(AudioFileReaderPtr inner, Resampler resampler, const SoundForm& form)
        : inner_(std::move(inner)),
          resampler_(std::move(resampler)),
          from_(inner_->info().rate),
          raw_(kInnerFrames * static_cast<std::size_t>(inner_->info().channels)),
          mixed_(kInnerFrames * static_cast<std::size_t>(form.channels)) {
        info_ = inner_->info();
        info_.rate = form.rate;
        info_.channels = form.channels;
    }

    void add(const std::filesystem::path& path, std::string note) {
        path_ = path;
        note_ = std::move(note);
        take_warning();
    }

    std::size_t read(std::span<float> interleaved) override {
        const auto width = static_cast<std::size_t>(info_.channels);
        const std::size_t wanted = interleaved.size() / width;
        std::size_t done = 0;
        while (done < wanted) {
            if (pending_ == 0) {
                refill();
            }
            const std::size_t room = std::min<std::size_t>(
                wanted - done,
                static_cast<std::size_t>(std::max<std::int64_t>(total_ - position_, 0)));
            if (room == 0) {
                break;
            }
            done += convert(interleaved.subspan(done * width, room * width));
        }
        if (inner_->warning().size() != taken_warning_) {
            take_warning();
        }
        return done;
    }

    // Starts the resampler where both rates have a frame at the same moment, a filter's length
    // before the place: from there on it gives the same bits as from the start.
    Expected<void> seek(std::int64_t frame) override {
        const std::int64_t divisor = std::gcd(from_.hertz(), info_.rate.hertz());
        const std::int64_t in_step = from_.hertz() / divisor;
        const std::int64_t out_step = info_.rate.hertz() / divisor;
        const std::int64_t preroll =
            kFilterFrames * std::max(in_step, out_step) / std::min(in_step, out_step);
        const std::int64_t steps = std::max<std::int64_t>(frame - preroll, 0) / out_step;
        if (auto sought = inner_->seek(steps * in_step); !sought) {
            return sought;
        }
        resampler_.reset();
        pending_ = 0;
        taken_ = steps * in_step;
        position_ = steps * out_step;
        total_ = kUnknown;
        std::vector<float> skipped(kInnerFrames * static_cast<std::size_t>(info_.channels));
        while (position_ < frame) {
            const auto left = static_cast<std::size_t>(frame - position_);
            const std::size_t count = std::min(left, kInnerFrames);
            if (read(std::span(skipped).first(count * static_cast<std::size_t>(info_.channels))) ==
                0) {
                break;
            }
        }
        return {};
    }

 private:
    // The next frames of the file, or silence behind its end that brings out the last ones.
    void refill() {
        const auto width = static_cast<std::size_t>(inner_->info().channels);
        const std::size_t got = total_ == kUnknown ? inner_->read(raw_) : 0;
        if (got == 0 && total_ == kUnknown) {
            total_ = frames_at_rate(taken_, from_, info_.rate);
        }
        taken_ += static_cast<std::int64_t>(got);
        pending_at_ = 0;
        pending_ = got > 0 ? got : kInnerFrames;
        if (got > 0) {
            mix_channels(std::span(raw_).first(got * width),
                         width,
                         static_cast<std::size_t>(info_.channels),
                         mixed_);
        } else {
            std::fill(mixed_.begin(), mixed_.end(), 0.0F);
        }
    }

    // Frames made of what is pending.
    std::size_t convert(std::span<float> out) {
        const auto width = static_cast<std::size_t>(info_.channels);
        const auto progress = resampler_.process(
            std::span(mixed_).subspan(pending_at_ * width, pending_ * width), out);
        pending_at_ += progress.taken;
        pending_ -= progress.taken;
        position_ += static_cast<std::int64_t>(progress.made);
        return progress.made;
    }

    void take_warning() {
        warning_ = inner_->warning();
        add_note(warning_, path_, note_);
        taken_warning_ = inner_->warning().size();
    }

    static constexpr std::int64_t kUnknown = std::numeric_limits<std::int64_t>::max();

    AudioFileReaderPtr inner_;
    Resampler resampler_;
    SampleRate from_;
    std::vector<float> raw_;    // as read
    std::vector<float> mixed_;  // with our number of channels; pending_ frames from pending_at_ on
    std::size_t pending_ = 0;
    std::size_t pending_at_ = 0;
    std::int64_t taken_ = 0;     // frames read of the file
    std::int64_t position_ = 0;  // of the next frame made
    std::int64_t total_ = kUnknown;
    std::filesystem::path path_;
    std::string note_;
    std::size_t taken_warning_ = 0;  // length of the inner warning when it was taken
};

}  // namespace

std::int64_t frames_at_rate(std::int64_t frames, SampleRate from, SampleRate to) noexcept {
    // In two parts: the product of large numbers would not fit.
    const std::int64_t seconds = frames / from.hertz();
    const std::int64_t rest = frames % from.hertz();
    return seconds * to.hertz() + (rest * to.hertz() + from.hertz() - 1) / from.hertz();
}

SampleRate nearest_supported(SampleRate rate) noexcept {
    const int hertz = rate.hertz();
    int parts = 1;
    while (hertz / parts > 192'000 || (hertz / parts >= 8'000 && hertz % parts != 0)) {
        ++parts;
    }
    int times = 1;
    while (hertz > 0 && hertz * times < 8'000) {
        ++times;
    }
    const SampleRate whole(hertz / parts * times);
    // A rate without a whole part in the range.
    return whole.is_supported() ? whole : SampleRate(hertz > 192'000 ? 192'000 : 8'000);
}

Expected<AudioFileReaderPtr> resample_reader(AudioFileReaderPtr inner,
                                             const SoundForm& form,
                                             const std::filesystem::path& path,
                                             std::string note) {
    Resampler resampler;
    if (auto prepared = resampler.prepare(inner->info().rate, form.rate, form.channels);
        !prepared) {
        return fail(path.string() + ": " + prepared.error().message);
    }
    auto reader = std::make_unique<ResampledReader>(std::move(inner), std::move(resampler), form);
    reader->add(path, std::move(note));
    return reader;
}

}  // namespace raks::audio
