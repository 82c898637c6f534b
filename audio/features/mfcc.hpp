#pragma once

#include <array>
#include <span>
#include <vector>

#include "audio/features/mel.hpp"
#include "audio/features/spectrum.hpp"
#include "base/realtime.hpp"

namespace raks::audio {

inline constexpr std::size_t kMfccStatic = 13;  // C1..C12, then C0 or the log energy
inline constexpr int kMfccFeatures = 39;  // and their first and second derivatives: Ofli 2008, 5

using MfccVector = std::array<float, kMfccFeatures>;

/// The definition of HTK (MFCC_0_D_A, MFCC_E_D_A): 16 kHz, 25 ms Hamming windows every 10 ms,
/// power spectrum, floor 1.0, lifter 22, derivatives over +-2 frames.
struct MfccConfig {
    int bands = 26;
    double low_hz = 0.0;
    double high_hz = 8'000.0;
    double pre_emphasis = 0.97;
    enum class Last { c0, log_energy };
    Last last = Last::c0;
};

/// MFCC-39 of a stream at 16 kHz. Frame n covers samples 160 n .. 160 n + 399; its vector comes out
/// when the statics of frame n + 4 are known, and for the last four with finish(). The derivatives
/// at both ends are as over the whole file: streaming equals batch bit for bit.
///
/// Threads: one. Real-time: process, finish, reset yes.
class MfccStream {
 public:
    static constexpr int kSampleRate = 16'000;
    static constexpr int kWindow = 400;
    static constexpr int kHop = 160;

    class Sink {
     public:
        virtual void on_vector(const MfccVector& vector) noexcept = 0;

     protected:
        ~Sink() = default;
    };

    explicit MfccStream(const MfccConfig& config = {});

    /// Takes samples in 16-bit scale (+-32768).
    void process(std::span<const float> samples, Sink& sink) noexcept RAKS_NONBLOCKING;
    /// The end of the stream: the vectors still owed. Then reset() before more samples.
    void finish(Sink& sink) noexcept RAKS_NONBLOCKING;
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Static = std::array<float, kMfccStatic>;
    static constexpr int kHistory = 16;  // frames kept; 9 are needed
    static constexpr int kLookAhead = 4;

    void add_frame(Sink& sink) noexcept;
    [[nodiscard]] Static compute_static() noexcept;
    [[nodiscard]] double window_log_energy() const noexcept;
    void emit(int frame, Sink& sink) noexcept;
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
    int filled_ = 0;  // samples in window_
    int frames_ = 0;  // statics computed since reset
    int emitted_ = 0;
    int newest_ = -1;  // last frame that delta may look at (the clamp at the end)
    std::array<Static, kHistory> statics_{};
};

}  // namespace raks::audio
