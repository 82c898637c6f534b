#include "apps/reports/plot_svg.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/reports/plotter.hpp"
#include "apps/reports/svg_path.hpp"
#include "base/statistics.hpp"
#include "render/video/png.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using namespace plot_colour;

constexpr float kQuietest = -90.0F;  // dBFS, black
constexpr float kLoudest = -15.0F;   // dBFS, bright

// Colour of a share in [0, 1]: dark to bright, after matplotlib's "magma", as RGBA.
std::array<std::uint8_t, 4> colour_of(float share) {
    constexpr std::array<std::array<float, 3>, 6> kStops = {{{2, 3, 18},
                                                             {58, 15, 110},
                                                             {138, 34, 127},
                                                             {220, 66, 102},
                                                             {252, 148, 102},
                                                             {252, 250, 190}}};
    // 64 shades: the image compresses three times smaller than with all of them and looks the same.
    const float at = std::round(std::clamp(share, 0.0F, 1.0F) * 63.0F) / 63.0F *
                     static_cast<float>(kStops.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    // Linear between the two nearest stops.
    const float part = at - static_cast<float>(i);
    std::array<std::uint8_t, 4> rgba{0, 0, 0, 255};
    for (std::size_t k = 0; k < 3; ++k) {
        rgba[k] =
            static_cast<std::uint8_t>(kStops[i][k] + part * (kStops[i + 1][k] - kStops[i][k]));
    }
    return rgba;
}

}  // namespace

// Panels from top to bottom.
Expected<std::string> Plotter::draw() {
    head();
    waveform();
    if (auto drawn = spectrogram(); !drawn) {
        return fail(std::move(drawn.error()));
    }
    onsets();
    beats();
    tempo();
    bar();
    beat_parts();
    confidence();
    numbers();
    form();
    repeats();
    accents();
    return sheet_.finish();
}

// SVG path of a line; each NaN ends a stretch, the next value begins another.
std::string Plotter::line(const Panel& panel, const Values& values) const {
    SvgPath path;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (std::isnan(values[i])) {
            path.lift();
        } else {
            path.to(column_x(i), panel.y(values[i]));
        }
    }
    return path.data();
}

// SVG path: along the upper values from left to right and back along the lower ones.
std::string Plotter::area(const Panel& panel, const Values& high, const Values& low) const {
    SvgPath path;
    for (std::size_t i = 0; i < high.size(); ++i) {
        path.to(column_x(i), panel.y(high[i]));
    }
    for (std::size_t i = low.size(); i > 0; --i) {
        path.to(column_x(i - 1), panel.y(low[i - 1]));
    }
    path.close();
    return path.data();
}

void Plotter::stroke(std::string_view path, std::string_view colour, double width) {
    sheet_.raw(
        fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                    "stroke-linejoin=\"round\"/>\n",
                    path,
                    colour,
                    width));
}

void Plotter::dots(std::string_view path, std::string_view colour, double width) {
    sheet_.raw(
        fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\"/>\n",
                    path,
                    colour,
                    width));
}

void Plotter::fill(std::string_view path, std::string_view colour) {
    sheet_.raw(fmt::format("<path d=\"{}\" fill=\"{}\"/>\n", path, colour));
}

// Title and one line of numbers.
void Plotter::head() {
    std::string about = fmt::format(
        "{:.1f} s, beats by {}: {}", data_.duration(), labels_.method, data_.beats().size());
    const Values bpm =
        collect([](const PlotColumn& c) { return c.tempi > 0 ? c.bpm / c.tempi : 0.0; });
    if (const double median = lower_percentile(bpm, 0.5); median > 0.0 && !data_.beats().empty()) {
        about += fmt::format(", median tempo {:.1f} BPM", median);
    }
    if (labels_.reference) {
        about += fmt::format(", F {:.1f} % against {} reference beats (within 70 ms, from 5 s on)",
                             100.0 * f_measure(),
                             labels_.reference->size());
    }
    sheet_.header(labels_.title, about);
}

// Lowest and highest sample of each column; the scale follows the loudest sample of the file.
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

// The spectrogram is an image: as rectangles it would be too large a file.
Expected<void> Plotter::spectrogram() {
    const Panel panel =
        sheet_.begin_panel({"spectrogram", "Spectrogram", "Hz (mel scale)", 180.0, 0.0, 1.0});
    const auto columns = data_.columns();
    if (!columns.empty()) {
        std::vector<std::uint8_t> rgba(columns.size() * kPlotBands * 4);
        // Row 0 of the image is the highest band.
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
        // Stretched to the end of the last column, which may lie beyond the file's end.
        sheet_.raw(
            fmt::format("<image x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" "
                        "preserveAspectRatio=\"none\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                        PlotSheet::kLeft,
                        panel.top,
                        column_x(columns.size()) - PlotSheet::kLeft,
                        panel.height,
                        base64(*png)));
    }
    // Place of a frequency on the panel's mel axis; the factor of the mel scale cancels.
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
    // The legend shows five levels with their colours.
    for (const float share : {1.0F, 0.75F, 0.5F, 0.25F, 0.0F}) {
        const auto c = colour_of(share);
        sheet_.legend(panel,
                      fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]),
                      fmt::format("{:.0f} dBFS", kQuietest + share * (kLoudest - kQuietest)));
    }
    sheet_.end_panel();
    return {};
}

// Onset strength: what lies above the threshold in full colour, what lies below in a pale one.
void Plotter::onsets() {
    const Values strength =
        collect([](const PlotColumn& c) { return static_cast<double>(c.strength); });
    const Values threshold =
        collect([](const PlotColumn& c) { return static_cast<double>(c.threshold); });
    Values below = strength;
    for (std::size_t i = 0; i < below.size(); ++i) {
        below[i] = std::min(strength[i], threshold[i]);
    }
    // The scale follows nearly all values: a single loud onset must not flatten the rest.
    const double top = std::max(1.0, 1.1 * lower_percentile(strength, 0.998));
    const Panel panel = sheet_.begin_panel(
        {"onsets", "Onset strength (spectral energy flux)", "flux", 120.0, 0.0, top});
    sheet_.tick(panel, 0.0, "0");
    // Ticks double from one to the next.
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

Expected<std::string> draw_plot(const PlotData& data, const PlotLabels& labels) {
    return Plotter(data, labels).draw();
}

}  // namespace raks::apps
