#include "apps/reports/repeat_page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "apps/reports/body_lines.hpp"
#include "apps/reports/chart.hpp"
#include "apps/reports/web_page.hpp"
#include "motion/figures/foot_events.hpp"
#include "motion/figures/motion_features.hpp"
#include "training/discovery/repeat_likeness.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr std::size_t kMostStrips = 60;  // of one clip
constexpr double kWidth = 1190.0;        // of the page's charts, pixels
constexpr double kLeft = 46.0;           // their left margin
constexpr double kRight = 8.0;           // and the right one
constexpr double kFastest = 3.0;         // m/s, the top of the charts of the feet
constexpr double kLowPass = 8.0;         // Hz, of the feet's speed

/// Both feet's speed, by side and frame, m/s.
using FeetSpeeds = std::array<std::vector<double>, 2>;

FeetSpeeds feet_of(const motion::TrainingClip& clip) {
    FeetSpeeds speeds;
    for (const motion::Side side : motion::kSides) {
        speeds[static_cast<std::size_t>(side)] =
            motion::foot_speed(clip.feet, side, clip.frames_per_second, kLowPass);
    }
    return speeds;
}

std::string_view colour_of(const motion::FoundRepeat& repeat) {
    return repeat.is_good ? "#16a34a" : "#dc2626";
}

std::string_view fate_of(const motion::FoundRepeat& repeat) {
    if (repeat.is_good) {
        return "learnt";
    }
    return repeat.distance < motion::kAlikeDistance ? "turns otherwise, left out"
                                                    : "an outlier, left out";
}

/// Lines of both feet's speed from one frame to another; x runs from 0 to `span`.
void draw_feet(const FeetSpeeds& speeds, double from, double to, double span, Chart& chart) {
    for (const std::size_t side : {std::size_t{0}, std::size_t{1}}) {
        std::vector<Chart::Point> points;
        const auto last = std::min(static_cast<std::size_t>(to), speeds[side].size() - 1);
        // About a point a pixel.
        const std::size_t step = std::max<std::size_t>(
            1, (last - static_cast<std::size_t>(from)) / static_cast<std::size_t>(kWidth));
        for (auto i = static_cast<std::size_t>(from); i <= last; i += step) {
            points.emplace_back((static_cast<double>(i) - from) / (to - from) * span,
                                std::min(speeds[side][i], kFastest));
        }
        chart.line(points,
                   fmt::format("stroke=\"{}\" stroke-width=\"1.4\"",
                               side == 0 ? kLeftColour : kRightColour));
    }
}

/// The clip over time, with a box for each repeat.
std::string timeline(const motion::DiscoveredClip& clip, const FeetSpeeds& speeds) {
    const double rate = clip.clip.frames_per_second;
    const double frames = static_cast<double>(clip.clip.poses.size() - 1);
    Chart chart({.width = kWidth,
                 .height = 130.0,
                 .x = {0.0, frames / rate},
                 .y = {0.0, kFastest},
                 .x_label = "seconds"});
    std::size_t number = 1;
    for (const motion::FoundRepeat& repeat : clip.found.repeats) {
        chart.box(
            {repeat.start / rate, 0.0},
            {repeat.end / rate, kFastest},
            fmt::format("fill=\"{0}\" fill-opacity=\"0.12\" stroke=\"{0}\"", colour_of(repeat)));
        chart.mark({(repeat.start + repeat.end) / 2.0 / rate, kFastest},
                   12.0,
                   colour_of(repeat),
                   std::to_string(number++));
    }
    draw_feet(speeds, 0.0, frames, frames / rate, chart);
    for (double second = 0.0; second <= frames / rate; second += round_step(frames / rate, 12)) {
        chart.tick_x(second, fmt::format("{:g}", second));
    }
    chart.tick_y(0.0, "0");
    chart.tick_y(kFastest, "3 m/s");
    return chart.svg();
}

/// A repeat's bodies, on every beat, or on every half beat where there is room.
std::string bodies(const motion::TrainingClip& clip, const motion::FoundRepeat& repeat, int beats) {
    const int parts = beats <= 12 ? 2 * beats : std::min(beats, 24);
    const auto first = std::min(static_cast<std::size_t>(repeat.start), clip.poses.size() - 1);
    const double heading = motion::heading_of(glm::dquat(clip.poses[first].rotation(Bone::hips)));
    std::string drawn = fmt::format(
        "<svg width=\"{}\" height=\"{:.0f}\"><g fill=\"none\" stroke-width=\"2\" "
        "stroke-linecap=\"round\">\n",
        kWidth,
        kBodyPixels + 4.0);
    for (int part = 0; part <= parts; ++part) {
        const double share = static_cast<double>(part) / parts;
        const motion::Pose pose =
            motion::pose_between(clip.poses, repeat.start + share * (repeat.end - repeat.start));
        const double x = kLeft + share * (kWidth - kLeft - kRight);
        // The ends stay within the picture.
        drawn += body_lines(pose, heading, std::clamp(x, kLeft, kWidth - 24.0), kBodyPixels);
    }
    return drawn + "</g></svg>\n";
}

std::string strip(const motion::DiscoveredClip& clip, const FeetSpeeds& speeds, std::size_t index) {
    const motion::FoundRepeat& repeat = clip.found.repeats[index];
    const int beats = clip.found.beats;
    Chart chart({.width = kWidth,
                 .height = 84.0,
                 .x = {0.0, static_cast<double>(beats)},
                 .y = {0.0, kFastest},
                 .bottom = 20.0,
                 .top = 4.0});
    draw_feet(speeds, repeat.start, repeat.end, static_cast<double>(beats), chart);
    for (int beat = 0; beat < beats; ++beat) {
        chart.tick_x(static_cast<double>(beat), std::to_string(beat + 1));
    }
    return fmt::format(
        "<h3 style=\"color:{}\">{}: {:.2f} to {:.2f} s, frames {:.0f} to {:.0f}, distance {:.2f}: "
        "{}</h3>\n{}{}",
        colour_of(repeat),
        index + 1,
        repeat.start / clip.clip.frames_per_second,
        repeat.end / clip.clip.frames_per_second,
        repeat.start,
        repeat.end,
        repeat.distance,
        fate_of(repeat),
        bodies(clip.clip, repeat, beats),
        chart.svg());
}

std::string section(const motion::DiscoveredClip& clip) {
    const motion::FoundRepeats& found = clip.found;
    std::string body = fmt::format("<h2>{}</h2>\n", xml_text(clip.take));
    if (found.repeats.empty()) {
        return body + fmt::format("<p>{}</p>\n", xml_text(found.none_because));
    }
    body += fmt::format(
        "<p>{} of {} repeats of {} beats are alike; {:.2f} s each, {:.0f} BPM. The period "
        "explains {:.0f} % of how feet and hands move.</p>\n",
        found.good(),
        found.repeats.size(),
        found.beats,
        found.seconds,
        found.tempo(),
        100.0 * found.explained);
    const FeetSpeeds speeds = feet_of(clip.clip);
    body += timeline(clip, speeds);
    const std::size_t shown = std::min(found.repeats.size(), kMostStrips);
    for (std::size_t i = 0; i < shown; ++i) {
        body += strip(clip, speeds, i);
    }
    if (shown < found.repeats.size()) {
        body += fmt::format("<p>{} more are not drawn.</p>\n", found.repeats.size() - shown);
    }
    return body;
}

}  // namespace

std::string draw_repeats(const motion::DiscoveredClips& found, const std::string& figure) {
    std::string body = fmt::format(
        "<p class=\"sub\">Repeats found in motion that nobody labelled: what would be learnt as "
        "{0}. Blue: the left, orange: the right foot, arm and leg; speed of the feet. Green "
        "repeats are alike and are learnt, red ones are not. Distance: 0 is the same motion, 1 as "
        "far as two random moments. Change a row of the table, and give it with --labels, to keep, "
        "drop or move one.</p>\n",
        xml_text(figure));
    for (const motion::DiscoveredClip& clip : found.clips) {
        body += section(clip);
    }
    return web_page("Repeats found", body);
}

}  // namespace raks::apps
