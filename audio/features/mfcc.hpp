#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "audio/features/spectrum.hpp"
#include "base/realtime.hpp"

/// Mel-frequency cepstral coefficients (MFCC) of a stream, by HTK's definition.
namespace raks::audio {

inline constexpr std::size_t kMfccStatic = 13;  ///< C1..C12, then C0 or log energy
/// Statics with their first and second derivatives (Ofli 2008, 5).
inline constexpr int kMfccFeatures = 39;

/// Statics, then first, then second derivatives, kMfccStatic values each.
using MfccVector = std::array<float, kMfccFeatures>;

/// The definition of HTK (MFCC_0_D_A, MFCC_E_D_A): 16 kHz, 25 ms Hamming windows every 10 ms,
/// power spectrum, floor 1.0, lifter 22, derivatives over +-2 frames.
struct MfccConfig {
    int bands = 26;              ///< mel filters
    double low_hz = 0.0;         ///< lower edge of the first filter
    double high_hz = 8'000.0;    ///< upper edge of the last filter
    double pre_emphasis = 0.97;  ///< coefficient of the first difference
    /// Last static: C0 of the cepstrum, or the log energy of the window before pre-emphasis.
    enum class Last { c0, log_energy };
    Last last = Last::c0;  ///< which of the two
};

/// MFCC-39 of a stream at 16 kHz. Frame n covers samples 160 n .. 160 n + 399. Its vector comes out
/// when the statics of frame n + 4 are known; the vectors of the last four frames come with
/// finish(). At both ends the derivatives repeat the first or last frame, as over a whole file:
/// streaming equals batch bit for bit.
///
/// Threads: one. Real-time: process, finish, reset yes.
class MfccStream {
 public:
    static constexpr int kSampleRate = 16'000;  ///< hertz
    static constexpr int kWindow = 400;         ///< samples in a frame
    static constexpr int kHop = 160;            ///< samples from frame to frame

    /// Receives the vectors, in order of frames, from within process() and finish().
    class Sink {
     public:
        /// One frame's vector. Real-time: must be where process() is.
        virtual void on_vector(const MfccVector& vector) noexcept = 0;

     protected:
        ~Sink() = default;
    };

    /// Plans the FFT and the filters for this definition.
    explicit MfccStream(const MfccConfig& config = {});

    /// Takes samples in 16-bit scale (+-32768), as many as there are; they need not fill a frame.
    void process(std::span<const float> samples, Sink& sink) noexcept RAKS_NONBLOCKING;
    /// Ends the stream: gives the vectors of the last frames. Call reset() before further samples.
    void finish(Sink& sink) noexcept RAKS_NONBLOCKING;
    /// Forgets the stream; the next sample is sample 0.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Static = std::array<float, kMfccStatic>;
    static constexpr int kHistory = 16;  // frames kept; 9 are needed for the second derivatives
    static constexpr int kLookAhead = 4;

    void add_frame(Sink& sink) noexcept;
    [[nodiscard]] Static compute_static() noexcept;
    [[nodiscard]] double window_log_energy() const noexcept;
    void emit(int frame, Sink& sink) noexcept RAKS_NONBLOCKING;
    [[nodiscard]] const Static& static_at(int frame) const noexcept;
    [[nodiscard]] Static delta_at(int frame) const noexcept;

    MfccConfig config_;
    PowerSpectrum spectrum_;
    FilterBank filters_;
    std::vector<std::array<double, kMfccStatic>> cosines_;  // band x coefficient
    std::array<double, kMfccStatic> lifter_{};
    std::vector<float> window_;      // the last kWindow samples, in order
    std::vector<float> emphasized_;  // work space of one frame
    std::vector<float> bands_;
    int filled_ = 0;   // samples in window_
    int frames_ = 0;   // statics computed since reset
    int emitted_ = 0;  // vectors handed out since reset
    int newest_ = -1;  // last frame that derivatives may use; at the end it repeats
    std::array<Static, kHistory> statics_{};
};

/// Time constant and start of a running cepstral mean.
struct CepstralMeanConfig {
    double seconds = 7.0;  ///< time constant of the running mean, 0.1 to 60
    /// How many seconds of music the start value counts for, > 0: until the mean of the music
    /// itself is known, a mean of the training music holds.
    double start_weight = 1.5;
    std::array<float, kMfccStatic> start{};  ///< mean of the statics in the training data
};

/// Streaming cepstral mean normalization: subtracts a running mean from the statics, which removes
/// what a constant gain, an equalizer, a microphone or a codec's band limit adds to the cepstrum.
/// The derivatives have no such offset and stay unchanged.
///
/// The mean of frame n includes that frame and all before it. Frames of silence do not change it.
/// Threads: one. Real-time: all but the constructor.
class CepstralMean {
 public:
    /// Starts from config.start.
    explicit CepstralMean(const CepstralMeanConfig& config = {}) noexcept;

    /// Whether a frame counts for the mean.
    enum class Frame : std::uint8_t { music, silence };
    /// Subtracts the mean from the statics of `vector` in place.
    void normalize(Frame frame, MfccVector& vector) noexcept RAKS_NONBLOCKING;
    /// Back to config.start, as after construction.
    void reset() noexcept RAKS_NONBLOCKING;

    /// The mean as it stands, one value for each static.
    [[nodiscard]] const std::array<double, kMfccStatic>& mean() const noexcept { return mean_; }

 private:
    CepstralMeanConfig config_;
    double longest_ = 0.0;  // most frames in the mean, as if it were a plain one
    double frames_ = 0.0;   // frames in the mean, the start's included
    std::array<double, kMfccStatic> mean_{};
};

}  // namespace raks::audio
