#pragma once

#include <array>
#include <span>
#include <vector>

#include "audio/features/rhythm_frames.hpp"
#include "audio/features/spectrum.hpp"
#include "base/music_state.hpp"
#include "base/realtime.hpp"

/// The beat tracker of the paper (Ofli et al. 2008, section 4.2, after Alonso, David, Richard 2004,
/// "Tempo and beat estimation of musical signals", sections 2.1 to 2.3): the reference for
/// comparison with the bar pointer. It finds no bars: bar positions are 0.
namespace raks::audio {

/// Spectral energy flux (Alonso, 2.1): E(n, k) = sum_i h(i) G(n - i, k), where G is |X| of a Hann
/// window of 32 ms, compressed by arcsinh and smoothed by a half Hann window, and h differentiates.
/// Half-wave rectified and summed over k it is the onset strength v(n); p(n) = max(0, v(n) -
/// threshold), with a threshold from a moving median, keeps the onsets and drops smaller
/// fluctuations.
///
/// Threads: one. Real-time: add and reset yes, making one no.
class PaperFlux {
 public:
    static constexpr int kHop = 320;      ///< samples at 32 kHz: 10 ms
    static constexpr int kWindow = 1024;  ///< samples at 32 kHz
    static constexpr int kDelay = 25;     ///< hops from a window to its frame: half the median's

    /// Onset strength of one hop.
    struct Frame {
        float strength = 0.0F;   ///< v, >= 0
        float threshold = 0.0F;  ///< moving median of v over 0.51 s and a floor, >= 0
        /// p: what exceeds the threshold, >= 0.
        [[nodiscard]] float onset() const noexcept {
            return strength > threshold ? strength - threshold : 0.0F;
        }
    };

    /// Plans the FFT and the filter.
    PaperFlux();

    /// Takes the next hop's window: kWindow samples around the hop's time, in [-1, 1]. Returns the
    /// frame of the hop kDelay hops ago (zeros before the first).
    Frame add(std::span<const float> window) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr std::size_t kBins = kWindow / 2 + 1;
    static constexpr std::size_t kSmoothing = 10;  // hops
    static constexpr std::size_t kMedian = 2 * kDelay + 1;

    [[nodiscard]] float flux() const noexcept;

    PowerSpectrum spectrum_;
    std::array<float, kSmoothing + 1> filter_{};  // smoothing and differentiation in one
    std::array<std::array<float, kBins>, kSmoothing + 1> compressed_{};  // G, ring by hop
    std::array<float, kMedian> strengths_{};                             // v, ring by hop
    std::size_t hops_ = 0;
};

/// Distance from a peak of the onsets p to the beat, in hops: negative as the smoothing delays the
/// peaks. Median over the reference excerpts.
inline constexpr double kPaperLagHops = -0.9;

/// Tempo and phase of one window of onsets.
struct PaperEstimate {
    double period_hops = 50.0;  ///< 30 to 100: 200 to 60 BPM
    double last_beat = 0.0;     ///< the last beat, in hops from the window's start
    float confidence = 0.0F;    ///< autocorrelation at the period over that at 0, [0, 1]
};

/// Tempo and phase of one window, computed in steps of about equal cost. Tempo: the autocorrelation
/// of p over the lags of 60 to 200 BPM; the period T is at its highest peak, or at half of that
/// when the peak there is nearly as high (Alonso, 2.2). Phase: the peak of the cross-correlation of
/// p with a pulse train of period T (2.3).
///
/// Threads: one. Real-time: yes.
class PaperWindow {
 public:
    static constexpr std::size_t kHops = 600;  ///< 6 s
    static constexpr int kSteps = 12;          ///< calls of step() before estimate()

    /// Starts a window: its onsets p, oldest first; at most the newest kHops are used.
    void begin(std::span<const float> onsets) noexcept RAKS_NONBLOCKING;
    /// One step; at most 7,000 multiplications.
    void step() noexcept RAKS_NONBLOCKING;
    /// Whether estimate() is that of the window begun last.
    [[nodiscard]] bool is_done() const noexcept { return steps_ == kSteps; }
    /// The estimate of the last finished window.
    [[nodiscard]] const PaperEstimate& estimate() const noexcept { return estimate_; }

 private:
    static constexpr std::size_t kShortest = 30;  // hops in a beat: 200 BPM
    static constexpr std::size_t kLongest = 100;  // hops in a beat: 60 BPM
    static constexpr std::size_t kLagsPerStep = 8;

    [[nodiscard]] float autocorrelation(std::size_t lag) const noexcept;
    void find_period() noexcept;
    void find_phase() noexcept;

    std::array<float, kHops> centred_{};  // p less its mean
    std::size_t count_ = 0;
    std::array<float, kLongest + 2> correlation_{};  // by lag; 0 outside the lags of the tempi
    int steps_ = kSteps;
    PaperEstimate estimate_;
};

/// The streaming form: every 0.5 s it analyses the last 6 s, the work spread over the hops that
/// follow, and chooses period and phase anew; in between, the beats run on. As in the paper,
/// nothing ties an estimate to the one before.
///
/// Threads: one. Real-time: all but making one.
class PaperTracker {
 public:
    /// One hop: sets grid, beat and predicted of `state`, whose hop, times and is_silent are set
    /// before. `window`: as for PaperFlux. In silence nothing is announced.
    void advance(std::span<const float> window, MusicState& state) noexcept RAKS_NONBLOCKING;
    /// One hop inside a gap of the audio: sets the grid, which runs on.
    void advance_blind(MusicState& state) noexcept RAKS_NONBLOCKING;
    /// The audio continues elsewhere: forgets the onsets.
    void jump() noexcept RAKS_NONBLOCKING;
    /// Back to the start: 120 BPM, no confidence.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    static constexpr HopIndex kEvery = 50;      // hops between two analyses
    static constexpr std::size_t kLeast = 200;  // hops before the first analysis

    void adopt(const PaperEstimate& estimate) noexcept;
    void announce(MusicState& state) noexcept;
    void publish(MusicState& state) const noexcept;

    PaperFlux flux_;
    PaperWindow window_;
    std::array<float, PaperWindow::kHops> onsets_{};   // p, ring by hop
    std::array<float, PaperWindow::kHops> ordered_{};  // the same in order of time, for an analysis
    std::size_t hops_ = 0;                             // hops since reset or jump
    double window_start_ = 0.0;  // hop number of the analysed window's first onset
    double beat_hop_ = 0.0;      // hop number of beat `beat_`
    double period_hops_ = 50.0;
    long beat_ = 0;
    float confidence_ = 0.0F;
    double last_told_ = -1e9;       // hop of the last announced beat
    double last_predicted_ = -1e9;  // hop of the last predicted one
};

/// The whole-file form: each window of 6 s gives a period; from the first window's phase on, every
/// beat is the strongest onset within 10 % of the period around the expected time. `frames`: of
/// every hop from time 0, without PaperFlux's delay. Threads: workers. Real-time: no.
[[nodiscard]] std::vector<BeatEvent> paper_beats(std::span<const PaperFlux::Frame> frames);

/// The paper's whole-file form (paper_beats), fed with samples of any supported rate.
/// Threads: one. Real-time: no (it keeps 8 bytes for each hop of the file).
class PaperFile {
 public:
    /// Starts a file. Errors: no resampler can be set up.
    [[nodiscard]] Expected<void> prepare(SampleRate rate);
    /// The next samples, mono, finite, in [-1, 1].
    void add(std::span<const float> mono);
    /// Beats of the file, whose length is `duration`. To be called once, after all samples.
    [[nodiscard]] std::vector<BeatEvent> finish(Nanos duration);

 private:
    RhythmFrames windows_;
    PaperFlux flux_;
    std::vector<PaperFlux::Frame> frames_;
};

}  // namespace raks::audio
