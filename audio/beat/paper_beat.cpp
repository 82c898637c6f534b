#include "audio/beat/paper_beat.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace raks::audio {
namespace {

// Factor of |X| with a Hann window, full scale 256. Below 1 / kCompression arcsinh is nearly
// linear.
constexpr float kCompression = 30.0F;
// The threshold is this share of the moving median plus a floor, below which nothing is an onset.
constexpr float kMedianShare = 1.0F;
constexpr float kLowestThreshold = 2.0F;

}  // namespace

PaperFlux::PaperFlux() : spectrum_(hann_window(kWindow), kWindow) {
    // Smoothing s (half Hann, newest first) and the difference of neighbours in one filter: h(i) =
    // s(i) - s(i - 1). Its response to a step in G is s: immediate, then falling.
    std::array<float, kSmoothing + 2> smoothing{};
    float sum = 0.0F;
    for (std::size_t i = 0; i < kSmoothing; ++i) {
        const double angle = M_PI * static_cast<double>(i) / kSmoothing;
        smoothing[i + 1] = static_cast<float>(0.5 + 0.5 * std::cos(angle));
        sum += smoothing[i + 1];
    }
    for (std::size_t i = 0; i <= kSmoothing; ++i) {
        filter_[i] = (smoothing[i + 1] - smoothing[i]) / sum;
    }
}

void PaperFlux::reset() noexcept RAKS_NONBLOCKING {
    compressed_ = {};
    strengths_ = {};
    hops_ = 0;
}

// E(n, k) over the ring of spectra, then the sum over k of its positive part.
float PaperFlux::flux() const noexcept {
    std::array<float, kBins> energy{};
    for (std::size_t i = 0; i <= kSmoothing; ++i) {
        const auto& spectrum = compressed_[(hops_ + kSmoothing + 1 - i) % (kSmoothing + 1)];
        const float weight = filter_[i];
        for (std::size_t k = 0; k < kBins; ++k) {
            energy[k] += weight * spectrum[k];
        }
    }
    float sum = 0.0F;
    for (const float value : energy) {
        sum += std::max(0.0F, value);
    }
    return sum;
}

PaperFlux::Frame PaperFlux::add(std::span<const float> window) noexcept RAKS_NONBLOCKING {
    const std::span<const float> power = spectrum_.compute(window);
    std::transform(
        power.begin(), power.end(), compressed_[hops_ % (kSmoothing + 1)].begin(), [](float x) {
            return std::asinh(kCompression * std::sqrt(x));
        });
    // The filter's memory is not full in the first hops: the start of a stream is no onset.
    strengths_[hops_ % kMedian] = hops_ < kSmoothing + 1 ? 0.0F : flux();
    ++hops_;
    Frame frame;
    // The frame in the middle of the median's window.
    frame.strength = strengths_[(hops_ + kMedian - 1 - kDelay) % kMedian];
    auto sorted = strengths_;
    std::nth_element(sorted.begin(), sorted.begin() + kDelay, sorted.end());
    frame.threshold = kMedianShare * sorted[kDelay] + kLowestThreshold;
    return frame;
}

namespace {

// The peak at half the lag wins when it is at least this high, as a share of the highest. Without
// the rule F is 61.5 and not 64.5 (31 excerpts, streaming).
constexpr float kMultipleShare = 0.75F;

constexpr double kPredictedLeadHops = 10.0;  // hops before a beat at which it is predicted
constexpr double kAnnounceLeadHops = 1.0;    // hops before a beat at which it is announced
constexpr double kOldestNews = 5.0;          // hops: an older beat is not announced any more
constexpr double kLeastGap = 0.5;            // of a beat between two announcements

// Offset of the peak of the parabola through three neighbouring values, in [-0.5, 0.5].
double peak_offset(float before, float peak, float after) noexcept {
    const float bend = before - 2.0F * peak + after;
    if (bend >= 0.0F) {
        return 0.0;
    }
    return std::clamp(0.5 * static_cast<double>((before - after) / bend), -0.5, 0.5);
}

// x at a fractional position, by linear interpolation; 0 outside.
float value_at(std::span<const float> x, double position) noexcept {
    if (position < 0.0) {
        return 0.0F;
    }
    const auto i = static_cast<std::size_t>(position);
    if (i + 1 >= x.size()) {
        return 0.0F;
    }
    const auto share = static_cast<float>(position - static_cast<double>(i));
    return x[i] + share * (x[i + 1] - x[i]);
}

}  // namespace

// Onsets less their mean: otherwise the correlations would favour short lags.
void PaperWindow::begin(std::span<const float> onsets) noexcept RAKS_NONBLOCKING {
    onsets = onsets.last(std::min(onsets.size(), kHops));
    count_ = onsets.size();
    float sum = 0.0F;
    for (const float onset : onsets) {
        sum += onset;
    }
    const float mean = count_ > 0 ? sum / static_cast<float>(count_) : 0.0F;
    std::transform(
        onsets.begin(), onsets.end(), centred_.begin(), [mean](float x) { return x - mean; });
    steps_ = 0;
}

// kLagsPerStep lags a step; the last two steps also find period and phase from them.
void PaperWindow::step() noexcept RAKS_NONBLOCKING {
    if (is_done()) {
        return;
    }
    const std::size_t first = kShortest - 1 + static_cast<std::size_t>(steps_) * kLagsPerStep;
    for (std::size_t lag = first; lag < std::min(first + kLagsPerStep, kLongest + 2); ++lag) {
        correlation_[lag] = autocorrelation(lag);
    }
    ++steps_;
    if (steps_ == kSteps - 1) {
        find_period();
    } else if (steps_ == kSteps) {
        find_phase();
    }
}

// r(lag) = sum_n p(n) p(n + lag). Longer lags have fewer products, which favours the faster tempo.
float PaperWindow::autocorrelation(std::size_t lag) const noexcept {
    float sum = 0.0F;
    for (std::size_t n = 0; n + lag < count_; ++n) {
        sum += centred_[n] * centred_[n + lag];
    }
    return sum;
}

// Highest peak between the lags of 200 and 60 BPM, refined by a parabola.
void PaperWindow::find_period() noexcept {
    std::size_t best = kShortest;
    for (std::size_t lag = kShortest; lag <= kLongest; ++lag) {
        if (correlation_[lag] > correlation_[best]) {
            best = lag;
        }
    }
    // Peaks lie at multiples of the beat, too (Alonso, 2.2): half the lag is the beat when its own
    // peak is nearly as high.
    for (const std::size_t part : {best / 2, (best + 1) / 2}) {
        if (part >= kShortest && correlation_[part] > kMultipleShare * correlation_[best]) {
            best = part;
            break;
        }
    }
    estimate_.period_hops =
        static_cast<double>(best) +
        peak_offset(correlation_[best - 1], correlation_[best], correlation_[best + 1]);
    const float energy = autocorrelation(0);
    estimate_.confidence =
        energy > 0.0F ? std::clamp(correlation_[best] / energy, 0.0F, 1.0F) : 0.0F;
}

// c(phase) = sum_k p(end - phase - k T): a pulse train that ends `phase` hops before the window.
void PaperWindow::find_phase() noexcept {
    const std::span<const float> onsets = std::span(centred_).first(count_);
    const double end = static_cast<double>(count_) - 1.0;
    const auto match = [&](int phase) {
        float sum = 0.0F;
        for (double at = end - phase; at >= 0.0; at -= estimate_.period_hops) {
            sum += value_at(onsets, at);
        }
        return sum;
    };
    const int phases = static_cast<int>(std::ceil(estimate_.period_hops));
    int best = 0;
    float highest = match(0);
    for (int phase = 1; phase < phases; ++phase) {
        const float height = match(phase);
        if (height > highest) {
            highest = height;
            best = phase;
        }
    }
    const double offset = best > 0 ? peak_offset(match(best - 1), highest, match(best + 1)) : 0.0;
    estimate_.last_beat = end - (best + offset);
}

void PaperTracker::reset() noexcept RAKS_NONBLOCKING {
    jump();
    window_start_ = 0.0;
    beat_hop_ = 0.0;
    period_hops_ = 50.0;
    beat_ = 0;
    last_told_ = last_predicted_ = -1e9;
}

// An analysis that is under way is finished and never adopted: its onsets are of other audio.
void PaperTracker::jump() noexcept RAKS_NONBLOCKING {
    flux_.reset();
    while (!window_.is_done()) {
        window_.step();
    }
    hops_ = 0;
    confidence_ = 0.0F;
}

void PaperTracker::advance(std::span<const float> window,
                           MusicState& state) noexcept RAKS_NONBLOCKING {
    onsets_[hops_ % onsets_.size()] = flux_.add(window).onset();
    ++hops_;
    // A new window starts every kEvery hops; copied in order, as the ring goes on during its steps.
    if (hops_ >= kLeast && hops_ % kEvery == 0) {
        const std::size_t count = std::min(hops_, onsets_.size());
        for (std::size_t i = 0; i < count; ++i) {
            ordered_[i] = onsets_[(hops_ - count + i) % onsets_.size()];
        }
        window_.begin(std::span(ordered_).first(count));
        window_start_ =
            static_cast<double>(state.hop - PaperFlux::kDelay) - static_cast<double>(count - 1);
    } else if (!window_.is_done()) {
        window_.step();
        if (window_.is_done()) {
            adopt(window_.estimate());
        }
    }
    publish(state);
    announce(state);
}

void PaperTracker::advance_blind(MusicState& state) noexcept RAKS_NONBLOCKING { publish(state); }

// Takes over an estimate; beat numbers continue from the old grid.
void PaperTracker::adopt(const PaperEstimate& estimate) noexcept {
    confidence_ = estimate.confidence;
    if (estimate.confidence <= 0.0F) {
        return;
    }
    // Of the estimate's beats the one nearest to the present hop, which is PaperFlux::kDelay after
    // the newest onset.
    const double newest = window_start_ + static_cast<double>(std::min(hops_, onsets_.size()));
    const double last = window_start_ + estimate.last_beat + kPaperLagHops;
    const double later = std::round((newest + PaperFlux::kDelay - last) / estimate.period_hops);
    const double beat_hop = last + later * estimate.period_hops;
    beat_ += std::lround((beat_hop - beat_hop_) / period_hops_);
    beat_hop_ = beat_hop;
    period_hops_ = estimate.period_hops;
}

// The grid as a line through the last beat of the estimate.
void PaperTracker::publish(MusicState& state) const noexcept {
    state.grid.anchor_time = stream_time_from_seconds(beat_hop_ / kHopsPerSecond);
    state.grid.anchor_beat = Beats(static_cast<double>(beat_));
    state.grid.tempo = Bpm(60.0 * kHopsPerSecond / period_hops_);
    state.grid.beats_per_bar = 4;
    state.grid.bar_origin = Beats(0.0);
    state.grid.confidence = state.is_silent ? 0.0F : confidence_;
}

void PaperTracker::announce(MusicState& state) noexcept {
    if (state.grid.confidence <= 0.0F) {
        return;
    }
    const double audio_end_hops = to_seconds(state.audio_end) * kHopsPerSecond;
    // The last beat of the grid before `horizon`; none when it is too old or was announced already.
    const auto due = [&](double horizon, double told) -> std::optional<double> {
        const double beat =
            beat_hop_ + std::floor((horizon - beat_hop_) / period_hops_) * period_hops_;
        const bool is_news = beat > horizon - kOldestNews && beat > told + kLeastGap * period_hops_;
        return is_news ? std::optional(beat) : std::nullopt;
    };
    if (const auto beat = due(audio_end_hops + kAnnounceLeadHops, last_told_)) {
        last_told_ = *beat;
        state.has_beat = true;
        state.beat = {stream_time_from_seconds(*beat / kHopsPerSecond), 0, state.grid.confidence};
    }
    if (const auto beat = due(audio_end_hops + kPredictedLeadHops, last_predicted_)) {
        last_predicted_ = *beat;
        state.has_predicted = true;
        state.predicted = stream_time_from_seconds(*beat / kHopsPerSecond);
    }
}

Expected<void> PaperFile::prepare(SampleRate rate) {
    flux_.reset();
    frames_.clear();
    return windows_.prepare(rate);
}

void PaperFile::add(std::span<const float> mono) {
    windows_.process(
        mono, [this](std::span<const float> window) { frames_.push_back(flux_.add(window)); });
}

std::vector<BeatEvent> PaperFile::finish(Nanos duration) {
    // Rounded up: the last hop may be cut by the end of the file.
    const auto hops = static_cast<std::size_t>((duration + kHop - Nanos(1)) / kHop);
    // Frames come kDelay hops late: silence after the file brings the last ones out.
    const std::array<float, 256> silence{};
    while (frames_.size() < hops + PaperFlux::kDelay) {
        add(silence);
    }
    return paper_beats(std::span(frames_).subspan(PaperFlux::kDelay, hops));
}

namespace {

constexpr double kWindowHops = PaperWindow::kHops;
constexpr double kTolerance = 0.1;  // of the period, before and after the expected beat

// A window's analysis in one go.
PaperEstimate estimate_of(std::span<const float> onsets) {
    PaperWindow window;
    window.begin(onsets);
    while (!window.is_done()) {
        window.step();
    }
    return window.estimate();
}

// Place of the strongest onset within `reach` of `expected`; `expected` when there is none.
double strongest_near(std::span<const float> onsets, double expected, double reach) {
    const auto first = static_cast<std::size_t>(std::max(0.0, std::ceil(expected - reach)));
    double best = expected;
    float highest = 0.0F;
    for (std::size_t i = first; i < onsets.size() && static_cast<double>(i) <= expected + reach;
         ++i) {
        if (onsets[i] > highest) {
            highest = onsets[i];
            best = static_cast<double>(i);
        }
    }
    return best;
}

}  // namespace

std::vector<BeatEvent> paper_beats(std::span<const PaperFlux::Frame> frames) {
    std::vector<float> onsets;
    onsets.reserve(frames.size());
    for (const PaperFlux::Frame& frame : frames) {
        onsets.push_back(frame.onset());
    }
    // A rest shorter than half a window has too few beats for an estimate of its own: it belongs to
    // the window before.
    std::vector<PaperEstimate> windows;
    for (std::size_t start = 0; start == 0 || start + PaperWindow::kHops / 2 < onsets.size();
         start += PaperWindow::kHops) {
        const std::size_t count = std::min(PaperWindow::kHops, onsets.size() - start);
        windows.push_back(estimate_of(std::span(onsets).subspan(start, count)));
    }
    std::vector<BeatEvent> beats;
    // The first window's phase, moved back to the start of the file.
    double beat = std::fmod(windows.front().last_beat, windows.front().period_hops);
    while (beat < static_cast<double>(onsets.size())) {
        const auto at = static_cast<std::size_t>(std::max(0.0, beat) / kWindowHops);
        const PaperEstimate& window = windows[std::min(at, windows.size() - 1)];
        if (window.confidence > 0.0F) {
            beats.push_back(
                {stream_time_from_seconds(std::max(0.0, beat + kPaperLagHops) / kHopsPerSecond),
                 0,
                 window.confidence});
        }
        // The next beat is expected a period later and moved to the strongest onset nearby.
        beat = strongest_near(onsets, beat + window.period_hops, kTolerance * window.period_hops);
    }
    return beats;
}

}  // namespace raks::audio
