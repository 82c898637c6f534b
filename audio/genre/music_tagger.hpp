#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "audio/features/spectrum.hpp"
#include "audio/genre/tag_source.hpp"
#include "audio/genre/tagger_network.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

/// Tags a stream of mono samples at 16 kHz: says 50 words and 200 numbers of every patch of 2.99 s,
/// one after the other.
///
/// Frames of 512 samples, 256 apart, with a Hann window; power in 96 mel bands; a patch is brought
/// to -18 dBFS by the running level at its end (a mean over 10 s without silence; at most 40 dB
/// more), so that nothing later than the patch counts; log10(1 + 10000 power); the network. A patch
/// of which more than half is silence says nothing. A silence of 1.3 s ends the music: after it
/// level, patches and mean start anew with the first sound.
///
/// The same bits for any partition into blocks and on any machine.
/// Threads: one. Real-time: no allocation, but every 2.99 s a whole patch is computed at once
/// (TaggerRun): for a thread of its own, or for files.
class MusicTagger {
 public:
    static constexpr int kSampleRate = 16'000;  ///< hertz

    /// `network`: not null; shared with others.
    explicit MusicTagger(std::shared_ptr<const TaggerNetwork> network);

    /// Takes samples; true if a word was said, or taken back as the music has ended.
    bool process(std::span<const float> mono) noexcept RAKS_NONBLOCKING;
    /// Samples were lost: the patch that has begun is dropped.
    void lose() noexcept RAKS_NONBLOCKING;
    /// Other music follows: all is forgotten.
    void reset() noexcept RAKS_NONBLOCKING;
    /// The newest word; its time is for the caller to set.
    [[nodiscard]] const TaggerWord& word() const noexcept { return word_; }

 private:
    static constexpr std::size_t kFrame = 512;
    static constexpr std::size_t kBlock = 256;

    bool finish_block() noexcept;
    void measure_level(double power) noexcept;
    void finish_patch() noexcept;

    std::shared_ptr<const TaggerNetwork> network_;
    PowerSpectrum spectrum_;
    FilterBank filters_;
    TaggerRun run_;
    std::array<float, kFrame> frame_{};  // the block before, and the one that is filled
    std::size_t filled_ = 0;             // samples of the latter
    std::vector<float> mel_;             // of the patch: frames x bands, power
    std::size_t frames_ = 0;             // in mel_
    std::size_t sounding_ = 0;           // of them
    int quiet_blocks_ = 0;               // in a row, at most those of a silence
    double power_ = 0.0;                 // running mean square of what sounds
    int blocks_heard_ = 0;               // in power_, at most its window
    TaggerWord word_;
};

/// Tags the hops of an analyzer where it stands: each word is there with the hop that completes it.
/// Threads: one. Real-time: as MusicTagger.
class HopTagger final : public TagSource {
 public:
    /// `network`: not null.
    explicit HopTagger(std::shared_ptr<const TaggerNetwork> network);
    void hear(const TaggerHop& hop) noexcept RAKS_NONBLOCKING override;
    [[nodiscard]] const TaggerWord& word() noexcept RAKS_NONBLOCKING override { return word_; }

 private:
    MusicTagger tagger_;
    HopIndex next_ = 0;
    TaggerWord word_;
};

}  // namespace raks::audio
