#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>

#include "apps/reports/music_table.hpp"
#include "apps/reports/plotter.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using namespace plot_colour;

// In the order of MusicPart and of MusicAccent::Band.
constexpr std::array<const char*, 4> kPartColours = {"#e2e8f0", "#bbf7d0", "#fed7aa", "#fbcfe8"};
constexpr std::array<const char*, 3> kBandColours = {kBlue, kGreen, kOrange};
// Events closer than this, in SVG units, have their names in different rows.
constexpr double kNameWidth = 62.0;

}  // namespace

void Plotter::numbers() {
    for (std::size_t row = 0; row < kMusicTable.size(); ++row) {
        numbers_of(row);
    }
}

// Means of the columns. What is drawn in one panel has one unit and one range.
void Plotter::numbers_of(std::size_t row) {
    const MusicRow& about = kMusicTable[row];
    std::vector<std::size_t> drawn;
    for (std::size_t i = 0; i < about.used().size(); ++i) {
        if (about.fields[i].drawn != Drawn::no) {
            drawn.push_back(i);
        }
    }
    if (drawn.empty()) {
        return;
    }
    const MusicField& first = about.fields[drawn.front()];
    const double low = first.low;
    const double high = first.high;
    const std::string range = fmt::format("{:g} to {:g}", low, high);
    const Panel panel = sheet_.begin_panel({about.name,
                                            about.title,
                                            first.unit.empty() ? range : first.unit,
                                            about.panel_height,
                                            low,
                                            high});
    for (const double value : {low, 0.5 * (low + high), high}) {
        sheet_.tick(panel, value, fmt::format("{:g}", value));
    }
    const auto colour = [&](std::size_t i) {
        return about.fields[i].drawn == Drawn::area ? kPale : kRed;
    };
    for (std::size_t i = drawn.size(); i-- > 0 && drawn.size() > 1;) {
        sheet_.legend(panel, colour(drawn[i]), about.fields[drawn[i]].legend);
    }
    for (const std::size_t i : drawn) {
        const Values means = collect([&](const PlotColumn& column) {
            return column.states > 0 ? column.music[row][i] / column.states : low;
        });
        if (about.fields[i].drawn == Drawn::area) {
            fill(area(panel, means, Values(means.size(), low)), colour(i));
        } else {
            stroke(line(panel, means), colour(i), 1.6);
        }
    }
    sheet_.end_panel();
}

// Parts as coloured stretches, events as lines with their names.
void Plotter::form() {
    const Panel panel = sheet_.begin_panel({"form", "Parts and events", "", 64.0, 0.0, 1.0});
    const auto parts = data_.parts();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const double from = sheet_.x(to_seconds(parts[i].time));
        const double to =
            sheet_.x(i + 1 < parts.size() ? to_seconds(parts[i + 1].time) : data_.duration());
        sheet_.raw(fmt::format(
            "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\"/>\n",
            from,
            panel.top,
            std::max(0.0, to - from),
            panel.height,
            kPartColours[static_cast<std::size_t>(parts[i].part)]));
    }
    for (const MusicPart part :
         {MusicPart::build_up, MusicPart::breakdown, MusicPart::playing, MusicPart::stopped}) {
        sheet_.legend(panel, kPartColours[static_cast<std::size_t>(part)], music_part_name(part));
    }
    // Names go down row by row where they would lie over each other.
    double last = -kNameWidth;
    int row = 0;
    std::string lines;
    std::string names;
    for (const MusicEvent& event : data_.events()) {
        const double at = sheet_.x(to_seconds(event.time));
        row = at < last + kNameWidth ? (row + 1) % 4 : 0;
        last = at;
        lines += fmt::format("M{:.1f} {:.1f}v{:.1f}", at, panel.top, panel.height);
        names += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"event\">{}</text>\n",
                             at + 3.0,
                             panel.top + 13.0 + 15.0 * row,
                             music_event_name(event.kind));
    }
    // Names over the lines of the events that follow soon.
    stroke(lines, kRed, 1.2);
    sheet_.raw(names);
    sheet_.end_panel();
}

// A stretch that comes again has the colour of its first time, which lies in the row above.
void Plotter::repeats() {
    const auto bars = data_.bars();
    if (bars.empty()) {
        return;
    }
    const Panel panel = sheet_.begin_panel(
        {"repeats", "Bars that come again, under their first times", "", 28.0, 0.0, 1.0});
    const auto x_of = [&](std::size_t bar) {
        return sheet_.x(bar < bars.size() ? to_seconds(bars[bar].time) : data_.duration());
    };
    constexpr std::array<const char*, 5> kColours = {kBlue, kOrange, kGreen, kRed, kTeal};
    const auto draw = [&](std::size_t first, std::size_t end, double row, const char* colour) {
        sheet_.raw(
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"10\" "
                        "fill=\"{}\"/>\n",
                        x_of(first) + 1.0,
                        panel.top + row,
                        std::max(0.0, x_of(end) - x_of(first) - 2.0),
                        colour));
    };
    std::map<int, const char*> colours;  // by the first bar of the first time
    for (std::size_t bar = 0; bar < bars.size();) {
        std::size_t end = bar + 1;
        while (end < bars.size() && bars[bar].repeats >= 0 &&
               bars[end].repeats == bars[end - 1].repeats + 1) {
            ++end;
        }
        if (bars[bar].repeats >= 0) {
            const auto first = static_cast<std::size_t>(bars[bar].repeats);
            const auto found =
                colours.try_emplace(bars[bar].repeats, kColours[colours.size() % kColours.size()]);
            draw(first, first + (end - bar), 3.0, found.first->second);
            draw(bar, end, 15.0, found.first->second);
        }
        bar = end;
    }
    if (colours.empty()) {
        sheet_.note(panel, "no bars come again");
    }
    sheet_.end_panel();
}

// Accents as marks as high as they are strong, in the colour of their band; a dot on top of those
// that lie off the beat.
void Plotter::accents() {
    const Panel panel = sheet_.begin_panel({"accents", "Accents", "strength", 64.0, 0.0, 1.0});
    sheet_.tick(panel, 0.0, "0");
    sheet_.tick(panel, 1.0, "1");
    sheet_.legend(panel, kRed, "off the beat");
    for (std::size_t i = kBandColours.size(); i-- > 0;) {
        sheet_.legend(panel, kBandColours[i], music_band_name(static_cast<MusicAccent::Band>(i)));
    }
    std::array<std::string, kBandColours.size()> paths;
    std::string off_beat;
    for (const MusicAccent& accent : data_.accents()) {
        const double at = sheet_.x(to_seconds(accent.time));
        const double top = panel.y(static_cast<double>(accent.strength));
        paths[static_cast<std::size_t>(accent.band)] +=
            fmt::format("M{:.1f} {:.1f}V{:.1f}", at, panel.top + panel.height, top);
        if (!accent.is_on_beat) {
            off_beat += fmt::format("M{:.1f} {:.1f}h0", at, top);
        }
    }
    for (std::size_t i = 0; i < paths.size(); ++i) {
        stroke(paths[i], kBandColours[i], 1.6);
    }
    dots(off_beat, kRed, 4.0);
    sheet_.end_panel();
}

}  // namespace raks::apps
