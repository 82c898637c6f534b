#include "apps/reports/genre_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/reports/plot_sheet.hpp"
#include "apps/reports/svg_path.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

using Panel = PlotSheet::Panel;

// Of classes one after the other; after them from the first again.
constexpr std::array<const char*, 12> kClassColours = {"#dc2626",
                                                       "#f59e0b",
                                                       "#2563eb",
                                                       "#7c3aed",
                                                       "#16a34a",
                                                       "#db2777",
                                                       "#0891b2",
                                                       "#84cc16",
                                                       "#7f1d1d",
                                                       "#1e3a8a",
                                                       "#14532d",
                                                       "#a16207"};
constexpr const char* kUnknownColour = "#94a3b8";
// A dance that is never likelier than this has no line.
constexpr float kLikely = 0.1F;
// Where the band of what is shown lies below the probabilities, and the panel ends.
constexpr double kBandTop = -0.06;
constexpr double kBandBottom = -0.22;
constexpr double kPanelHeight = 150.0;
// Units that a letter of a dance's name takes in the band.
constexpr double kLetter = 7.5;

class GenrePlotter {
 public:
    GenrePlotter(const GenreTrack& track, std::size_t truth)
        : track_(track), truth_(truth), sheet_(track.seconds) {}

    std::string draw(std::string_view name) {
        sheet_.header(fmt::format("{}: {}", name, name_of(truth_)), at_end());
        bool is_first = true;
        for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
            if (track_.is_asked[voice]) {
                draw_voice(voice, is_first);
                is_first = false;
            }
        }
        return sheet_.finish();
    }

 private:
    [[nodiscard]] std::string_view name_of(std::size_t of) const {
        return of < track_.genres.size() ? std::string_view(track_.genres[of]) : "unknown";
    }
    [[nodiscard]] const char* colour_of(std::size_t of) const {
        return of < track_.genres.size() ? kClassColours[of % kClassColours.size()]
                                         : kUnknownColour;
    }

    // What is shown at last by each who was asked.
    [[nodiscard]] std::string at_end() const {
        std::string text = "at the end: ";
        bool is_first = true;
        for (std::size_t voice = 0; voice < kGenreVoiceNames.size(); ++voice) {
            if (track_.is_asked[voice] && !track_.steps.empty()) {
                const std::size_t shown = track_.steps.back().shown[voice];
                text += fmt::format("{}{} {}{}",
                                    is_first ? "" : ", ",
                                    kGenreVoiceNames[voice],
                                    name_of(shown),
                                    shown == truth_ ? "" : " (wrong)");
                is_first = false;
            }
        }
        return text;
    }

    [[nodiscard]] bool is_drawn(std::size_t of) const {
        const auto is_likely = [&](const GenreStep& step) {
            for (std::size_t voice = 0; voice < step.logs.size(); ++voice) {
                if (track_.is_asked[voice] && step.is_heard[voice] &&
                    (step.shown[voice] == of || std::exp(step.logs[voice][of]) > kLikely)) {
                    return true;
                }
            }
            return false;
        };
        return of == truth_ || std::any_of(track_.steps.begin(), track_.steps.end(), is_likely);
    }

    void draw_voice(std::size_t voice, bool has_legend) {
        const std::string_view title = kGenreVoiceNames[voice];
        std::string id(title);
        std::replace(id.begin(), id.end(), ' ', '_');
        const Panel panel =
            sheet_.begin_panel({id, title, "probability", kPanelHeight, kBandBottom, 1.0});
        for (const double value : {0.0, 0.5, 1.0}) {
            sheet_.tick(panel, value, fmt::format("{:g}", value));
        }
        if (track_.steps.empty()) {
            sheet_.note(panel, "nothing was heard");
        }
        // The legend grows to the left: the last class comes first.
        for (std::size_t of = track_.genres.size() + 1; of-- > 0;) {
            if (is_drawn(of)) {
                draw_line(panel, voice, of);
                if (has_legend) {
                    sheet_.legend(panel, colour_of(of), name_of(of));
                }
            }
        }
        draw_band(panel, voice);
        sheet_.end_panel();
    }

    void draw_line(const Panel& panel, std::size_t voice, std::size_t of) {
        SvgPath path;
        for (const GenreStep& step : track_.steps) {
            if (!step.is_heard[voice]) {
                continue;
            }
            const double chance = std::exp(static_cast<double>(step.logs[voice][of]));
            path.to(sheet_.x(step.seconds), panel.y(chance));
        }
        sheet_.raw(
            fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
                        "stroke-linejoin=\"round\"/>\n",
                        path.data(),
                        colour_of(of),
                        of == truth_ ? 3.0 : 1.5));
    }

    // One box for each stretch of the same dance, with its name where there is room.
    void draw_band(const Panel& panel, std::size_t voice) {
        const std::vector<GenreStep>& steps = track_.steps;
        for (std::size_t from = 0; from < steps.size();) {
            const std::size_t shown = steps[from].shown[voice];
            std::size_t to = from;
            while (to < steps.size() && steps[to].shown[voice] == shown) {
                ++to;
            }
            const double left = sheet_.x(steps[from].seconds);
            const double right = sheet_.x(to < steps.size() ? steps[to].seconds : track_.seconds);
            draw_box(panel, {left, right}, shown);
            from = to;
        }
    }

    void draw_box(const Panel& panel, std::pair<double, double> place, std::size_t shown) {
        const double top = panel.y(kBandTop);
        const double height = panel.y(kBandBottom) - top;
        const double width = place.second - place.first;
        sheet_.raw(
            fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" "
                        "height=\"{:.1f}\" fill=\"{}\"/>\n",
                        place.first,
                        top,
                        width,
                        height,
                        colour_of(shown)));
        const std::string_view name = name_of(shown);
        if (width > kLetter * static_cast<double>(name.size())) {
            sheet_.raw(
                fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" style=\"fill:#ffffff\" "
                            "text-anchor=\"middle\">{}</text>\n",
                            0.5 * (place.first + place.second),
                            top + 0.5 * height + 4.0,
                            name));
        }
    }

    const GenreTrack& track_;
    std::size_t truth_;
    PlotSheet sheet_;
};

}  // namespace

std::string draw_genre_plot(const GenreTrack& track, std::string_view name, std::size_t truth) {
    return GenrePlotter(track, truth).draw(name);
}

}  // namespace raks::apps
