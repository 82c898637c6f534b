#include "apps/reports/grid_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "apps/reports/body_lines.hpp"
#include "apps/reports/chart.hpp"
#include "apps/reports/web_page.hpp"
#include "motion/figures/motion_features.hpp"

namespace raks::apps {
namespace {

constexpr double kWide = 1190.0;  // of the page's charts, pixels
constexpr double kFeetTop = 3.0;  // m/s, the top of the chart of the feet
constexpr std::size_t kRowBeats = 8;
constexpr std::size_t kMostRows = 60;
constexpr double kLineHeight = 16.0;  // below bodies
constexpr std::string_view kFirstBeat = "#d97706";
constexpr std::string_view kSecondBeat = "#64748b";
constexpr std::string_view kUnused = "#cbd5e1";

std::string_view beat_colour(const motion::GridBeat& beat) {
    return !beat.is_used ? kUnused : beat.half == 1 ? kFirstBeat : kSecondBeat;
}

// The take over time: the faster foot's speed, landings, beats, what repeats.
std::string take_timeline(const ProposedTake& take) {
    const double seconds = std::max(take.cues.seconds(), 0.1);
    Chart chart({.width = kWide,
                 .height = 130.0,
                 .x = {0.0, seconds},
                 .y = {0.0, kFeetTop},
                 .x_label = "seconds"});
    const auto& beats = take.proposal.grid.beats;
    for (std::size_t i = 0; i < beats.size(); ++i) {
        const double width = beats[i].half == 1 ? 0.04 : 0.02;
        chart.box({beats[i].time, 0.0},
                  {beats[i].time + width, kFeetTop},
                  fmt::format("fill=\"{}\"", beat_colour(beats[i])));
    }
    for (const motion::FoundLag& lag : take.proposal.lags) {
        chart.box({lag.start, kFeetTop - 0.25},
                  {lag.end, kFeetTop - 0.05},
                  "fill=\"#16a34a\" fill-opacity=\"0.35\" stroke=\"#16a34a\"");
    }
    std::vector<Chart::Point> points;
    const std::size_t step =
        std::max<std::size_t>(1, take.cues.rows() / static_cast<std::size_t>(kWide));
    for (std::size_t row = 0; row < take.cues.rows(); row += step) {
        points.emplace_back(static_cast<double>(row) / motion::kCueRate,
                            std::min(take.cues.feet_speed[row], kFeetTop));
    }
    chart.line(points, "stroke=\"#334155\" stroke-width=\"1\"");
    for (const motion::CueLanding& landing : take.cues.landings) {
        chart.dot({landing.time, 0.15},
                  2.5,
                  fmt::format("fill=\"{}\"",
                              landing.side == motion::Side::left ? kLeftColour : kRightColour));
    }
    for (double second = 0.0; second <= seconds; second += round_step(seconds, 12)) {
        chart.tick_x(second, fmt::format("{:g}", second));
    }
    chart.tick_y(0.0, "0");
    chart.tick_y(kFeetTop, "3 m/s");
    return chart.svg();
}

// The body at a moment, with a line below it.
std::string body_of(const ProposedTake& take,
                    double time,
                    double heading,
                    double x,
                    std::string_view colour,
                    std::string_view line) {
    const motion::Pose pose =
        motion::pose_between(take.clip.poses, time * take.clip.frames_per_second);
    return body_lines(pose, heading, x, kBodyPixels) +
           fmt::format(
               "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"11\" text-anchor=\"middle\" "
               "stroke=\"none\" fill=\"{}\">{}</text>\n",
               x,
               kBodyPixels + kLineHeight - 4.0,
               colour,
               line);
}

// Eight beats from one on, with what lies half way to the next.
std::string beat_row(const ProposedTake& take, std::size_t first, double heading) {
    const auto& beats = take.proposal.grid.beats;
    const std::size_t last = std::min(first + kRowBeats, beats.size());
    const double step = kWide / (2.0 * static_cast<double>(kRowBeats));
    std::string drawn = fmt::format(
        "<svg width=\"{}\" height=\"{:.0f}\"><g fill=\"none\" stroke-width=\"2\" "
        "stroke-linecap=\"round\">\n",
        kWide,
        kBodyPixels + kLineHeight);
    for (std::size_t i = first; i < last; ++i) {
        const double x = step * (2.0 * static_cast<double>(i - first) + 0.5);
        const bool is_faint = !beats[i].is_used;
        drawn += is_faint ? "<g opacity=\"0.35\">\n" : "<g>\n";
        drawn += body_of(take,
                         beats[i].time,
                         heading,
                         x,
                         beat_colour(beats[i]),
                         fmt::format("{} \u00b7 {:.2f}", i + 1, beats[i].time));
        if (i + 1 < beats.size()) {
            const double half = 0.5 * (beats[i].time + beats[i + 1].time);
            drawn += body_of(take, half, heading, x + step, kUnused, "&amp;");
        }
        drawn += "</g>\n";
    }
    return drawn + "</g></svg>\n";
}

// The direction in which the hips look on the whole.
double heading_of_take(const motion::TrainingClip& clip) {
    double sine = 0.0;
    double cosine = 0.0;
    for (const motion::Pose& pose : clip.poses) {
        const double heading = motion::heading_of(glm::dquat(pose.rotation(motion::Bone::hips)));
        sine += std::sin(heading);
        cosine += std::cos(heading);
    }
    return std::atan2(sine, cosine);
}

}  // namespace

std::string draw_grid(const ProposedTake& take) {
    const auto& beats = take.proposal.grid.beats;
    std::string body = fmt::format("<h2>{}</h2>\n", xml_text(take.proposal.grid.take));
    if (beats.empty()) {
        return body +
               "<p>Hardly anything moves, or it is shorter than two seconds: no beats.</p>\n";
    }
    const auto used = std::count_if(
        beats.begin(), beats.end(), [](const motion::GridBeat& beat) { return beat.is_used; });
    body += fmt::format(
        "<p>{} beats, {} of them used; {:.0f} BPM on the median; {:.1f} of {:.1f} s "
        "idle. {}</p>\n",
        beats.size(),
        used,
        take.proposal.tempo(),
        take.proposal.idle_seconds,
        take.cues.seconds(),
        xml_text(take.song));
    body += take_timeline(take);
    const double heading = heading_of_take(take.clip);
    std::size_t first = 0;
    for (std::size_t row = 0; row < kMostRows && first < beats.size(); ++row) {
        body += beat_row(take, first, heading);
        first += kRowBeats;
    }
    if (first < beats.size()) {
        body += fmt::format("<p>{} more beats are not drawn.</p>\n", beats.size() - first);
    }
    return body;
}

std::string grid_page(std::string_view parts) {
    std::string body =
        "<p class=\"sub\">Beats proposed for takes that nobody labelled. <b>From motion alone they "
        "are right in about half of the cases</b>: most errors are tempi of 3:4 and 2:3, and the 1 "
        "is a guess. Look whether landings, stops and turns come on beats, and set the table "
        "right: "
        "raks stick CLIP --counts X.tsv --edit. Amber beats: the 1 of half a bar; grey: the other; "
        "pale: not used. Line: speed of the faster foot; dots: landings, blue the left, orange the "
        "right foot; green: what comes again.</p>\n";
    body += parts;
    return web_page("Beats proposed", body);
}

}  // namespace raks::apps
