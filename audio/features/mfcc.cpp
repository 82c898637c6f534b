#include "audio/features/mfcc.hpp"

#include <algorithm>
#include <cmath>

#include "base/time.hpp"

namespace raks::audio {
namespace {

constexpr int kFftSize = 512;     // samples: the window of 400, padded with zeros
constexpr double kLifter = 22.0;  // HTK's default CEPLIFTER

}  // namespace

MfccStream::MfccStream(const MfccConfig& config)
    : config_(config),
      spectrum_(hamming_window(kWindow), kFftSize),
      filters_(
          htk_filter_bank({kSampleRate, kFftSize, config.bands, config.low_hz, config.high_hz})),
      cosines_(static_cast<std::size_t>(config.bands)),
      window_(kWindow),
      emphasized_(kWindow),
      bands_(static_cast<std::size_t>(config.bands)) {
    // Orthonormal DCT of the log bands, HTK's eq. for MFCC: sqrt(2 / N) cos(pi j / N (band + 1/2)).
    const double scale = std::sqrt(2.0 / config.bands);
    for (std::size_t band = 0; band < cosines_.size(); ++band) {
        for (std::size_t j = 0; j < cosines_[band].size(); ++j) {
            const double angle =
                M_PI * static_cast<double>(j) / config.bands * (static_cast<double>(band) + 0.5);
            cosines_[band][j] = scale * std::cos(angle);
        }
    }
    // The lifter evens out the coefficients' sizes: 1 + L / 2 sin(pi j / L); C0 is left as it is.
    lifter_[0] = 1.0;
    for (std::size_t j = 1; j < lifter_.size(); ++j) {
        lifter_[j] = 1.0 + kLifter / 2.0 * std::sin(M_PI * static_cast<double>(j) / kLifter);
    }
}

// The window and statics need no clearing: nothing reads what these counters leave out.
void MfccStream::reset() noexcept RAKS_NONBLOCKING {
    filled_ = frames_ = emitted_ = 0;
    newest_ = -1;
}

// Fills the window; a full one becomes a frame, and its newest kWindow - kHop samples are kept.
void MfccStream::process(std::span<const float> samples, Sink& sink) noexcept RAKS_NONBLOCKING {
    while (!samples.empty()) {
        const std::size_t room = static_cast<std::size_t>(kWindow - filled_);
        const std::size_t count = std::min(room, samples.size());
        std::copy_n(samples.data(), count, window_.begin() + filled_);
        filled_ += static_cast<int>(count);
        samples = samples.subspan(count);
        if (filled_ == kWindow) {
            add_frame(sink);
            std::copy(window_.begin() + kHop, window_.end(), window_.begin());
            filled_ = kWindow - kHop;
        }
    }
}

// A frame's second derivatives look at the statics of up to four frames ahead, which is why its
// vector waits for these.
void MfccStream::add_frame(Sink& sink) noexcept {
    statics_[static_cast<std::size_t>(frames_ % kHistory)] = compute_static();
    newest_ = frames_++;
    if (newest_ - kLookAhead >= emitted_) {
        emit(emitted_++, sink);
    }
}

// newest_ stays at the last frame: looking beyond it repeats its statics.
void MfccStream::finish(Sink& sink) noexcept RAKS_NONBLOCKING {
    while (emitted_ < frames_) {
        emit(emitted_++, sink);
    }
}

// Log energy of the window as it came, without pre-emphasis and Hamming window. The floor keeps
// silence from being -inf.
double MfccStream::window_log_energy() const noexcept {
    double energy = 0.0;
    for (const float sample : window_) {
        energy += static_cast<double>(sample) * static_cast<double>(sample);
    }
    return std::log(std::max(energy, 1e-30));
}

// Statics of one window: pre-emphasis, Hamming window and power spectrum, mel bands, logarithm,
// DCT, lifter.
MfccStream::Static MfccStream::compute_static() noexcept {
    const float k = static_cast<float>(config_.pre_emphasis);
    // The sample before the first is not known: HTK takes the first one for it.
    emphasized_[0] = window_[0] * (1.0F - k);
    for (std::size_t i = 1; i < window_.size(); ++i) {
        emphasized_[i] = window_[i] - k * window_[i - 1];
    }
    filters_.apply(spectrum_.compute(emphasized_), bands_);
    std::array<double, kMfccStatic> cepstrum{};
    for (std::size_t band = 0; band < bands_.size(); ++band) {
        // HTK's floor of the bands: 1 in the power of samples in 16-bit scale.
        const double log_band = std::log(std::max(1.0, static_cast<double>(bands_[band])));
        for (std::size_t j = 0; j < cepstrum.size(); ++j) {
            cepstrum[j] += log_band * cosines_[band][j];
        }
    }
    // HTK's order: C1..C12 first, C0 or the log energy last.
    Static result{};
    for (std::size_t j = 1; j < cepstrum.size(); ++j) {
        result[j - 1] = static_cast<float>(cepstrum[j] * lifter_[j]);
    }
    result.back() = static_cast<float>(config_.last == MfccConfig::Last::c0 ? cepstrum[0]
                                                                            : window_log_energy());
    return result;
}

// Statics of a frame; before the first and after the newest one these repeat.
const MfccStream::Static& MfccStream::static_at(int frame) const noexcept {
    return statics_[static_cast<std::size_t>(std::clamp(frame, 0, newest_) % kHistory)];
}

// First derivative by regression over +-2 frames: sum of d (x[t + d] - x[t - d]) over 2 sum of d^2,
// which is 10.
MfccStream::Static MfccStream::delta_at(int frame) const noexcept {
    const int inside = std::clamp(frame, 0, newest_);
    const Static& after1 = static_at(inside + 1);
    const Static& before1 = static_at(inside - 1);
    const Static& after2 = static_at(inside + 2);
    const Static& before2 = static_at(inside - 2);
    Static delta{};
    for (std::size_t i = 0; i < delta.size(); ++i) {
        delta[i] = (after1[i] - before1[i] + 2.0F * (after2[i] - before2[i])) / 10.0F;
    }
    return delta;
}

// The same regression over the first derivatives gives the second ones.
void MfccStream::emit(int frame, Sink& sink) noexcept RAKS_NONBLOCKING {
    const Static& statics = static_at(frame);
    const Static delta = delta_at(frame);
    const Static after1 = delta_at(frame + 1);
    const Static before1 = delta_at(frame - 1);
    const Static after2 = delta_at(frame + 2);
    const Static before2 = delta_at(frame - 2);
    MfccVector vector{};
    for (std::size_t i = 0; i < statics.size(); ++i) {
        vector[i] = statics[i];
        vector[i + kMfccStatic] = delta[i];
        vector[i + 2 * kMfccStatic] =
            (after1[i] - before1[i] + 2.0F * (after2[i] - before2[i])) / 10.0F;
    }
    // A real-time thread has a sink that does not block, whoever works through a file any other.
    RAKS_TRUSTED(sink.on_vector(vector));
}

CepstralMean::CepstralMean(const CepstralMeanConfig& config) noexcept
    // `longest_`: once this many frames are known, each further one counts 1 / longest_.
    : config_(config), longest_(std::max(1.0, config.seconds * kHopsPerSecond)) {
    reset();
}

void CepstralMean::reset() noexcept RAKS_NONBLOCKING {
    // The start's weight in frames: the first frame of music moves the mean by 1 / (heard_ + 1).
    frames_ = std::max(1.0, config_.start_weight * kHopsPerSecond);
    std::copy(config_.start.begin(), config_.start.end(), mean_.begin());
}

void CepstralMean::normalize(Frame frame, MfccVector& vector) noexcept RAKS_NONBLOCKING {
    if (frame == Frame::music) {
        // A plain mean until the time constant is reached, then an exponential one.
        frames_ = std::min(frames_ + 1.0, longest_);
        const double share = 1.0 / frames_;
        for (std::size_t i = 0; i < mean_.size(); ++i) {
            mean_[i] += share * (static_cast<double>(vector[i]) - mean_[i]);
        }
    }
    // Silence is normalized, too, with the mean as it stands: every frame has a vector.
    for (std::size_t i = 0; i < mean_.size(); ++i) {
        vector[i] = static_cast<float>(static_cast<double>(vector[i]) - mean_[i]);
    }
}

}  // namespace raks::audio
