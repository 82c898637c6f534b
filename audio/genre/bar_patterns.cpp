#include "audio/genre/bar_patterns.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include "base/assert.hpp"
#include "base/time.hpp"

namespace raks::audio {
namespace {

using Patterns = BarPatterns;

// First mel band of each of the six; up to 0.5, 1.1, 2.3, 4.2, 8.1 and 15.5 kHz.
constexpr std::array<int, Patterns::kBands + 1> kBandEdges = {0, 5, 10, 16, 22, 29, 36};
constexpr float kRange = 45.0F;         // dB below the peak; lower levels count as the floor
constexpr float kPeakFall = 0.02F;      // dB a hop: 2 dB a second
constexpr float kLeastRise = 1.0F;      // dB: less is no onset
constexpr float kQuietest = -200.0F;    // dB: an empty band
constexpr double kSlowestPulse = 0.7;   // Hz: 42 beats a minute
constexpr double kFastestPulse = 12.0;  // Hz: sixteenths at 180 BPM
constexpr double kPulseMemory = 2.5;    // s, time constant of a resonator
constexpr float kTiny = 1e-6F;          // keeps empty sums from being divided by 0

// Level in dB, bounded below for empty bands.
float decibels(float magnitude) noexcept {
    return std::max(kQuietest, 20.0F * std::log10(magnitude + 1e-12F));
}

// Slot of a position (beats, any sign) in a cycle that repeats every `cycle` beats.
std::size_t slot_of(double position, double cycle, int slots) noexcept {
    const double inside = position - cycle * std::floor(position / cycle);
    const int slot = static_cast<int>(inside / cycle * slots);
    return static_cast<std::size_t>(std::clamp(slot, 0, slots - 1));
}

// Writes features in order and counts them.
class Writer {
 public:
    explicit Writer(std::span<float> out) : out_(out) {}
    void put(float value) noexcept { out_[at_++] = value; }
    [[nodiscard]] std::size_t written() const noexcept { return at_; }

 private:
    std::span<float> out_;
    std::size_t at_ = 0;
};

// One coefficient of a Fourier series.
struct Wave {
    float re = 0.0F;
    float im = 0.0F;
    [[nodiscard]] float magnitude() const noexcept { return std::sqrt(re * re + im * im); }
};

// Cosines over one turn, computed at program start: no trigonometry in the streaming part.
template <std::size_t Steps>
std::array<float, Steps> cosine_turn() {
    std::array<float, Steps> table{};
    for (std::size_t i = 0; i < Steps; ++i) {
        const double share = static_cast<double>(i) / static_cast<double>(Steps);
        table[i] = static_cast<float>(std::cos(2.0 * M_PI * share));
    }
    return table;
}
// A slot is a whole number of these steps for 12 and for 16 slots, and so is half a mel band's step
// in the cosine series.
constexpr std::size_t kTurn = 144;
const std::array<float, kTurn> kCosines = cosine_turn<kTurn>();

// Coefficient `k` of the Fourier series over one cycle of slots; its magnitude does not change when
// the cycle is rotated.
template <std::size_t Slots>
Wave wave_of(const std::array<float, Slots>& cycle, std::size_t k) noexcept {
    static_assert(kTurn % Slots == 0 && kTurn % 4 == 0);
    Wave wave;
    for (std::size_t i = 0; i < Slots; ++i) {
        const std::size_t step = k * i * (kTurn / Slots);
        wave.re += cycle[i] * kCosines[step % kTurn];
        wave.im += cycle[i] * kCosines[(step + kTurn / 4) % kTurn];  // cos(x + 90) = -sin x
    }
    return wave;
}

// Mean onset strength of each slot (a window holds more hops of some slots than of others), divided
// by the sum of these: shares that sum to 1. Slots without a hop are 0.
template <std::size_t Slots>
std::array<float, Slots> shares_of(const std::array<float, Slots>& sums,
                                   const std::array<float, Slots>& hops) noexcept {
    std::array<float, Slots> shares{};
    float total = kTiny;
    for (std::size_t i = 0; i < Slots; ++i) {
        shares[i] = hops[i] > 0.0F ? sums[i] / hops[i] : 0.0F;
        total += shares[i];
    }
    for (float& share : shares) {
        share /= total;
    }
    return shares;
}

// Cosine series over the mel bands, coefficients [first, first + count): a smooth description of
// the spectrum's shape, as in a cepstrum. Coefficient 0 is the mean level.
void put_cosines(const std::array<float, Patterns::kMelBands>& bands,
                 std::size_t first,
                 std::size_t count,
                 Writer& writer) noexcept {
    static_assert(kTurn == std::size_t{4} * Patterns::kMelBands);
    for (std::size_t k = first; k < first + count; ++k) {
        float sum = 0.0F;
        for (std::size_t band = 0; band < bands.size(); ++band) {
            sum += bands[band] * kCosines[k * (2 * band + 1) % kTurn];
        }
        writer.put(sum / static_cast<float>(bands.size()));
    }
}

using Bar = std::array<float, Patterns::kBarSlots>;

// "beat": the four slots of each beat added up, so that only the place within the beat is left.
void put_beat_profiles(const std::array<Bar, Patterns::kBands>& bars, Writer& writer) noexcept {
    for (const Bar& bar : bars) {
        for (std::size_t slot = 0; slot < 4; ++slot) {
            writer.put(bar[slot] + bar[slot + 4] + bar[slot + 8] + bar[slot + 12]);
        }
    }
}

// "series": magnitudes of coefficients 1 to 8 for each band.
void put_series(const std::array<Bar, Patterns::kBands>& bars, Writer& writer) noexcept {
    for (const Bar& bar : bars) {
        for (std::size_t k = 1; k <= 8; ++k) {
            writer.put(wave_of(bar, k).magnitude());
        }
    }
}

// "phases": one group's coefficient times the conjugate of the other's. A rotation of both by whole
// beats turns both phases alike and cancels out. Scaled to the size of one coefficient.
void put_phases(const std::array<Bar, Patterns::kGroups>& groups, Writer& writer) noexcept {
    constexpr std::array<std::pair<std::size_t, std::size_t>, 3> kPairs = {
        {{0, 1}, {0, 2}, {1, 2}}};
    for (const auto& [first, second] : kPairs) {
        for (std::size_t k = 1; k <= 4; ++k) {
            const Wave x = wave_of(groups[first], k);
            const Wave y = wave_of(groups[second], k);
            const float scale = std::sqrt(x.magnitude() * y.magnitude()) + 0.01F;
            writer.put((x.re * y.re + x.im * y.im) / scale);
            writer.put((x.im * y.re - x.re * y.im) / scale);
        }
    }
}

}  // namespace

BarPatterns::BarPatterns() {
    // A resonator multiplies its complex state by keep x e^(i angle) each hop.
    const double ratio = std::log(kFastestPulse / kSlowestPulse) / (kResonators - 1);
    const double keep = std::exp(-1.0 / (kPulseMemory * kHopsPerSecond));
    for (int i = 0; i < kResonators; ++i) {
        const double angle = 2.0 * M_PI * kSlowestPulse * std::exp(ratio * i) / kHopsPerSecond;
        rotation_[0][static_cast<std::size_t>(i)] = static_cast<float>(keep * std::cos(angle));
        rotation_[1][static_cast<std::size_t>(i)] = static_cast<float>(keep * std::sin(angle));
    }
    reset();
}

void BarPatterns::reset() noexcept RAKS_NONBLOCKING {
    resonance_ = {};
    peak_ = kQuietest;
    level_ = {};
    band_levels_ = {};
    hops_ = 0;
    open_ = {};
    segments_ = 0;
    next_ = 0;
}

namespace {

// "shape", "spread" and "onsets": mean and deviation of the log spectrum, and the bands' onsets.
template <class Sums>
void put_sound(const Sums& sums, Writer& writer) noexcept {
    std::array<float, Patterns::kMelBands> mean{};
    std::array<float, Patterns::kMelBands> deviation{};
    for (std::size_t band = 0; band < mean.size(); ++band) {
        mean[band] = sums.level[band] / sums.hops;
        const float variance = sums.level_squared[band] / sums.hops - mean[band] * mean[band];
        deviation[band] = std::sqrt(std::max(0.0F, variance));
    }
    // The mean's coefficient 0 is its level, which is left out; the deviation's is kept.
    put_cosines(mean, 1, 9, writer);
    put_cosines(deviation, 0, 6, writer);
    std::array<float, Patterns::kBands> totals{};
    float all = kTiny;
    for (std::size_t band = 0; band < totals.size(); ++band) {
        totals[band] = std::accumulate(sums.bar[band].begin(), sums.bar[band].end(), 0.0F);
        all += totals[band];
    }
    for (const float total : totals) {
        writer.put(total / all);
    }
    // Onsets altogether, in logarithm; the constant bounds it where there are none.
    writer.put(std::log(0.02F + all / sums.hops));
}

// "beat" to "swing": the pattern over the bar, over three beats and within the beat.
template <class Sums>
void put_bar(const Sums& sums, Writer& writer) noexcept {
    std::array<Bar, Patterns::kBands> bars{};
    std::array<Bar, Patterns::kGroups> groups{};
    for (std::size_t band = 0; band < bars.size(); ++band) {
        bars[band] = shares_of(sums.bar[band], sums.bar_hops);
    }
    // Two neighbouring bands make a group.
    for (std::size_t group = 0; group < groups.size(); ++group) {
        Bar both{};
        std::transform(sums.bar[2 * group].begin(),
                       sums.bar[2 * group].end(),
                       sums.bar[2 * group + 1].begin(),
                       both.begin(),
                       std::plus<>());
        groups[group] = shares_of(both, sums.bar_hops);
    }
    put_beat_profiles(bars, writer);
    put_series(bars, writer);
    for (const Bar& group : groups) {
        for (const float share : group) {
            writer.put(share);
        }
    }
    put_phases(groups, writer);
    // Three beats: strong first and second coefficients mean triple metre.
    for (const auto& group : sums.waltz) {
        const auto shares = shares_of(group, sums.waltz_hops);
        writer.put(wave_of(shares, 1).magnitude());
        writer.put(wave_of(shares, 2).magnitude());
    }
    for (const float share : shares_of(sums.beat, sums.beat_hops)) {
        writer.put(share);
    }
}

// "pulse" and "tempo": rates that need no tracker, and the tracker's tempo and metre.
template <class Sums>
void put_pulse(const Sums& sums, Writer& writer) noexcept {
    for (std::size_t group = 0; group < sums.pulse.size(); ++group) {
        // The radii grow with the mean onset strength and the resonators' memory: divided by both.
        const float scale = 20.0F * (sums.pulse_power[group] + 0.02F * sums.hops);
        for (const float radius : sums.pulse[group]) {
            writer.put(std::log(0.05F + radius / scale));
        }
    }
    for (const float value : sums.tempo) {
        writer.put(value / sums.hops);
    }
}

}  // namespace

// Adds another segment, field by field.
void BarPatterns::Sums::add(const Sums& other) noexcept {
    const auto join = [](auto& sums, const auto& more) {
        std::transform(sums.begin(), sums.end(), more.begin(), sums.begin(), std::plus<>());
    };
    hops += other.hops;
    join(level, other.level);
    join(level_squared, other.level_squared);
    for (std::size_t band = 0; band < bar.size(); ++band) {
        join(bar[band], other.bar[band]);
    }
    for (std::size_t group = 0; group < waltz.size(); ++group) {
        join(waltz[group], other.waltz[group]);
    }
    join(beat, other.beat);
    join(bar_hops, other.bar_hops);
    join(waltz_hops, other.waltz_hops);
    join(beat_hops, other.beat_hops);
    for (std::size_t i = 0; i < pulse.size(); ++i) {
        join(pulse[i], other.pulse[i]);
    }
    join(pulse_power, other.pulse_power);
    join(tempo, other.tempo);
    rhythms.add(other.rhythms);
}

bool BarPatterns::add(std::span<const float, kMelBands> mel,
                      const BeatGrid& grid,
                      StreamTime time) noexcept RAKS_NONBLOCKING {
    take_levels(mel);
    take_onsets(grid, time);
    open_.hops += 1.0F;
    if (open_.hops < static_cast<float>(kSegmentHops)) {
        return false;
    }
    closed_[static_cast<std::size_t>(next_)] = open_;
    next_ = (next_ + 1) % kSegments;
    segments_ = std::min(segments_ + 1, kSegments);
    open_ = {};
    return true;
}

// Levels above the floor, their sums, and the onset strength of each band.
void BarPatterns::take_levels(std::span<const float, kMelBands> mel) noexcept {
    std::transform(mel.begin(), mel.end(), level_.begin(), [](float magnitude) {
        return decibels(magnitude);
    });
    // The peak falls slowly, so that a break does not raise the floor; gain changes both alike.
    peak_ = std::max(peak_ - kPeakFall, *std::max_element(level_.begin(), level_.end()));
    for (std::size_t band = 0; band < level_.size(); ++band) {
        level_[band] = std::max(0.0F, level_[band] - peak_ + kRange);
        open_.level[band] += level_[band];
        open_.level_squared[band] += level_[band] * level_[band];
    }
    auto& now = band_levels_[static_cast<std::size_t>(hops_ % 3)];
    const auto& before = band_levels_[static_cast<std::size_t>((hops_ + 1) % 3)];  // two hops ago
    for (std::size_t band = 0; band < now.size(); ++band) {
        const auto from = static_cast<std::size_t>(kBandEdges[band]);
        const auto to = static_cast<std::size_t>(kBandEdges[band + 1]);
        float sum = 0.0F;
        for (std::size_t i = from; i < to; ++i) {
            sum += level_[i];
        }
        now[band] = sum / static_cast<float>(to - from);
        // Rise over two hops; rises below kLeastRise are fluctuation.
        onset_[band] = hops_ < 2 ? 0.0F : std::max(0.0F, now[band] - before[band] - kLeastRise);
    }
    ++hops_;
}

// Sorts the hop's onsets into the slots where the tracker sees the hop.
void BarPatterns::take_onsets(const BeatGrid& grid, StreamTime time) noexcept {
    std::array<float, 4> groups{};  // low, middle, high, all
    for (std::size_t band = 0; band < onset_.size(); ++band) {
        groups[band / 2] += onset_[band];
        groups[3] += onset_[band];
    }
    resonate(groups);
    // Beats since a downbeat; the same number serves bars of three and of four.
    const Beats now = grid.beats_at(time);
    const double beats = (now - grid.bar_origin).count();
    // Bars that are corrected must not break the longer cycles.
    open_.rhythms.add(std::span(groups).first<NamedRhythms::kGroups>(), now.count());
    const std::size_t bar = slot_of(beats, 4.0, kBarSlots);
    const std::size_t waltz = slot_of(beats, 3.0, kWaltzSlots);
    const std::size_t beat = slot_of(beats, 1.0, kBeatSlots);
    for (std::size_t band = 0; band < onset_.size(); ++band) {
        open_.bar[band][bar] += onset_[band];
    }
    for (std::size_t group = 0; group < open_.waltz.size(); ++group) {
        open_.waltz[group][waltz] += groups[group];
    }
    open_.beat[beat] += groups[3];
    open_.bar_hops[bar] += 1.0F;
    open_.waltz_hops[waltz] += 1.0F;
    open_.beat_hops[beat] += 1.0F;
    // Octaves above 120 BPM. Cosine and sine of a turn per octave are the same for double and half
    // tempo, which trackers confuse.
    const auto octave = static_cast<float>(std::log2(grid.tempo.bpm() / 120.0));
    const auto turn = 2.0F * static_cast<float>(M_PI) * octave;
    open_.tempo[0] += octave;
    open_.tempo[1] += std::cos(turn);
    open_.tempo[2] += std::sin(turn);
    open_.tempo[3] += grid.confidence;
    open_.tempo[4] += grid.beats_per_bar == 3 ? 1.0F : 0.0F;
    open_.tempo[5] += grid.beats_per_bar == 2 ? 1.0F : 0.0F;
}

// One step of the resonators: complex states that rotate with their rate, decay, and are pushed by
// each onset. Where onsets come at a resonator's rate its radius grows.
void BarPatterns::resonate(const std::array<float, 4>& onsets) noexcept {
    for (std::size_t group = 0; group < onsets.size(); ++group) {
        auto& [re, im] = resonance_[group];
        open_.pulse_power[group] += onsets[group];
        for (std::size_t i = 0; i < re.size(); ++i) {
            const float turned = rotation_[0][i] * re[i] - rotation_[1][i] * im[i] + onsets[group];
            im[i] = rotation_[1][i] * re[i] + rotation_[0][i] * im[i];
            re[i] = turned;
            open_.pulse[group][i] += std::sqrt(re[i] * re[i] + im[i] * im[i]);
        }
    }
}

void BarPatterns::features(int count,
                           std::span<float, kFeatures> out) const noexcept RAKS_NONBLOCKING {
    RAKS_ASSERT(count >= 1 && count <= segments());
    // From the newest segment backwards.
    Sums sums;
    for (int i = 1; i <= count; ++i) {
        sums.add(closed_[static_cast<std::size_t>((next_ + kSegments - i) % kSegments)]);
    }
    Writer writer(out);
    put_sound(sums, writer);
    put_bar(sums, writer);
    put_pulse(sums, writer);
    for (const float likeness : sums.rhythms.likeness()) {
        writer.put(likeness);
    }
    RAKS_ASSERT(writer.written() == kFeatures);
}

}  // namespace raks::audio
