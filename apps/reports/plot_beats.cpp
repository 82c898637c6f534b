#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <utility>

#include "apps/reports/plotter.hpp"
#include "base/statistics.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using namespace plot_colour;

// Least distance of two marks in SVG units: closer ones cannot be told apart and only lengthen the
// file.
constexpr double kLeastGap = 0.4;
// Largest distance of a beat from its reference beat, to either side: that of the usual F-measure.
constexpr Nanos kHitWindow = std::chrono::milliseconds(70);
// Earlier beats are not scored, as a tracker needs time to lock.
constexpr Nanos kScoredFrom = std::chrono::seconds(5);

// For each of `beats` whether it has a beat of `others` within the window. Each beat matches one at
// most; both lists ascend, so that the earliest pair is matched first.
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

// The beats that are scored: those from 5 s on.
std::span<const BeatEvent> scored(std::span<const BeatEvent> beats) {
    const auto first = std::find_if(beats.begin(), beats.end(), [](const BeatEvent& beat) {
        return beat.time >= StreamTime(kScoredFrom);
    });
    return {first, beats.end()};
}

bool has_beat(const PlotColumn& column) {
    constexpr double kLeastConfidence = 0.1;
    return column.tempi > 0 && column.confidence > kLeastConfidence * column.tempi;
}

// Whether the other tempo of a column is drawn. Where nothing has a beat, all tempi are as likely.
bool is_worth_telling(const PlotColumn& column) {
    constexpr float kLeastProbability = 0.1F;
    return has_beat(column) && column.rival.probability >= kLeastProbability;
}

// Into how many parts most beats of a column are divided; 0: nothing has a beat.
int parts_of_beats(const PlotColumn& column) {
    return !has_beat(column) ? 0 : 2 * column.in_three > column.tempi ? 3 : 2;
}

}  // namespace

// F = 2 hits / (beats + reference beats); 0 when there are neither.
double Plotter::f_measure() const {
    const auto beats = scored(data_.beats());
    const auto reference = scored(*labels_.reference);
    const auto hits = hits_of(beats, reference);
    const auto found = static_cast<double>(std::count(hits.begin(), hits.end(), true));
    const auto both = static_cast<double>(beats.size() + reference.size());
    return both > 0.0 ? 2.0 * found / both : 0.0;
}

// One row of vertical marks: hits green, misses red (blue where nothing is compared). A downbeat is
// longer and has a small triangle.
void Plotter::beat_row(std::span<const BeatEvent> beats,
                       std::span<const BeatEvent> others,
                       double foot,
                       double length) {
    const std::vector<bool> hits = hits_of(beats, others);
    std::array<std::string, 2> paths;  // misses, hits
    // Marks are thinned for hits and misses apart: a miss beside a hit must stay visible.
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

// With a reference two rows: the tracker's beats above, the reference's below.
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

// Tempo of the tracker as a line; intervals of the reference as dots.
void Plotter::tempo() {
    // NaN breaks the line where no state is known.
    const Values bpm =
        collect([](const PlotColumn& c) { return c.tempi > 0 ? c.bpm / c.tempi : std::nan(""); });
    Values seen;
    std::copy_if(
        bpm.begin(), bpm.end(), std::back_inserter(seen), [](double v) { return !std::isnan(v); });
    std::string places;
    Values reference;
    std::vector<double> reference_x;
    if (labels_.reference) {
        const auto& beats = *labels_.reference;
        for (std::size_t i = 1; i < beats.size(); ++i) {
            // A dot stands in the middle of its interval, at least 2 units after the dot before.
            const double at = 0.5 * (to_seconds(beats[i - 1].time) + to_seconds(beats[i].time));
            const double x = sheet_.x(at);
            if (reference_x.empty() || x > reference_x.back() + 2.0) {
                reference_x.push_back(x);
                reference.push_back(60.0 / to_seconds(beats[i].time - beats[i - 1].time));
            }
        }
    }
    seen.insert(seen.end(), reference.begin(), reference.end());
    for (const PlotColumn& column : data_.columns()) {
        if (is_worth_telling(column)) {
            seen.push_back(column.rival.bpm);
        }
    }
    // The range is that of nearly all values: a single octave error must not flatten the rest.
    double low = seen.empty() ? 100.0 : lower_percentile(seen, 0.005);
    double high = seen.empty() ? 140.0 : lower_percentile(seen, 0.995);
    // At least 24 BPM, so that a steady tempo is not magnified into noise; never below 0.
    const double spare = std::max(0.12 * (high - low), 0.5 * (24.0 - (high - low)));
    low = std::max(0.0, low - std::max(4.0, spare));
    high += std::max(4.0, spare);
    const Panel panel = sheet_.begin_panel({"tempo", "Tempo", "BPM", 110.0, low, high});
    // Ticks every 10, 20 or 40 BPM.
    const double step = high - low > 120.0 ? 40.0 : high - low > 50.0 ? 20.0 : 10.0;
    for (double value = step * std::ceil(low / step); value <= high; value += step) {
        sheet_.tick(panel, value, fmt::format("{:.0f}", value));
    }
    if (labels_.reference) {
        sheet_.legend(panel, kOrange, "reference intervals");
    }
    sheet_.legend(panel, kRed, "may be instead, the larger the likelier");
    sheet_.legend(panel, kBlue, "tracker");
    for (std::size_t i = 0; i < reference.size(); ++i) {
        places += fmt::format("M{:.1f} {:.1f}h0", reference_x[i], panel.y(reference[i]));
    }
    dots(places, kOrange, 4.0);
    rival_tempi(panel);
    stroke(line(panel, bpm), kBlue, 1.6);
    sheet_.end_panel();
}

// The tempo that it may be instead, where there is a beat and that is not unlikely; larger dots are
// likelier.
void Plotter::rival_tempi(const Panel& panel) {
    constexpr std::array kSizes = {1.5, 2.5, 3.5};
    std::array<std::string, kSizes.size()> places;
    double last = -1.0;
    for (std::size_t i = 0; i < data_.columns().size(); ++i) {
        const RivalTempo& rival = data_.columns()[i].rival;
        const double at = column_x(i);
        if (!is_worth_telling(data_.columns()[i]) || at < last + kLeastGap) {
            continue;
        }
        last = at;
        const auto size = std::min<std::size_t>(kSizes.size() - 1,
                                                static_cast<std::size_t>(6.0F * rival.probability));
        places[size] += fmt::format("M{:.1f} {:.1f}h0", at, panel.y(rival.bpm));
    }
    for (std::size_t i = 0; i < kSizes.size(); ++i) {
        dots(places[i], kRed, kSizes[i]);
    }
}

// Position in the bar of each beat; as many rows as the longest bar has beats, at least four.
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
    const auto places_of = [&](std::span<const BeatEvent> beats) {
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
    if (labels_.reference) {
        sheet_.legend(panel, kOrange, "reference");
        // Rings: a wide dot with a light one over it, which the tracker's dot may fill.
        dots(places_of(*labels_.reference), kOrange, 8.0);
        dots(places_of(*labels_.reference), "#f8fafc", 5.0);
    }
    sheet_.legend(panel, kBlue, "tracker");
    dots(places_of(data_.beats()), kBlue, 4.5);
    sheet_.end_panel();
}

// Mean confidence of each column, as an area from 0; beside it that of the bar, and how likely
// another tempo is.
void Plotter::confidence() {
    const auto mean = [this](double PlotColumn::*sum) {
        return collect([sum](const PlotColumn& c) { return c.tempi > 0 ? c.*sum / c.tempi : 0.0; });
    };
    const Values beats = mean(&PlotColumn::confidence);
    const Values others = collect([](const PlotColumn& c) {
        return is_worth_telling(c) ? static_cast<double>(c.rival.probability) : 0.0;
    });
    const Panel panel = sheet_.begin_panel({"confidence", "Confidence", "0 to 1", 64.0, 0.0, 1.0});
    sheet_.legend(panel, kRed, "of another tempo");
    sheet_.legend(panel, kBlue, "of the bar");
    sheet_.legend(panel, kTeal, "of the beat");
    sheet_.tick(panel, 0.0, "0");
    sheet_.tick(panel, 0.5, "0.5");
    sheet_.tick(panel, 1.0, "1");
    fill(area(panel, beats, Values(beats.size(), 0.0)), "#ccfbf1");
    stroke(line(panel, others), kRed, 1.0);
    stroke(line(panel, mean(&PlotColumn::bar_confidence)), kBlue, 1.0);
    stroke(line(panel, beats), kTeal, 1.4);
    sheet_.end_panel();
}

// A strip in two colours: into how many parts the music divides most of a column's beats.
void Plotter::beat_parts() {
    const Panel panel = sheet_.begin_panel({"beat_parts", "Parts of a beat", "", 14.0, 0.0, 1.0});
    sheet_.legend(panel, kOrange, "three");
    sheet_.legend(panel, kPale, "two");
    const auto columns = data_.columns();
    std::array<std::string, 2> stretches;  // of two, of three
    for (std::size_t i = 0; i < columns.size();) {
        const auto parts = [&](std::size_t column) { return parts_of_beats(columns[column]); };
        const int now = parts(i);
        std::size_t end = i + 1;
        while (end < columns.size() && parts(end) == now) {
            ++end;
        }
        if (now > 0) {
            stretches[now == 3 ? 1 : 0] += fmt::format("M{:.1f} {:.1f}H{:.1f}v{:.1f}H{:.1f}z",
                                                       column_x(i),
                                                       panel.top,
                                                       column_x(end),
                                                       panel.height,
                                                       column_x(i));
        }
        i = end;
    }
    fill(stretches[0], kPale);
    fill(stretches[1], kOrange);
    sheet_.end_panel();
}

}  // namespace raks::apps
