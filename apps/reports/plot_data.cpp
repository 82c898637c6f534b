#include "apps/reports/plot_data.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>

#include "base/file.hpp"

namespace raks::apps {
namespace {

// Samples of an analysis window, and the limits of the mel bands in Hz.
constexpr int kWindow = static_cast<int>(audio::RhythmFrames::kWindow);
constexpr double kLowestHertz = 30.0;
constexpr double kHighestHertz = 16'000.0;
// More than any piece; bounds what a reference file may say.
constexpr double kLongestSeconds = 1e6;

// Mel scale (2595 log10(1 + f / 700)) and its inverse.
double mel_of(double hertz) { return 2595.0 * std::log10(1.0 + hertz / 700.0); }
double hertz_of(double mel) { return 700.0 * (std::pow(10.0, mel / 2595.0) - 1.0); }

// Two neighbouring columns as one: extremes are kept, sums are added.
PlotColumn merged(const PlotColumn& a, const PlotColumn& b) {
    PlotColumn both = a;
    both.hops += b.hops;
    both.low = std::min(a.low, b.low);
    both.high = std::max(a.high, b.high);
    both.strength = std::max(a.strength, b.strength);
    both.threshold = std::max(a.threshold, b.threshold);
    both.bpm += b.bpm;
    both.confidence += b.confidence;
    both.bar_confidence += b.bar_confidence;
    both.in_three += b.in_three;
    both.rival = b.rival.probability > both.rival.probability ? b.rival : both.rival;
    both.tempi += b.tempi;
    both.states += b.states;
    for (std::size_t row = 0; row < both.music.size(); ++row) {
        for (std::size_t field = 0; field < both.music[row].size(); ++field) {
            both.music[row][field] += b.music[row][field];
        }
    }
    for (std::size_t i = 0; i < kPlotBands; ++i) {
        // An empty column has level 0, which would be louder than any sound.
        both.level[i] = b.hops == 0 ? a.level[i] : std::max(a.level[i], b.level[i]);
    }
    return both;
}

// Cuts the number at the start of `text` off; blanks before it are skipped. False: there is none.
template <typename Number>
bool take_number(std::string_view& text, Number& number) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return error == std::errc{};
}

// Parses a line without its comment: a time, and optionally a position in the bar. Errors: anything
// else.
Expected<BeatEvent> parse_beat(std::string_view line) {
    double seconds = 0.0;
    int position = 0;
    std::string_view rest = line;
    if (!take_number(rest, seconds) || !(seconds >= 0.0 && seconds <= kLongestSeconds)) {
        return fail("'" + std::string(line.substr(0, 40)) +
                    "' does not start with a time in seconds");
    }
    if (rest.find_first_not_of(" \t") != std::string_view::npos &&
        (!take_number(rest, position) || position < 0 || position > 64 ||
         rest.find_first_not_of(" \t") != std::string_view::npos)) {
        return fail("'" + std::string(line.substr(0, 40)) +
                    "' is not a time and a position in the bar");
    }
    return BeatEvent{stream_time_from_seconds(seconds), position, 1.0F};
}

}  // namespace

PlotData::PlotData() : spectrum_(audio::hann_window(kWindow), kWindow) {
    // Band edges lie at equal steps in mel, stored in bins of the spectrum.
    const double low = mel_of(kLowestHertz);
    const double step = (mel_of(kHighestHertz) - low) / static_cast<double>(kPlotBands);
    for (std::size_t i = 0; i < edges_.size(); ++i) {
        edges_[i] = hertz_of(low + step * static_cast<double>(i)) * kWindow /
                    audio::RhythmFrames::kSampleRate;
    }
    columns_.reserve(kColumns);
}

Expected<void> PlotData::prepare(SampleRate rate) {
    flux_.reset();
    next_window_ = 0;
    hops_per_column_ = 1;
    columns_.clear();
    beats_.clear();
    parts_.clear();
    events_.clear();
    accents_.clear();
    bars_.clear();
    return windows_.prepare(rate);
}

// A column is a whole number of hops, a power of two.
double PlotData::seconds_per_column() const noexcept {
    return static_cast<double>(hops_per_column_) / kHopsPerSecond;
}

// The column of a hop. When it lies beyond the last possible column, neighbours are merged
// pairwise, which halves the number of columns and doubles their length, until it fits.
PlotColumn& PlotData::column_of(HopIndex hop) {
    while (hop / hops_per_column_ >= static_cast<HopIndex>(kColumns)) {
        // An odd column at the end is paired with an empty one.
        columns_.resize((columns_.size() + 1) / 2 * 2);
        for (std::size_t i = 0; i < columns_.size(); i += 2) {
            columns_[i / 2] = merged(columns_[i], columns_[i + 1]);
        }
        columns_.resize(columns_.size() / 2);
        hops_per_column_ *= 2;
    }
    const auto index = static_cast<std::size_t>(hop / hops_per_column_);
    if (index >= columns_.size()) {
        columns_.resize(index + 1);
    }
    return columns_[index];
}

// The samples are resampled to the analysis rate and cut into one window a hop.
void PlotData::add(std::span<const float> mono) {
    windows_.process(mono, [this](std::span<const float> window) { take(window); });
}

// One window: waveform, spectrum and onset strength of one hop.
void PlotData::take(std::span<const float> window) {
    const HopIndex hop = next_window_++;
    PlotColumn now;
    now.hops = 1;
    // The hop is the middle of its window.
    const auto middle = window.subspan(
        (audio::RhythmFrames::kWindow - audio::RhythmFrames::kHop) / 2, audio::RhythmFrames::kHop);
    now.low = *std::min_element(middle.begin(), middle.end());
    now.high = *std::max_element(middle.begin(), middle.end());
    const std::span<const float> power = spectrum_.compute(window);
    for (std::size_t band = 0; band < kPlotBands; ++band) {
        // The level of a band is its loudest bin; where bands are narrower than bins, the spectrum
        // at the band's centre is interpolated between two bins.
        const double centre = 0.5 * (edges_[band] + edges_[band + 1]);
        const auto bin = std::min(static_cast<std::size_t>(centre), power.size() - 2);
        const auto share = static_cast<float>(centre - static_cast<double>(bin));
        float loudest = power[bin] + std::min(share, 1.0F) * (power[bin + 1] - power[bin]);
        for (auto k = static_cast<std::size_t>(std::ceil(edges_[band]));
             static_cast<double>(k) < edges_[band + 1] && k < power.size();
             ++k) {
            loudest = std::max(loudest, power[k]);
        }
        // A sine of amplitude 1 has |X| = sum of the window / 2 = kWindow / 4.
        const float full = static_cast<float>(kWindow) / 4.0F;
        now.level[band] = 10.0F * std::log10(loudest / (full * full) + 1e-12F);
    }
    // The first hop of a column sets its level, later ones raise it.
    PlotColumn& column = column_of(hop);
    column = column.hops == 0 ? merged(now, column) : merged(column, now);
    // Onset strength and threshold are delayed: they belong to an earlier hop.
    const audio::PaperFlux::Frame frame = flux_.add(window);
    if (hop >= audio::PaperFlux::kDelay) {
        PlotColumn& earlier = column_of(hop - audio::PaperFlux::kDelay);
        earlier.strength = std::max(earlier.strength, frame.strength);
        earlier.threshold = std::max(earlier.threshold, frame.threshold);
    }
}

// Means are taken when the picture is drawn: here are only sums.
void PlotData::add(const MusicState& state) {
    PlotColumn& column = column_of(state.hop);
    column.bpm += state.grid.tempo.bpm();
    column.confidence += static_cast<double>(state.grid.confidence);
    column.bar_confidence += static_cast<double>(state.grid.bar_confidence);
    column.in_three += state.beat_parts == 3 ? 1 : 0;
    column.rival = state.rival.probability > column.rival.probability ? state.rival : column.rival;
    for (std::size_t row = 0; row < kMusicTable.size(); ++row) {
        const auto fields = kMusicTable[row].used();
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (fields[i].drawn != Drawn::no) {
                column.music[row][i] += std::get<double>(fields[i].value(state));
            }
        }
    }
    ++column.tempi;
    ++column.states;
    if (state.has_beat) {
        beats_.push_back(state.beat);
    }
    if (parts_.empty() || parts_.back().part != state.part) {
        parts_.push_back({state.time, state.part});
    }
    if (state.event.kind != MusicEvent::Kind::none) {
        events_.push_back(state.event);
    }
    if (state.accent.strength > 0.0F) {
        accents_.push_back(state.accent);
    }
    if (state.ahead.bar >= static_cast<int>(bars_.size())) {
        bars_.push_back({state.time, state.ahead.repeats[0]});
    }
}

void PlotData::replace_beats(std::vector<BeatEvent> beats) {
    beats_ = std::move(beats);
    // Beats and columns both ascend: the interval from beat next - 1 to next contains the column's
    // time.
    std::size_t next = 1;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
        const double time = static_cast<double>(i) * seconds_per_column();
        while (next + 1 < beats_.size() && to_seconds(beats_[next].time) <= time) {
            ++next;
        }
        PlotColumn& column = columns_[i];
        // Beyond the last beat nothing is known.
        column.tempi = next < beats_.size() ? 1 : 0;
        if (column.tempi > 0) {
            column.bpm = 60.0 / to_seconds(beats_[next].time - beats_[next - 1].time);
            column.confidence = static_cast<double>(beats_[next].confidence);
            column.bar_confidence = static_cast<double>(beats_[next].bar_confidence);
            column.in_three = 0;
            column.rival = {};
        }
    }
}

// Silence until the last hop's delayed onset strength is out.
void PlotData::finish(Nanos duration) {
    duration_ = to_seconds(duration);
    // Hops that begin before the end, rounded up.
    const HopIndex hops = (duration + kHop - Nanos(1)) / kHop;
    const std::array<float, 256> silence{};
    while (next_window_ < hops + audio::PaperFlux::kDelay) {
        add(silence);
    }
    // Columns of the silence after the end are dropped.
    const auto used = static_cast<std::size_t>((hops + hops_per_column_ - 1) / hops_per_column_);
    columns_.resize(std::min(columns_.size(), used));
}

Expected<std::vector<BeatEvent>> read_reference_beats(const std::filesystem::path& path) {
    // 16 MiB at most.
    auto text = read_text_file(path, std::size_t{16} << 20U);
    if (!text) {
        return fail(std::move(text.error()));
    }
    std::vector<BeatEvent> beats;
    std::string_view left = *text;
    for (int number = 1; !left.empty(); ++number) {
        const std::size_t end = std::min(left.find('\n'), left.size());
        std::string_view line = left.substr(0, end);
        left.remove_prefix(std::min(end + 1, left.size()));
        // Comments, and the \r of files from Windows.
        line = line.substr(0, line.find_first_of("#\r"));
        if (line.find_first_not_of(" \t") == std::string_view::npos) {
            continue;
        }
        auto beat = parse_beat(line);
        const std::string where = path.string() + ": line " + std::to_string(number);
        if (!beat) {
            return fail(std::move(beat.error()).in(where));
        }
        // A doubled or falling time would make intervals of zero or less.
        if (!beats.empty() && beat->time <= beats.back().time) {
            return fail(where + ": a beat that is not after the one before it");
        }
        beats.push_back(*beat);
    }
    if (beats.empty()) {
        return fail(path.string() + ": holds no beats: one a line, in seconds");
    }
    return beats;
}

}  // namespace raks::apps
