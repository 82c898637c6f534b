#include "apps/raks_capture/capture_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/raks_capture/capture_charts.hpp"
#include "apps/reports/web_page.hpp"
#include "base/statistics.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using capture::PlaceSource;

constexpr double kFarOff = 0.1;  // metres: a place that is wrong

/// How one marker, or all of them, was followed.
struct MarkerSums {
    std::size_t frames = 0;
    std::size_t filled = 0;
    std::size_t lost = 0;
    std::size_t views = 0;
    std::vector<double> deviations;  ///< of the places that are known
    std::vector<double> near;        ///< errors up to kFarOff
    std::size_t wrong = 0;
    std::size_t compared = 0;  ///< with the truth

    [[nodiscard]] double percent(std::size_t count) const {
        return frames > 0 ? 100.0 * static_cast<double>(count) / static_cast<double>(frames) : 0.0;
    }
};

double mean_of(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double median_of(std::vector<double> values) {
    return values.empty() ? 0.0 : upper_median(std::move(values));
}

void add_marker(const CaptureReport& report, std::size_t marker, MarkerSums& sums) {
    const capture::Tracks& tracks = *report.tracks;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        const capture::MarkerPlace& place = tracks.at(frame, marker);
        ++sums.frames;
        sums.views += place.views;
        sums.filled += place.source == PlaceSource::filled ? 1U : 0U;
        if (place.source == PlaceSource::lost) {
            ++sums.lost;
        } else {
            sums.deviations.push_back(place.deviation);
        }
        if (report.errors.empty()) {
            continue;
        }
        const double error = report.errors[frame * tracks.markers.size() + marker];
        if (std::isnan(error)) {
            continue;
        }
        ++sums.compared;
        if (error <= kFarOff) {
            sums.near.push_back(error);
        } else {
            ++sums.wrong;
        }
    }
}

std::string row_of(const std::vector<std::string>& cells, const char* cell) {
    std::string row = "<tr>";
    for (const std::string& text : cells) {
        row += fmt::format("<{0}>{1}</{0}>", cell, text);
    }
    return row + "</tr>\n";
}

/// A table from its head; add rows by row_of(..., "td") and end it with end_table().
std::string begin_table(const std::vector<std::string>& head) {
    return "<table><thead>" + row_of(head, "th") + "</thead><tbody>\n";
}

std::string end_table() { return "</tbody></table>\n"; }

// What came of it, in a sentence or two.
std::string overview_section(const CaptureReport& report) {
    if (!report.tracks) {
        return "<p>The markers are not followed yet: <code>raks capture track</code>.</p>\n";
    }
    const capture::Tracks& tracks = *report.tracks;
    MarkerSums sums;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        add_marker(report, marker, sums);
    }
    std::string text = fmt::format(
        "<p>{} markers over {:.1f} s ({} frames, {:.6g} a second). {:.1f} % of the places are "
        "seen by two cameras or more, {:.1f} % are filled, {:.1f} % are lost; {} stretches are to "
        "be looked at. The place of a marker is known to {:.1f} mm (median of the deviation "
        "along the worst axis)",
        tracks.markers.size(),
        static_cast<double>(tracks.frame_count) / tracks.frames_per_second,
        tracks.frame_count,
        tracks.frames_per_second,
        sums.percent(sums.frames - sums.filled - sums.lost),
        sums.percent(sums.filled),
        sums.percent(sums.lost),
        tracks.flags.size(),
        1000.0 * median_of(sums.deviations));
    if (sums.compared > 0) {
        text += fmt::format(
            "; it is {:.1f} mm from the truth on average, and {:.2f} % of the places are "
            "more than 100 mm off or lost",
            1000.0 * mean_of(sums.near),
            100.0 * static_cast<double>(sums.wrong) / static_cast<double>(sums.compared));
    }
    text += ".</p>\n";
    for (const capture::CameraMove& move : report.moves) {
        text += "<p class=\"wrong\">" + xml_text(capture::words_of_move(move, tracks)) + "</p>\n";
    }
    return text;
}

std::string room_section(const CaptureReport& report) {
    if (!report.rig) {
        return {};
    }
    std::string section =
        "<h2>The room</h2>\n<p>From above. Cameras with the sides of their pictures; where the "
        "markers were (grey) and the middle of the dancer (blue).</p>\n<div class=\"tables\">\n" +
        draw_room(*report.rig, report.tracks ? &*report.tracks : nullptr) +
        begin_table({"camera", "picture", "focal length, px", "x, m", "height, m", "z, m"});
    for (const capture::Camera& camera : report.rig->cameras) {
        const glm::dvec3 centre = camera.centre();
        section += row_of({xml_text(camera.name),
                           fmt::format("{} x {}", camera.lens.width, camera.lens.height),
                           fmt::format("{:.0f}", camera.lens.fx),
                           fmt::format("{:.2f}", centre.x),
                           fmt::format("{:.2f}", centre.y),
                           fmt::format("{:.2f}", centre.z)},
                          "td");
    }
    section += end_table() + "</div>\n";
    for (const std::string& doubt : capture::rig_doubts(*report.rig)) {
        section += "<p class=\"wrong\">" + xml_text(doubt) + "</p>\n";
    }
    return section;
}

std::string clocks_section(const CaptureReport& report) {
    if (report.clocks.empty()) {
        return {};
    }
    std::string section =
        "<h2>The clocks</h2>\n<p>When each camera began by the capture's clock, how much faster "
        "or slower it runs (parts in a million), and how sure that is (1: known).</p>\n" +
        begin_table({"camera", "began at, s", "drift, ppm", "confidence"});
    for (const capture::Clock& clock : report.clocks) {
        section += row_of({xml_text(clock.camera),
                           fmt::format("{:.4f}", clock.offset),
                           fmt::format("{:.1f}", clock.drift_ppm),
                           fmt::format("{:.2f}", clock.confidence)},
                          "td");
    }
    return section + end_table();
}

std::string colour_of_marker(const CaptureReport& report, const std::string& name) {
    const auto index = report.markers ? report.markers->index_of(name) : std::nullopt;
    return index ? xml_text(report.markers->markers[*index].colour) : "";
}

std::string markers_table(const CaptureReport& report) {
    const capture::Tracks& tracks = *report.tracks;
    const bool has_truth = !report.errors.empty();
    std::vector<std::string> head = {
        "marker", "colour", "views", "filled, %", "lost, %", "deviation, mm", "flags"};
    if (has_truth) {
        head.insert(head.end(), {"off, mm", "over 100 mm, %"});
    }
    std::string table = begin_table(head);
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        MarkerSums sums;
        add_marker(report, marker, sums);
        const auto flags =
            std::count_if(tracks.flags.begin(), tracks.flags.end(), [marker](const auto& flag) {
                return flag.marker == marker;
            });
        std::vector<std::string> cells = {
            xml_text(tracks.markers[marker]),
            colour_of_marker(report, tracks.markers[marker]),
            fmt::format("{:.1f}",
                        static_cast<double>(sums.views) /
                            static_cast<double>(std::max<std::size_t>(1, sums.frames))),
            fmt::format("{:.1f}", sums.percent(sums.filled)),
            fmt::format("{:.1f}", sums.percent(sums.lost)),
            fmt::format("{:.1f}", 1000.0 * median_of(sums.deviations)),
            std::to_string(flags)};
        if (has_truth) {
            cells.push_back(fmt::format("{:.1f}", 1000.0 * mean_of(sums.near)));
            cells.push_back(
                fmt::format("{:.2f}",
                            100.0 * static_cast<double>(sums.wrong) /
                                static_cast<double>(std::max<std::size_t>(1, sums.compared))));
        }
        table += row_of(cells, "td");
    }
    return table + end_table();
}

std::string curves_section(const CaptureReport& report) {
    const capture::Tracks& tracks = *report.tracks;
    constexpr double kMost = 60.0;  // millimetres
    std::string section = fmt::format(
        "<h3>How well each place is known</h3>\n<p>Blue: the standard deviation along the worst "
        "axis, by the tracker, up to {:.0f} mm; it grows where few cameras see the marker, and "
        "is missing where it is lost.{}</p>\n<div class=\"three\">\n",
        kMost,
        report.errors.empty() ? "" : " Red: the distance from the truth.");
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        section += fmt::format("<div><div class=\"over\">{}</div>{}</div>\n",
                               xml_text(tracks.markers[marker]),
                               draw_deviation(tracks, report.errors, marker, kMost));
    }
    return section + "</div>\n";
}

std::string markers_section(const CaptureReport& report) {
    if (!report.tracks || report.tracks->frame_count == 0) {
        return {};
    }
    return "<h2>The markers</h2>\n<p>Green: seen by two cameras or more. Amber: filled from the "
           "moments around. Red: lost. Violet, below: to be looked at.</p>\n" +
           draw_visibility(*report.tracks) + markers_table(report) + curves_section(report);
}

std::string joints_section(const CaptureReport& report) {
    if (report.joints.empty()) {
        return {};
    }
    constexpr double kDegrees = 180.0 / M_PI;
    std::string section =
        "<h2>How sure the angles are</h2>\n<p>Standard deviation of each joint by the spread of "
        "the particles, where the body is not lost: of the axis that is least sure.</p>\n" +
        begin_table({"joint", "degrees, median", "19 of 20 below", "over 20 degrees, %"});
    for (const capture::JointSureness& joint : report.joints) {
        section += row_of({xml_text(joint.joint),
                           fmt::format("{:.1f}", kDegrees * joint.median),
                           fmt::format("{:.1f}", kDegrees * joint.high),
                           fmt::format("{:.1f}", 100.0 * joint.unsure)},
                          "td");
    }
    return section + end_table();
}

std::string flags_section(const CaptureReport& report) {
    if (!report.tracks || report.tracks->flags.empty()) {
        return {};
    }
    constexpr std::size_t kMostRows = 200;
    const capture::Tracks& tracks = *report.tracks;
    std::string section =
        "<h2>To be looked at</h2>\n<p>Lost: fewer than two cameras see it. Filled: over more than "
        "0.2 s. Length: too far from, or too near to a marker of the same bone. Exchanged: it may "
        "be another marker. Residual: its cameras do not agree. Unsure: the angle of its joint is "
        "known to 20 degrees at best. Jumped: one camera has it far from where the others and the "
        "moments around have it. Person: one camera follows somebody else. <code>raks capture "
        "correct</code> and <code>edits.jsonl</code> put them right.</p>\n" +
        begin_table({"marker", "doubt", "camera", "from, s", "to, s", "frames"});
    for (std::size_t i = 0; i < std::min(kMostRows, tracks.flags.size()); ++i) {
        const capture::Flag& flag = tracks.flags[i];
        section += row_of({xml_text(tracks.markers[flag.marker]),
                           std::string(capture::kDoubtNames[static_cast<std::size_t>(flag.doubt)]),
                           xml_text(flag.camera),
                           fmt::format("{:.2f}", tracks.time_of(flag.first)),
                           fmt::format("{:.2f}", tracks.time_of(flag.last)),
                           fmt::format("{} to {}", flag.first, flag.last)},
                          "td");
    }
    section += end_table();
    if (tracks.flags.size() > kMostRows) {
        section += fmt::format("<p class=\"sub\">and {} more, in flags.tsv</p>\n",
                               tracks.flags.size() - kMostRows);
    }
    return section;
}

std::string words_of_edit(const capture::Edit& edit) {
    const std::string in_camera = '"' + xml_text(edit.camera) + '"';
    switch (edit.kind) {
        case capture::EditKind::set:
            return fmt::format(
                "set in {} at ({:.1f}, {:.1f})", in_camera, edit.pixel.x, edit.pixel.y);
        case capture::EditKind::hide:
            return edit.camera.empty()   ? "its spots are not believed"
                   : edit.marker.empty() ? "nothing that " + in_camera + " sees counts"
                                         : "not believed in " + in_camera;
        case capture::EditKind::swap:
            return "exchanged with " + xml_text(edit.other) + " from here on";
        case capture::EditKind::fill:
            return "filled from the frames around";
        case capture::EditKind::exchange:
            return fmt::format("left and right {}exchanged in {}",
                               edit.limbs.empty() ? "" : "of the " + edit.limbs + " ",
                               in_camera);
    }
    return {};
}

std::string edits_section(const CaptureReport& report) {
    if (report.edits.empty()) {
        return {};
    }
    std::string section =
        "<h2>Corrected by hand</h2>\n" + begin_table({"marker", "frames", "what"});
    for (const capture::Edit& edit : report.edits) {
        section += row_of({xml_text(edit.marker),
                           edit.last > edit.first ? fmt::format("{} to {}", edit.first, edit.last)
                                                  : std::to_string(edit.first),
                           words_of_edit(edit)},
                          "td");
    }
    return section + end_table();
}

std::string foot_row(const char* name, const FootFacts& foot) {
    return row_of({name,
                   fmt::format("{:.0f}", 100.0 * foot.planted),
                   fmt::format("{:.3f}", foot.median),
                   fmt::format("{:.3f}", foot.ninety),
                   fmt::format("{:.1f}", 100.0 * foot.lowest)},
                  "td");
}

std::string body_section(const CaptureReport& report) {
    if (!report.body) {
        return {};
    }
    const BodyFacts& body = *report.body;
    std::string section =
        fmt::format("<h2>The dance</h2>\n<p>dance.bvh, {:.1f} s, seen along z.</p>\n",
                    body.seconds) +
        draw_strip(body.strip) + "<div class=\"tables\">\n" +
        begin_table({"bone", "left, cm", "right, cm"});
    for (const BoneLength& bone : body.lengths) {
        section += row_of({bone.name,
                           fmt::format("{:.1f}", 100.0 * bone.left),
                           fmt::format("{:.1f}", 100.0 * bone.right)},
                          "td");
    }
    section += end_table() +
               begin_table(
                   {"foot", "planted, %", "speed, m/s", "9 of 10 below, m/s", "lowest point, cm"}) +
               foot_row("left", body.left) + foot_row("right", body.right) + end_table();
    return section +
           "</div>\n<p class=\"sub\">A foot counts as planted where its ball is within 2 cm of its "
           "usual lowest place, also where it glides there. Half of the time it should be below "
           "0.1 m/s over the floor.</p>\n";
}

std::string film_section(const CaptureReport& report) {
    if (report.film.empty()) {
        return {};
    }
    const std::string film = xml_text(report.film);
    return fmt::format(
        "<h2>Side by side</h2>\n<p><a href=\"{0}\">{0}</a>, which is not part of this page.</p>\n"
        "<video controls loop style=\"max-width: 100%\" src=\"{0}\"></video>\n",
        film);
}

}  // namespace

std::string capture_page(const CaptureReport& report) {
    return web_page("Capture " + report.name,
                    overview_section(report) + room_section(report) + clocks_section(report) +
                        markers_section(report) + joints_section(report) + flags_section(report) +
                        edits_section(report) + body_section(report) + film_section(report));
}

}  // namespace raks::apps
