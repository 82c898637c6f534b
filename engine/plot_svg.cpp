#include "engine/plot_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "engine/plot_sheet.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr const char* kBlue = "#2563eb";
constexpr const char* kPale = "#bfdbfe";
constexpr const char* kOrange = "#f97316";
constexpr const char* kGreen = "#16a34a";
constexpr const char* kRed = "#dc2626";
constexpr const char* kGrey = "#64748b";
constexpr const char* kTeal = "#0d9488";

constexpr double kLeastGap = 0.4;  // units between two marks: closer ones cannot be told apart
constexpr Nanos kHitWindow = std::chrono::milliseconds(70);
constexpr Nanos kScoredFrom = std::chrono::seconds(5);
constexpr float kQuietest = -90.0F;  // dBFS, black
constexpr float kLoudest = -15.0F;   // dBFS, bright

using Values = std::vector<double>;

/// Which of `beats` have a beat of `others` within the window, one to one.
std::vector<bool> hits_of(std::span<const BeatEvent> beats, std::span<const BeatEvent> others) {
    std::vector<bool> hits(beats.size(), false);
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < beats.size() && j < others.size()) {
        const Nanos apart = others[j].time - beats[i].time;
        if (std::chrono::abs(apart) <= kHitWindow) {
            hits[i] = true;
            ++i;
            ++j;
        } else if (apart > Nanos(0)) {
            ++i;
        } else {
            ++j;
        }
    }
    return hits;
}

std::span<const BeatEvent> scored(std::span<const BeatEvent> beats) {
    const auto first = std::find_if(beats.begin(), beats.end(), [](const BeatEvent& beat) {
        return beat.time >= StreamTime(kScoredFrom);
    });
    return {first, beats.end()};
}

/// F-measure of the beats from 5 s on, +-70 ms.
double f_measure(std::span<const BeatEvent> beats, std::span<const BeatEvent> reference) {
    beats = scored(beats);
    reference = scored(reference);
    const auto hits = hits_of(beats, reference);
    const auto found = static_cast<double>(std::count(hits.begin(), hits.end(), true));
    const auto both = static_cast<double>(beats.size() + reference.size());
    return both > 0.0 ? 2.0 * found / both : 0.0;
}

double quantile(Values values, double share) {
    if (values.empty()) {
        return 0.0;
    }
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// Draws the panels, one method each.
class Plotter {
 public:
    Plotter(const PlotData& data, const PlotLabels& labels)
        : data_(data), labels_(labels), sheet_(data.duration()) {}

    Expected<std::string> draw() {
        head();
        waveform();
        if (auto drawn = spectrogram(); !drawn) {
            return fail(std::move(drawn.error()));
        }
        onsets();
        beats();
        tempo();
        bar();
        confidence();
        return sheet_.finish();
    }

 private:
    using Panel = PlotSheet::Panel;

    [[nodiscard]] double column_x(std::size_t column) const {
        return sheet_.x(static_cast<double>(column) * data_.seconds_per_column());
    }

    /// A line through the values of the columns; NaN breaks it.
    [[nodiscard]] std::string line(const Panel& panel, const Values& values) const {
        std::string path;
        bool is_drawing = false;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isnan(values[i])) {
                is_drawing = false;
                continue;
            }
            path += fmt::format(
                "{}{:.1f} {:.1f}", is_drawing ? 'L' : 'M', column_x(i), panel.y(values[i]));
            is_drawing = true;
        }
        return path;
    }

    /// The area between two rows of values.
    [[nodiscard]] std::string area(const Panel& panel,
                                   const Values& high,
                                   const Values& low) const {
        std::string path;
        for (std::size_t i = 0; i < high.size(); ++i) {
            path +=
                fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', column_x(i), panel.y(high[i]));
        }
        for (std::size_t i = low.size(); i > 0; --i) {
            path += fmt::format("L{:.1f} {:.1f}", column_x(i - 1), panel.y(low[i - 1]));
        }
        return path.empty() ? path : path + "Z";
    }

    void stroke(std::string_view path, std::string_view colour, double width) {
        sheet_.raw(
            fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                        "stroke-linejoin=\"round\"/>\n",
                        path,
                        colour,
                        width));
    }
    void fill(std::string_view path, std::string_view colour) {
        sheet_.raw(fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", path, colour));
    }

    /// Of every column, by what `value` says.
    template <typename Value>
    [[nodiscard]] Values collect(Value&& value) const {
        Values values;
        values.reserve(data_.columns().size());
        for (const PlotColumn& column : data_.columns()) {
            values.push_back(value(column));
        }
        return values;
    }

    void head();
    void waveform();
    Expected<void> spectrogram();
    void onsets();
    void beats();
    void beat_row(std::span<const BeatEvent> beats,
                  std::span<const BeatEvent> others,
                  double foot,
                  double length);
    void tempo();
    void bar();
    void confidence();

    const PlotData& data_;
    const PlotLabels& labels_;
    PlotSheet sheet_;
};

void Plotter::head() {
    std::string about = fmt::format(
        "{:.1f} s, beats by {}: {}", data_.duration(), labels_.method, data_.beats().size());
    const Values bpm =
        collect([](const PlotColumn& c) { return c.states > 0 ? c.bpm / c.states : 0.0; });
    if (const double median = quantile(bpm, 0.5); median > 0.0 && !data_.beats().empty()) {
        about += fmt::format(", median tempo {:.1f} BPM", median);
    }
    if (labels_.reference) {
        about += fmt::format(", F {:.1f} % against {} reference beats (within 70 ms, from 5 s on)",
                             100.0 * f_measure(data_.beats(), *labels_.reference),
                             labels_.reference->size());
    }
    sheet_.header(labels_.title, about);
}

void Plotter::waveform() {
    const Values low = collect([](const PlotColumn& c) { return static_cast<double>(c.low); });
    const Values high = collect([](const PlotColumn& c) { return static_cast<double>(c.high); });
    double peak = 0.01;
    for (std::size_t i = 0; i < low.size(); ++i) {
        peak = std::max({peak, -low[i], high[i]});
    }
    const Panel panel =
        sheet_.begin_panel({"waveform", "Waveform", "amplitude", 76.0, -peak, peak});
    sheet_.tick(panel, peak, fmt::format("{:.2f}", peak));
    sheet_.tick(panel, 0.0, "0");
    sheet_.tick(panel, -peak, fmt::format("-{:.2f}", peak));
    fill(area(panel, high, low), kGrey);
    stroke(line(panel, high), kGrey, 0.6);
    sheet_.end_panel();
}

/// Dark to bright, after matplotlib's "magma".
std::array<std::uint8_t, 4> colour_of(float share) {
    constexpr std::array<std::array<float, 3>, 6> kStops = {{{2, 3, 18},
                                                             {58, 15, 110},
                                                             {138, 34, 127},
                                                             {220, 66, 102},
                                                             {252, 148, 102},
                                                             {252, 250, 190}}};
    // 64 shades pack three times smaller than all, and look the same.
    const float at = std::round(std::clamp(share, 0.0F, 1.0F) * 63.0F) / 63.0F *
                     static_cast<float>(kStops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const float part = at - static_cast<float>(i);
    std::array<std::uint8_t, 4> rgba{0, 0, 0, 255};
    for (std::size_t k = 0; k < 3; ++k) {
        rgba[k] =
            static_cast<std::uint8_t>(kStops[i][k] + part * (kStops[i + 1][k] - kStops[i][k]));
    }
    return rgba;
}

Expected<void> Plotter::spectrogram() {
    const Panel panel =
        sheet_.begin_panel({"spectrogram", "Spectrogram", "Hz (mel scale)", 180.0, 0.0, 1.0});
    const auto columns = data_.columns();
    if (!columns.empty()) {
        std::vector<std::uint8_t> rgba(columns.size() * kPlotBands * 4);
        for (std::size_t row = 0; row < kPlotBands; ++row) {
            for (std::size_t i = 0; i < columns.size(); ++i) {
                const float level =
                    columns[i].hops > 0 ? columns[i].level[kPlotBands - 1 - row] : kQuietest;
                const auto colour = colour_of((level - kQuietest) / (kLoudest - kQuietest));
                std::copy(
                    colour.begin(),
                    colour.end(),
                    rgba.begin() + static_cast<std::ptrdiff_t>((row * columns.size() + i) * 4));
            }
        }
        auto png = render::encode_png(
            static_cast<int>(columns.size()), static_cast<int>(kPlotBands), rgba);
        if (!png) {
            return fail(std::move(png.error()));
        }
        sheet_.raw(
            fmt::format("<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                        "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                        PlotSheet::kLeft,
                        panel.top,
                        column_x(columns.size()) - PlotSheet::kLeft,
                        panel.height,
                        base64(*png)));
    }
    const auto mel = [](double hertz) { return std::log10(1.0 + hertz / 700.0); };
    for (const auto& [hertz, label] : {std::pair(100.0, "100"),
                                       std::pair(500.0, "500"),
                                       std::pair(1000.0, "1k"),
                                       std::pair(2000.0, "2k"),
                                       std::pair(4000.0, "4k"),
                                       std::pair(8000.0, "8k"),
                                       std::pair(16000.0, "16k")}) {
        sheet_.tick(panel, (mel(hertz) - mel(30.0)) / (mel(16000.0) - mel(30.0)), label);
    }
    for (const float share : {1.0F, 0.75F, 0.5F, 0.25F, 0.0F}) {
        const auto c = colour_of(share);
        sheet_.legend(panel,
                      fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]),
                      fmt::format("{:.0f} dBFS", kQuietest + share * (kLoudest - kQuietest)));
    }
    sheet_.end_panel();
    return {};
}

void Plotter::onsets() {
    const Values strength =
        collect([](const PlotColumn& c) { return static_cast<double>(c.strength); });
    const Values threshold =
        collect([](const PlotColumn& c) { return static_cast<double>(c.threshold); });
    Values below = strength;
    for (std::size_t i = 0; i < below.size(); ++i) {
        below[i] = std::min(strength[i], threshold[i]);
    }
    // A single clash must not flatten all the rest.
    const double top = std::max(1.0, 1.1 * quantile(strength, 0.998));
    const Panel panel = sheet_.begin_panel(
        {"onsets", "Onset strength (spectral energy flux)", "flux", 120.0, 0.0, top});
    sheet_.tick(panel, 0.0, "0");
    const double step = std::pow(10.0, std::floor(std::log10(0.5 * top)));
    for (double value = step * std::max(1.0, std::round(0.4 * top / step)); value < top;
         value *= 2.0) {
        sheet_.tick(panel, value, fmt::format("{:g}", value));
    }
    sheet_.legend(panel, kOrange, "threshold (moving median)");
    sheet_.legend(panel, kPale, "below it");
    sheet_.legend(panel, kBlue, "onset");
    fill(area(panel, strength, Values(strength.size(), 0.0)), kBlue);
    fill(area(panel, below, Values(below.size(), 0.0)), kPale);
    stroke(line(panel, threshold), kOrange, 1.2);
    sheet_.end_panel();
}

void Plotter::beat_row(std::span<const BeatEvent> beats,
                       std::span<const BeatEvent> others,
                       double foot,
                       double length) {
    const std::vector<bool> hits = hits_of(beats, others);
    std::array<std::string, 2> paths;  // misses, hits
    std::array<double, 2> last = {-1.0, -1.0};
    std::string downbeats;
    for (std::size_t i = 0; i < beats.size(); ++i) {
        const std::size_t kind = hits[i] ? 1 : 0;
        const double at = sheet_.x(to_seconds(beats[i].time));
        if (at < last[kind] + kLeastGap) {
            continue;
        }
        last[kind] = at;
        const bool is_downbeat = beats[i].bar_position == 1;
        const double reach = is_downbeat ? length : 0.66 * length;
        paths[kind] += fmt::format("M{:.1f} {:.1f}v-{:.1f}", at, foot, reach);
        if (is_downbeat) {
            downbeats += fmt::format("M{0:.1f} {1:.1f}l-3.2 -5h6.4z", at, foot - reach + 2.0);
        }
    }
    const bool is_compared = labels_.reference.has_value();
    stroke(paths[0], is_compared ? kRed : kBlue, 1.6);
    stroke(paths[1], kGreen, 1.6);
    fill(downbeats, "#0f172a");
}

void Plotter::beats() {
    const bool is_compared = labels_.reference.has_value();
    const double height = is_compared ? 92.0 : 50.0;
    const Panel panel = sheet_.begin_panel(
        {"beats", is_compared ? "Beats against the reference" : "Beats", "", height, 0.0, 1.0});
    sheet_.legend(panel, "#0f172a", "downbeat");
    if (is_compared) {
        sheet_.legend(panel, kRed, "not matched");
        sheet_.legend(panel, kGreen, "within 70 ms");
        sheet_.tick(panel, 0.75, "tracker");
        sheet_.tick(panel, 0.25, "reference");
        beat_row(data_.beats(), *labels_.reference, panel.top + 44.0, 36.0);
        beat_row(*labels_.reference, data_.beats(), panel.top + 90.0, 36.0);
    } else {
        sheet_.tick(panel, 0.5, "tracker");
        beat_row(data_.beats(), {}, panel.top + panel.height - 2.0, 40.0);
    }
    sheet_.end_panel();
}

void Plotter::tempo() {
    const Values bpm =
        collect([](const PlotColumn& c) { return c.states > 0 ? c.bpm / c.states : std::nan(""); });
    Values seen;
    std::copy_if(
        bpm.begin(), bpm.end(), std::back_inserter(seen), [](double v) { return !std::isnan(v); });
    std::string dots;
    Values reference;
    std::vector<double> reference_x;
    if (labels_.reference) {
        const auto& beats = *labels_.reference;
        for (std::size_t i = 1; i < beats.size(); ++i) {
            const double at = 0.5 * (to_seconds(beats[i - 1].time) + to_seconds(beats[i].time));
            const double x = sheet_.x(at);
            if (reference_x.empty() || x > reference_x.back() + 2.0) {
                reference_x.push_back(x);
                reference.push_back(60.0 / to_seconds(beats[i].time - beats[i - 1].time));
            }
        }
    }
    seen.insert(seen.end(), reference.begin(), reference.end());
    double low = seen.empty() ? 100.0 : quantile(seen, 0.005);
    double high = seen.empty() ? 140.0 : quantile(seen, 0.995);
    const double spare = std::max(0.12 * (high - low), 0.5 * (24.0 - (high - low)));
    low = std::max(0.0, low - std::max(4.0, spare));
    high += std::max(4.0, spare);
    const Panel panel = sheet_.begin_panel({"tempo", "Tempo", "BPM", 110.0, low, high});
    const double step = high - low > 120.0 ? 40.0 : high - low > 50.0 ? 20.0 : 10.0;
    for (double value = step * std::ceil(low / step); value <= high; value += step) {
        sheet_.tick(panel, value, fmt::format("{:.0f}", value));
    }
    if (labels_.reference) {
        sheet_.legend(panel, kOrange, "reference intervals");
    }
    sheet_.legend(panel, kBlue, "tracker");
    for (std::size_t i = 0; i < reference.size(); ++i) {
        dots += fmt::format("M{:.1f} {:.1f}h0", reference_x[i], panel.y(reference[i]));
    }
    sheet_.raw(
        fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"4\" stroke-linecap=\"round\"/>\n",
                    dots,
                    kOrange));
    stroke(line(panel, bpm), kBlue, 1.6);
    sheet_.end_panel();
}

void Plotter::bar() {
    int positions = 4;
    bool is_known = false;
    for (const BeatEvent& beat : data_.beats()) {
        positions = std::max(positions, beat.bar_position);
        is_known = is_known || beat.bar_position > 0;
    }
    const Panel panel =
        sheet_.begin_panel({"bar", "Bar position", "beat", 76.0, 0.4, positions + 0.6});
    for (int position = 1; position <= positions; ++position) {
        sheet_.tick(panel, position, fmt::format("{}", position));
    }
    if (!is_known) {
        sheet_.note(panel, "this tracker knows no bars");
    }
    const auto dots = [&](std::span<const BeatEvent> beats) {
        std::string path;
        double last = -1.0;
        for (const BeatEvent& beat : beats) {
            const double at = sheet_.x(to_seconds(beat.time));
            if (beat.bar_position > 0 && beat.bar_position <= positions && at >= last + kLeastGap) {
                last = at;
                path += fmt::format("M{:.1f} {:.1f}h0", at, panel.y(beat.bar_position));
            }
        }
        return path;
    };
    const auto draw = [&](std::span<const BeatEvent> beats, const char* colour, double width) {
        sheet_.raw(fmt::format(
            "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\"/>\n",
            dots(beats),
            colour,
            width));
    };
    if (labels_.reference) {
        sheet_.legend(panel, kOrange, "reference");
        draw(*labels_.reference, kOrange, 8.0);
        draw(*labels_.reference, "#f8fafc", 5.0);
    }
    sheet_.legend(panel, kBlue, "tracker");
    draw(data_.beats(), kBlue, 4.5);
    sheet_.end_panel();
}

void Plotter::confidence() {
    const Values values =
        collect([](const PlotColumn& c) { return c.states > 0 ? c.confidence / c.states : 0.0; });
    const Panel panel = sheet_.begin_panel({"confidence", "Confidence", "0 to 1", 64.0, 0.0, 1.0});
    sheet_.tick(panel, 0.0, "0");
    sheet_.tick(panel, 0.5, "0.5");
    sheet_.tick(panel, 1.0, "1");
    fill(area(panel, values, Values(values.size(), 0.0)), "#ccfbf1");
    stroke(line(panel, values), kTeal, 1.4);
    sheet_.end_panel();
}

}  // namespace

Expected<std::string> draw_plot(const PlotData& data, const PlotLabels& labels) {
    return Plotter(data, labels).draw();
}

}  // namespace raks::engine
