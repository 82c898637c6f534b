#include "apps/reports/figure_report_charts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "apps/reports/chart.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using motion::FeatureCurve;
using motion::FigureReport;
using motion::Part;
using motion::PartReport;
using motion::PartSelection;
using motion::StatesTried;

constexpr const char* kGrey = "#64748b";
constexpr const char* kInk = "#0f172a";

// The report of one part of the body.
const PartReport& part_of(const FigureReport& report, Part part) {
    return report.parts[static_cast<std::size_t>(part)];
}

// SVG attributes of a line.
std::string stroke(std::string_view colour, double width) {
    return fmt::format("stroke=\"{}\" stroke-width=\"{:.1f}\"", colour, width);
}

// The range [low, high], widened on both sides by a share of it, and to at least `least`.
Chart::Range padded(double low, double high, double share, double least) {
    const double spare = std::max(share * (high - low), 0.5 * (least - (high - low)));
    return {low - spare, high + spare};
}

// Ticks at states 1 to n; every second one when there are more than 12, so that the labels do not
// touch.
void tick_states(Chart& chart, std::size_t states, double offset) {
    const std::size_t step = states > 12 ? 2 : 1;
    for (std::size_t k = 0; k < states; k += step) {
        chart.tick_x(static_cast<double>(k) + offset, std::to_string(k + 1));
    }
}

// An empty chart for one line of the selection: x spans the numbers tried, y the values of this
// line. Without a label of x it is lower: the chart below carries the label.
Chart selection_chart(const PartSelection& selection,
                      double StatesTried::*value,
                      double height,
                      std::string_view label) {
    double low = selection.tried.front().*value;
    double high = low;
    for (const StatesTried& tried : selection.tried) {
        low = std::min(low, tried.*value);
        high = std::max(high, tried.*value);
    }
    // A little room beyond the first and last number, for dots and rings.
    Chart chart({.height = height,
                 .x = {selection.tried.front().states - 0.6, selection.tried.back().states + 0.6},
                 .y = padded(low, high, 0.14, 0.2),
                 .x_label = label,
                 .bottom = label.empty() ? 18.0 : 34.0});
    chart.grid_y(height > 150.0 ? 5 : 3);
    for (const StatesTried& tried : selection.tried) {
        if (selection.tried.size() <= 12 || tried.states % 2 == 0) {
            chart.tick_x(tried.states, std::to_string(tried.states));
        }
    }
    return chart;
}

// The line's points: number of states and value.
std::vector<Chart::Point> points_of(const PartSelection& selection, double StatesTried::*value) {
    std::vector<Chart::Point> points;
    for (const StatesTried& tried : selection.tried) {
        points.emplace_back(tried.states, tried.*value);
    }
    return points;
}

// A curve's points: x is the beat, from 0 at count 1.
std::vector<Chart::Point> curve_points(const std::vector<double>& values, double samples_per_beat) {
    std::vector<Chart::Point> points;
    for (std::size_t i = 0; i < values.size(); ++i) {
        points.emplace_back(static_cast<double>(i) / samples_per_beat, values[i]);
    }
    return points;
}

// The means of the states along a path, as steps: each state gives a point where it begins and one
// where it ends.
std::vector<Chart::Point> step_points(const std::vector<double>& means,
                                      const std::vector<std::size_t>& path,
                                      double samples_per_beat) {
    std::vector<Chart::Point> points;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const bool is_first = i == 0 || path[i] != path[i - 1];
        const bool is_last = i + 1 == path.size() || path[i] != path[i + 1];
        if (is_first) {
            points.emplace_back(static_cast<double>(i) / samples_per_beat, means[path[i]]);
        }
        if (is_last) {
            points.emplace_back(static_cast<double>(i + 1) / samples_per_beat, means[path[i]]);
        }
    }
    return points;
}

// Mean and sample standard deviation.
struct MeanAndDeviation {
    double mean = 0.0;
    double deviation = 0.0;
};

// Divided by n - 1: the repeats are a sample. One value has no deviation.
MeanAndDeviation spread_of(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double square = 0.0;
    for (const double value : values) {
        square += (value - mean) * (value - mean);
    }
    return {mean, values.size() > 1 ? std::sqrt(square / (n - 1.0)) : 0.0};
}

}  // namespace

const char* colour_of(Part part) {
    constexpr std::array<const char*, 3> kColours = {"#2563eb", "#c2410c", "#0f766e"};
    return kColours[static_cast<std::size_t>(part)];
}

// Two charts: held-out on top, since it decides; training below, which only rises.
std::string draw_selection(Part part, const PartSelection& selection) {
    const char* const colour = colour_of(part);
    Chart held_out = selection_chart(selection, &StatesTried::held_out, 210.0, "");
    const auto points = points_of(selection, &StatesTried::held_out);
    held_out.line(points, stroke(colour, 2.0));
    for (const Chart::Point& point : points) {
        held_out.dot(point, 2.6, fmt::format("fill=\"{}\"", colour));
    }
    // Solid ring: the chosen number. Dashed ring: the peak, where that is another.
    for (const Chart::Point& point : points) {
        const int states = static_cast<int>(point.first);
        if (states == selection.chosen) {
            held_out.dot(point, 7.0, fmt::format("fill=\"none\" {}", stroke(kInk, 1.6)));
        } else if (states == selection.peak) {
            held_out.dot(
                point,
                6.0,
                fmt::format("fill=\"none\" stroke-dasharray=\"2.5 2\" {}", stroke(kGrey, 1.2)));
        }
    }
    Chart training = selection_chart(selection, &StatesTried::training, 118.0, "number of states");
    training.line(points_of(selection, &StatesTried::training), stroke(kGrey, 1.8));
    return "<div class=\"over\">held out, nats a sample</div>\n" + held_out.svg() +
           "<div class=\"over\">training, nats a sample</div>\n" + training.svg();
}

// All repeats share one range of y, so that they can be compared.
std::string draw_curve(Part part, const FeatureCurve& curve, const FigureReport& report) {
    double low = *std::min_element(curve.state_means.begin(), curve.state_means.end());
    double high = *std::max_element(curve.state_means.begin(), curve.state_means.end());
    for (const std::vector<double>& values : curve.repeats) {
        const auto [least, most] = std::minmax_element(values.begin(), values.end());
        low = std::min(low, *least);
        high = std::max(high, *most);
    }
    const double samples_per_beat = report.samples_per_beat;
    std::string row;
    for (std::size_t i = 0; i < curve.repeats.size(); ++i) {
        Chart chart({.width = 290.0,
                     .height = 122.0,
                     .x = {0.0, static_cast<double>(report.beats)},
                     .y = padded(low, high, 0.06, 0.01),
                     .left = 40.0,
                     .bottom = 18.0,
                     .top = 4.0});
        chart.grid_y(3);
        // Count c begins at beat c - 1.
        for (int count = 1; count <= report.beats; ++count) {
            chart.tick_x(count - 1.0, std::to_string(count));
        }
        chart.line(curve_points(curve.repeats[i], samples_per_beat), stroke(kGrey, 1.3));
        // Each repeat has a state path of its own.
        chart.line(
            step_points(
                curve.state_means, part_of(report, part).paths[report.shown[i]], samples_per_beat),
            stroke(colour_of(part), 2.2));
        row += chart.svg();
    }
    return row;
}

std::string draw_occurrence(Part part, const FigureReport& report) {
    const PartReport& data = part_of(report, part);
    const double states = static_cast<double>(data.states());
    const double counts = static_cast<double>(report.beats);
    // One row of 23 pixels a count, and the margins.
    Chart chart({.height = 44.0 + 23.0 * counts,
                 .x = {0.0, states},
                 // From high to low: count 1 is at the top.
                 .y = {counts, 0.0},
                 .x_label = "state",
                 .left = 28.0});
    // Width of a cell in pixels: the chart's width less its margins.
    const double cell = (380.0 - 36.0) / states;
    for (std::size_t c = 0; c < data.occurrence.size(); ++c) {
        const double count = static_cast<double>(c);
        chart.tick_y(count + 0.5, std::to_string(c + 1));
        for (std::size_t k = 0; k < data.states(); ++k) {
            const double state = static_cast<double>(k);
            const double share = data.occurrence[c][k];
            // Below half a per cent nothing is drawn.
            if (share < 0.005) {
                continue;
            }
            // Even small shares keep a visible shade.
            chart.box({state, count},
                      {state + 1.0, count + 1.0},
                      fmt::format("fill=\"{}\" fill-opacity=\"{:.2f}\"",
                                  colour_of(part),
                                  std::min(1.0, 0.06 + 0.94 * share)));
            // Numbers only where they fit and say something.
            if (cell > 15.0 && share >= 0.095) {
                chart.mark({state + 0.5, count + 0.5},
                           3.5,
                           // White on dark cells.
                           share > 0.45 ? "#ffffff" : kInk,
                           fmt::format("{:.0f}", 100.0 * share));
            }
        }
    }
    tick_states(chart, data.states(), 0.5);
    return chart.svg();
}

// The longest stay sets the range: every dot and every whisker must fit.
std::string draw_stays(Part part, const FigureReport& report) {
    const PartReport& data = part_of(report, part);
    double longest = 0.0;
    for (const std::vector<double>& stays : data.stays) {
        const MeanAndDeviation spread = spread_of(stays);
        longest = std::max({longest,
                            *std::max_element(stays.begin(), stays.end()),
                            spread.mean + spread.deviation});
    }
    const double states = static_cast<double>(data.states());
    Chart chart({.x = {0.0, states}, .y = {0.0, 1.08 * longest}, .x_label = "state", .left = 36.0});
    chart.grid_y(4);
    // All states of the same length would last this many beats.
    const double even = report.beats / states;
    const std::array<Chart::Point, 2> even_line = {Chart::Point{0.0, even}, {states, even}};
    chart.line(even_line, fmt::format("stroke-dasharray=\"4 4\" {}", stroke(kGrey, 1.2)));
    for (std::size_t k = 0; k < data.states(); ++k) {
        const std::vector<double>& stays = data.stays[k];
        const double middle = static_cast<double>(k) + 0.5;
        for (std::size_t r = 0; r < stays.size(); ++r) {
            // Side by side in the order of the repeats, so that equal ones can be told apart.
            const double aside =
                stays.size() > 1 ? static_cast<double>(r) / static_cast<double>(stays.size() - 1)
                                 : 0.5;
            chart.dot({middle + 0.5 * (aside - 0.5), stays[r]},
                      2.2,
                      fmt::format("fill=\"{}\" fill-opacity=\"0.45\"", colour_of(part)));
        }
        // Bar: mean. Whisker: one standard deviation to either side.
        const MeanAndDeviation spread = spread_of(stays);
        const std::array<Chart::Point, 2> whisker = {
            Chart::Point{middle, std::max(0.0, spread.mean - spread.deviation)},
            {middle, spread.mean + spread.deviation}};
        const std::array<Chart::Point, 2> bar = {Chart::Point{middle - 0.3, spread.mean},
                                                 {middle + 0.3, spread.mean}};
        chart.line(whisker, stroke(kInk, 1.2));
        chart.line(bar, stroke(kInk, 2.2));
    }
    tick_states(chart, data.states(), 0.5);
    return chart.svg();
}

}  // namespace raks::apps
