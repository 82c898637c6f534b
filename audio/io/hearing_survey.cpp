#include "audio/io/hearing_survey.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "audio/io/downmix.hpp"

namespace raks::audio {
namespace {

constexpr double kBlockSeconds = 0.1;
constexpr std::size_t kEnoughBlocks = 10;       // of sound, to know that a file is ordinary
constexpr std::size_t kEnoughToDecide = 3;      // of sound, to take it for anything else
constexpr double kSilent = 1e-6;                // RMS: digital silence
constexpr double kSoft = 0.0056;                // RMS of the loudest block, -45 dBFS: below, softly
constexpr double kVerySoft = 0.001;             // RMS: may be the noise of a converter alone
constexpr double kOverFullScale = 1.5;          // RMS of the usual block
constexpr double kUsualLevel = 0.1;             // RMS to which others are brought, -20 dBFS
constexpr double kMostOffset = 4.0;             // times the sound's level, before it is taken out
constexpr double kMostMid = 0.01;               // of the side's power: then one side is inverted
constexpr double kOrdinaryMid = 0.05;           // of the side's power
constexpr double kLongestSurvey = 600.0;        // seconds of a file out of the usual
constexpr std::size_t kKeptSamples = 2 << 20U;  // decoded and kept for the first reads
constexpr std::size_t kSurveyFrames = 4096;

}  // namespace

HearingSurvey::HearingSurvey(SampleRate rate, int channels)
    : channels_(static_cast<std::size_t>(channels)),
      block_frames_(static_cast<std::size_t>(kBlockSeconds * rate.hertz())) {}

void HearingSurvey::add(std::span<const float> interleaved) {
    const std::size_t frames = interleaved.size() / channels_;
    stereo_.resize(2 * frames);
    downmix_to_stereo(interleaved, channels_, stereo_);
    for (std::size_t i = 0; i < frames; ++i) {
        const auto left = static_cast<double>(stereo_[2 * i]);
        const auto right = static_cast<double>(stereo_[2 * i + 1]);
        if (std::isfinite(left) && std::isfinite(right)) {
            sum_left_ += left;
            sum_right_ += right;
            squares_left_ += left * left;
            squares_right_ += right * right;
            products_ += left * right;
        }
        if (++frames_ == block_frames_) {
            finish_block();
        }
    }
}

// Variances and covariance of the sides give the powers of mid and side.
void HearingSurvey::finish_block() {
    const auto count = static_cast<double>(frames_);
    const double mean_left = sum_left_ / count;
    const double mean_right = sum_right_ / count;
    const double left = std::max(squares_left_ / count - mean_left * mean_left, 0.0);
    const double right = std::max(squares_right_ / count - mean_right * mean_right, 0.0);
    const double both = products_ / count - mean_left * mean_right;
    const Block block{.level = std::sqrt(0.5 * (left + right)),
                      .mid = std::max(0.25 * (left + right + 2.0 * both), 0.0),
                      .side = std::max(0.25 * (left + right - 2.0 * both), 0.0)};
    if (block.level > kSilent) {
        sounding_.push_back(block);
        mid_ += block.mid;
        side_ += block.side;
        offset_ += 0.5 * (mean_left + mean_right);
    }
    frames_ = 0;
    sum_left_ = sum_right_ = squares_left_ = squares_right_ = products_ = 0.0;
}

bool HearingSurvey::is_upside_down() const {
    return channels_ == 2 && sounding_.size() >= kEnoughToDecide && mid_ < kMostMid * side_;
}

double HearingSurvey::loudest() const {
    double level = 0.0;
    for (const Block& block : sounding_) {
        level = std::max(level, block.level);
    }
    return level;
}

// The level that half of the blocks exceed: one bent sample is not the usual.
double HearingSurvey::usual() const {
    if (sounding_.empty()) {
        return 0.0;
    }
    std::vector<double> levels;
    for (const Block& block : sounding_) {
        levels.push_back(block.level);
    }
    const auto middle = levels.begin() + static_cast<std::ptrdiff_t>(levels.size() / 2);
    std::nth_element(levels.begin(), middle, levels.end());
    return *middle;
}

double HearingSurvey::mean() const {
    return sounding_.empty() ? 0.0 : offset_ / static_cast<double>(sounding_.size());
}

bool HearingSurvey::is_ordinary() const {
    const double loud = loudest();
    return sounding_.size() >= kEnoughBlocks && loud >= kSoft && usual() <= kOverFullScale &&
           mid_ >= kOrdinaryMid * side_ && std::abs(mean()) <= kMostOffset * loud;
}

// For soft sound and sound far above full scale; 1 for all else. What is very soft and always
// equally loud is the noise of a converter, not music.
float HearingSurvey::gain_for(double level) const {
    if (sounding_.size() < kEnoughToDecide) {
        return 1.0F;
    }
    if (usual() > kOverFullScale) {
        return static_cast<float>(kUsualLevel / usual());
    }
    const bool is_noise = level < kVerySoft && level < 1.5 * usual();
    return level < kSoft && !is_noise ? static_cast<float>(kUsualLevel / level) : 1.0F;
}

Hearing HearingSurvey::hearing() const {
    Hearing hearing;
    const double loud = loudest();
    hearing.is_from_side = is_upside_down();
    hearing.gain = gain_for(loud);
    const bool is_far_off = std::abs(mean()) > kMostOffset * loud && std::abs(mean()) > kSoft;
    if (is_far_off && sounding_.size() >= kEnoughToDecide && !hearing.is_from_side) {
        hearing.offset = static_cast<float>(mean());
    }
    return hearing;
}

std::string HearingSurvey::note() const {
    const Hearing heard = hearing();
    std::string text;
    const auto append = [&text](const std::string& more) {
        text += (text.empty() ? "" : "; ") + more;
    };
    if (heard.is_from_side) {
        append(
            "left and right cancel each other, as from a wrongly wired cable; their difference "
            "is listened to");
    }
    if (heard.offset != 0.0F) {
        append(fmt::format("its waveform lies {:.2f} off the middle; Raks listens without that",
                           static_cast<double>(heard.offset)));
    }
    if (heard.gain > 1.0F) {
        append(fmt::format("is very soft; Raks listens to it {:.0f} dB louder",
                           20.0 * std::log10(static_cast<double>(heard.gain))));
    } else if (heard.gain < 1.0F) {
        append(fmt::format("is far above full scale; Raks listens to it {:.0f} dB softer",
                           -20.0 * std::log10(static_cast<double>(heard.gain))));
    }
    return text;
}

namespace {

// Gives what the survey decoded, and then the rest of the file.
class SurveyedReader final : public AudioFileReader {
 public:
    SurveyedReader(AudioFileReaderPtr inner, const std::filesystem::path& path)
        : inner_(std::move(inner)), path_(path) {
        info_ = inner_->info();
    }

    Expected<void> survey(const std::function<Expected<AudioFileReaderPtr>()>& open);

    std::size_t read(std::span<float> interleaved) override {
        const auto width = static_cast<std::size_t>(info_.channels);
        const std::size_t wanted = interleaved.size() / width;
        const std::size_t silent = static_cast<std::size_t>(
            std::min<std::int64_t>(silent_, static_cast<std::int64_t>(wanted)));
        std::fill_n(interleaved.begin(), silent * width, 0.0F);
        silent_ -= static_cast<std::int64_t>(silent);
        const std::size_t kept = std::min(wanted - silent, (kept_.size() - kept_at_) / width);
        std::copy_n(kept_.data() + kept_at_, kept * width, interleaved.data() + silent * width);
        kept_at_ += kept * width;
        if (kept_at_ == kept_.size()) {
            kept_ = {};
            kept_at_ = 0;
        }
        std::size_t done = silent + kept;
        if (done < wanted) {
            done += inner_->read(interleaved.subspan(done * width));
            if (inner_->warning().size() != taken_) {
                take_warning();
            }
        }
        return done;
    }

    Expected<void> seek(std::int64_t frame) override {
        silent_ = 0;
        kept_ = {};
        kept_at_ = 0;
        return inner_->seek(frame);
    }

 private:
    void keep(std::span<const float> block, bool is_silence);
    void take_warning() {
        warning_ = inner_->warning();
        add_note(warning_, path_, note_);
        taken_ = inner_->warning().size();
    }

    AudioFileReaderPtr inner_;
    std::filesystem::path path_;
    std::string note_;
    std::size_t taken_ = 0;    // length of the inner warning when it was taken
    std::int64_t silent_ = 0;  // frames of digital silence at the start, not kept as samples
    std::vector<float> kept_;  // decoded after them
    std::size_t kept_at_ = 0;  // samples of it that were read
};

void SurveyedReader::keep(std::span<const float> block, bool is_silence) {
    if (is_silence && kept_.empty()) {
        silent_ += static_cast<std::int64_t>(block.size()) / info_.channels;
    } else {
        kept_.insert(kept_.end(), block.begin(), block.end());
    }
}

// Decodes until the file shows itself ordinary. What comes beyond kKeptSamples is not kept: then
// the file is opened again.
Expected<void> SurveyedReader::survey(const std::function<Expected<AudioFileReaderPtr>()>& open) {
    const auto width = static_cast<std::size_t>(info_.channels);
    HearingSurvey heard(info_.rate, info_.channels);
    std::vector<float> chunk(kSurveyFrames * width);
    bool is_kept = true;
    std::int64_t left = static_cast<std::int64_t>(kLongestSurvey * info_.rate.hertz());
    while (left > 0 && !heard.is_ordinary()) {
        const std::size_t got = inner_->read(chunk);
        if (got == 0) {
            break;
        }
        const auto block = std::span<const float>(chunk).first(got * width);
        heard.add(block);
        left -= static_cast<std::int64_t>(got);
        is_kept = is_kept && kept_.size() + block.size() <= kKeptSamples;
        if (is_kept) {
            keep(block, std::all_of(block.begin(), block.end(), [](float x) { return x == 0.0F; }));
        }
    }
    if (!is_kept) {
        auto again = open();
        if (!again) {
            return fail(again.error());
        }
        inner_ = std::move(*again);
        silent_ = 0;
        kept_ = {};
    }
    if (!heard.is_ordinary()) {
        info_.hearing = heard.hearing();
        note_ = heard.note();
    }
    take_warning();
    return {};
}

}  // namespace

Expected<AudioFileReaderPtr> survey_reader(
    AudioFileReaderPtr inner,
    const std::filesystem::path& path,
    const std::function<Expected<AudioFileReaderPtr>()>& open) {
    auto reader = std::make_unique<SurveyedReader>(std::move(inner), path);
    if (auto surveyed = reader->survey(open); !surveyed) {
        return fail(surveyed.error());
    }
    return reader;
}

}  // namespace raks::audio
