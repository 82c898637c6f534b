#include <algorithm>
#include <array>
#include <cmath>
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
    for (const MusicEvent& event : data_.events()) {
        const double at = sheet_.x(to_seconds(event.time));
        row = at < last + kNameWidth ? (row + 1) % 4 : 0;
        last = at;
        lines += fmt::format("M{:.1f} {:.1f}v{:.1f}", at, panel.top, panel.height);
        sheet_.raw(fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\">{}</text>\n",
                               at + 3.0,
                               panel.top + 13.0 + 15.0 * row,
                               music_event_name(event.kind)));
    }
    stroke(lines, kRed, 1.2);
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
