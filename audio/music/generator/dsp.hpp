#pragma once

#include <algorithm>
#include <cmath>

/// Building blocks of the synthesized sounds. One sample a call. Threads: one each.
namespace raks::audio {

/// 2 pi.
inline constexpr double kTwoPi = 6.283185307179586;

/// Factor per sample of an exponential decay that loses 60 dB in `t60_seconds`.
[[nodiscard]] inline double decay_per_sample(double t60_seconds, double rate) noexcept {
    return std::exp(-6.907755278982137 / (t60_seconds * rate));
}

/// A sinusoid that dies away: one rotation and decay a sample.
class DampedSine {
 public:
    /// Starts at sample 0 with value 0; `gain`: the amplitude at the start.
    DampedSine(double hertz, double gain, double t60_seconds, double rate) noexcept
        : turn_re_(std::cos(kTwoPi * hertz / rate) * decay_per_sample(t60_seconds, rate)),
          turn_im_(std::sin(kTwoPi * hertz / rate) * decay_per_sample(t60_seconds, rate)),
          re_(gain) {}

    /// The next sample.
    [[nodiscard]] double next() noexcept {
        const double out = im_;
        const double re = re_ * turn_re_ - im_ * turn_im_;
        im_ = re_ * turn_im_ + im_ * turn_re_;
        re_ = re;
        return out;
    }

 private:
    double turn_re_;
    double turn_im_;
    double re_;
    double im_ = 0.0;
};

/// State variable filter, trapezoidal (Zavalishin 2012): low-, band- and high-pass at once.
class StateVariableFilter {
 public:
    /// Starts at rest. `hertz`: cutoff or centre; `q`: resonance.
    StateVariableFilter(double hertz, double q, double rate) noexcept { set(hertz, q, rate); }

    /// Moves cutoff and resonance; the state stays, so they may change while it runs.
    void set(double hertz, double q, double rate) noexcept {
        const double g = std::tan(0.5 * kTwoPi * std::min(hertz, 0.45 * rate) / rate);
        k_ = 1.0 / q;
        a1_ = 1.0 / (1.0 + g * (g + k_));
        a2_ = g * a1_;
        a3_ = g * a2_;
    }
    /// Takes the next sample; the three outputs are then of that sample.
    void feed(double in) noexcept {
        const double v3 = in - s2_;
        band_ = a1_ * s1_ + a2_ * v3;
        low_ = s2_ + a2_ * s1_ + a3_ * v3;
        high_ = in - k_ * band_ - low_;
        s1_ = 2.0 * band_ - s1_;
        s2_ = 2.0 * low_ - s2_;
    }
    /// Low-pass output.
    [[nodiscard]] double low() const noexcept { return low_; }
    /// Band-pass output.
    [[nodiscard]] double band() const noexcept { return band_; }
    /// High-pass output.
    [[nodiscard]] double high() const noexcept { return high_; }

 private:
    double k_ = 1.0, a1_ = 0.0, a2_ = 0.0, a3_ = 0.0;
    double s1_ = 0.0, s2_ = 0.0;
    double low_ = 0.0, band_ = 0.0, high_ = 0.0;
};

/// Saw-tooth wave, band-limited by a polynomial step (Valimaki, Huovilainen 2007).
class Saw {
 public:
    /// `start_phase`: in [0, 1).
    explicit Saw(double start_phase) noexcept : phase_(start_phase) {}

    /// The next sample, in about [-1, 1]; the frequency may change from sample to sample.
    [[nodiscard]] double next(double hertz, double rate) noexcept {
        const double step = hertz / rate;
        double out = 2.0 * phase_ - 1.0;
        if (phase_ < step) {
            const double x = phase_ / step - 1.0;
            out += x * x;
        } else if (phase_ > 1.0 - step) {
            const double x = (phase_ - 1.0) / step + 1.0;
            out -= x * x;
        }
        phase_ += step;
        phase_ -= std::floor(phase_);
        return out;
    }

 private:
    double phase_;
};

/// Envelope at `t` seconds: rises linearly from 0 to 1 over the first `rise` seconds and falls to 0
/// over the last `fall` of `length`.
[[nodiscard]] inline double edges(double t, double length, double rise, double fall) noexcept {
    return std::clamp(std::min(t / rise, (length - t) / fall), 0.0, 1.0);
}

}  // namespace raks::audio
