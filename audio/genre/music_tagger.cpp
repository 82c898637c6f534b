#include "audio/genre/music_tagger.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "base/decibels.hpp"

namespace raks::audio {
namespace {

constexpr double kTargetPower = 0.015848931924611134;       // -18 dBFS
constexpr double kQuietPower = 1.5848931924611134e-6;       // -58 dBFS: below is silence
constexpr double kMostAmplification = 1e4;                  // of power: 40 dB
constexpr int kLevelBlocks = 625;                           // 10 s
constexpr int kSilentBlocks = 82;                           // 1.3 s
constexpr std::size_t kLeastSounding = kTagFrames / 2 + 1;  // frames of a patch that says something

// 0.5 - 0.5 cos over one whole period, of which the last sample would repeat the first.
std::vector<float> periodic_hann(std::size_t size) {
    std::vector<float> window(size);
    for (std::size_t i = 0; i < size; ++i) {
        const double angle = 2.0 * M_PI * static_cast<double>(i) / static_cast<double>(size);
        window[i] = static_cast<float>(0.5 - 0.5 * std::cos(angle));
    }
    return window;
}

// Slaney's mel scale: linear to 1 kHz, above it 27 steps for a factor of 6.4.
double hertz_of_slaney(double mel) {
    return mel < 15.0 ? mel * 200.0 / 3.0 : 1000.0 * std::exp((mel - 15.0) * std::log(6.4) / 27.0);
}

// Triangles of area 1, equally spaced on that scale from 0 Hz to half the sample rate.
FilterBank slaney_filters(std::size_t frame) {
    const double highest = 15.0 + std::log(8.0) / (std::log(6.4) / 27.0);  // of 8 kHz
    const auto edge = [highest](std::size_t i) {
        return hertz_of_slaney(highest * static_cast<double>(i) / (kTagBands + 1.0));
    };
    std::vector<FilterBank::Filter> filters(kTagBands);
    for (std::size_t band = 0; band < kTagBands; ++band) {
        const double low = edge(band);
        const double middle = edge(band + 1);
        const double high = edge(band + 2);
        FilterBank::Filter& filter = filters[band];
        for (std::size_t bin = 0; bin <= frame / 2; ++bin) {
            const double hertz =
                static_cast<double>(bin) * MusicTagger::kSampleRate / static_cast<double>(frame);
            const double height =
                std::min((hertz - low) / (middle - low), (high - hertz) / (high - middle));
            if (height <= 0.0) {
                continue;
            }
            if (filter.weights.empty()) {
                filter.first_bin = static_cast<int>(bin);
            }
            filter.weights.push_back(static_cast<float>(height * 2.0 / (high - low)));
        }
    }
    return FilterBank(std::move(filters));
}

}  // namespace

std::array<std::size_t, 3> strongest_tags(const TaggerWord& word) noexcept RAKS_NONBLOCKING {
    std::array<std::size_t, 3> tags{};
    std::array<bool, kTags> is_taken{};
    for (std::size_t& strongest : tags) {
        std::size_t best = kTags;
        for (std::size_t tag = 0; tag < kTags; ++tag) {
            const bool is_stronger =
                best == kTags || word.mean_logits[tag] > word.mean_logits[best];
            best = !is_taken[tag] && is_stronger ? tag : best;
        }
        is_taken[best] = true;
        strongest = best;
    }
    return tags;
}

MusicTagger::MusicTagger(std::shared_ptr<const TaggerNetwork> network)
    : network_(std::move(network)),
      spectrum_(periodic_hann(kFrame), static_cast<int>(kFrame)),
      filters_(slaney_filters(kFrame)),
      mel_(kTagFrames * kTagBands) {
    reset();
}

void MusicTagger::reset() noexcept RAKS_NONBLOCKING {
    lose();
    quiet_blocks_ = kSilentBlocks;
    power_ = 0.0;
    blocks_heard_ = 0;
    word_ = {};
}

void MusicTagger::lose() noexcept RAKS_NONBLOCKING {
    frame_.fill(0.0F);
    filled_ = 0;
    frames_ = 0;
    sounding_ = 0;
}

bool MusicTagger::process(std::span<const float> mono) noexcept RAKS_NONBLOCKING {
    const FlushToZeroScope flush_to_zero;
    bool has_news = false;
    while (!mono.empty()) {
        const std::size_t count = std::min(mono.size(), kBlock - filled_);
        std::copy_n(mono.data(), count, frame_.data() + kBlock + filled_);
        filled_ += count;
        mono = mono.subspan(count);
        if (filled_ == kBlock) {
            has_news = finish_block() || has_news;
            std::copy_n(frame_.data() + kBlock, kBlock, frame_.data());
            filled_ = 0;
        }
    }
    return has_news;
}

// At first a mean of all, then one that forgets.
void MusicTagger::measure_level(double power) noexcept {
    blocks_heard_ = std::min(blocks_heard_ + 1, kLevelBlocks);
    power_ += (power - power_) / blocks_heard_;
}

// One more frame. True: the word has changed.
bool MusicTagger::finish_block() noexcept {
    const double power = mean_square(std::span(frame_).last(kBlock));
    const bool sounds = power > kQuietPower;
    const bool was_silent = quiet_blocks_ == kSilentBlocks;
    quiet_blocks_ = sounds ? 0 : std::min(quiet_blocks_ + 1, kSilentBlocks);
    if (quiet_blocks_ == kSilentBlocks) {
        const bool has_news = !was_silent && word_.patches > 0;
        frames_ = 0;
        sounding_ = 0;
        power_ = 0.0;
        blocks_heard_ = 0;
        word_ = was_silent ? word_ : TaggerWord();
        return has_news;
    }
    if (sounds) {
        measure_level(power);
        ++sounding_;
    }
    filters_.apply(spectrum_.compute(frame_),
                   std::span(mel_).subspan(frames_ * kTagBands, kTagBands));
    if (++frames_ < kTagFrames) {
        return false;
    }
    const bool has_word = sounding_ >= kLeastSounding;
    if (has_word) {
        finish_patch();
    }
    frames_ = 0;
    sounding_ = 0;
    return has_word;
}

void MusicTagger::finish_patch() noexcept {
    const auto gain = static_cast<float>(std::min(kTargetPower / power_, kMostAmplification));
    for (float& value : mel_) {
        value *= gain;
    }
    compress_mel(mel_);
    run_.compute(*network_, std::span(mel_).first<kTagFrames * kTagBands>());
    word_.embedding = run_.embedding();
    word_.logits = run_.logits();
    ++word_.patches;
    const float share = 1.0F / static_cast<float>(word_.patches);
    for (std::size_t i = 0; i < kTags; ++i) {
        word_.mean_logits[i] += (word_.logits[i] - word_.mean_logits[i]) * share;
    }
}

HopTagger::HopTagger(std::shared_ptr<const TaggerNetwork> network) : tagger_(std::move(network)) {}

void HopTagger::hear(const TaggerHop& hop) noexcept RAKS_NONBLOCKING {
    if (hop.is_other_music) {
        tagger_.reset();
        word_ = {};
    } else if (hop.hop != next_) {
        tagger_.lose();
    }
    next_ = hop.hop + 1;
    if (tagger_.process(hop.samples)) {
        word_ = tagger_.word();
        word_.until = time_of_hop(next_);
    }
}

}  // namespace raks::audio
