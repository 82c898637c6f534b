#include "apps/raks_capture/capture_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "apps/reports/chart.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec3.hpp>

namespace raks::apps {
namespace {

using capture::PlaceSource;
using capture::Tracks;

constexpr const char* kBlue = "#2563eb";
constexpr const char* kRed = "#dc2626";
constexpr const char* kAmber = "#f59e0b";
constexpr const char* kGreen = "#86c79b";
constexpr const char* kSlate = "#64748b";

/// Bounds of what is drawn, widened point by point.
struct Extent {
    double low_x = std::numeric_limits<double>::infinity();
    double high_x = -std::numeric_limits<double>::infinity();
    double low_z = std::numeric_limits<double>::infinity();
    double high_z = -std::numeric_limits<double>::infinity();

    void add(const glm::dvec3& place) {
        low_x = std::min(low_x, place.x);
        high_x = std::max(high_x, place.x);
        low_z = std::min(low_z, place.z);
        high_z = std::max(high_z, place.z);
    }
};

/// The middle of the known markers at a frame; NaN: none is known.
glm::dvec3 middle_of(const Tracks& tracks, std::size_t frame) {
    glm::dvec3 sum(0.0);
    double count = 0.0;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        const capture::MarkerPlace& place = tracks.at(frame, marker);
        if (place.source != PlaceSource::lost) {
            sum += place.place;
            count += 1.0;
        }
    }
    return sum / count;
}

/// A round number of frames between drawn ones, so that a chart has at most some hundred points.
std::size_t drawn_step(std::size_t frames, std::size_t most) {
    return std::max<std::size_t>(1, (frames + most - 1) / most);
}

/// Where a ray through the side of a picture ends on the plan, `length` metres from the camera.
glm::dvec3 side_of_view(const capture::Camera& camera, double u, double length) {
    const glm::dvec2 direction = capture::direction_of(camera.lens, {u, camera.lens.cy});
    const glm::dvec3 ray =
        glm::transpose(camera.rotation) * glm::dvec3(direction.x, direction.y, 1.0);
    const glm::dvec3 flat(ray.x, 0.0, ray.z);
    const double size = glm::length(flat);
    return camera.centre() + (size > 1e-9 ? flat * (length / size) : flat);
}

Extent extent_of(const capture::Rig& rig, const Tracks* tracks) {
    Extent extent;
    for (const capture::Camera& camera : rig.cameras) {
        extent.add(camera.centre());
    }
    if (tracks != nullptr) {
        for (const capture::MarkerPlace& place : tracks->places) {
            if (place.source != PlaceSource::lost) {
                extent.add(place.place);
            }
        }
    }
    return extent;
}

/// Equal scales on both axes, with some room around.
Chart room_chart(const Extent& extent) {
    constexpr double kWidth = 560.0;
    constexpr double kHeight = 520.0;
    constexpr double kMargins = 54.0;  // left and right; top and bottom take 44
    const double per_metre = std::max({(extent.high_x - extent.low_x) / (kWidth - kMargins),
                                       (extent.high_z - extent.low_z) / (kHeight - 44.0),
                                       1e-3});
    const double half_x = 0.5 * per_metre * (kWidth - kMargins) * 1.12;
    const double half_z = 0.5 * per_metre * (kHeight - 44.0) * 1.12;
    const double x = 0.5 * (extent.low_x + extent.high_x);
    const double z = 0.5 * (extent.low_z + extent.high_z);
    Chart chart({.width = kWidth,
                 .height = kHeight,
                 .x = {x - half_x, x + half_x},
                 .y = {z + half_z, z - half_z},
                 .x_label = "x, metres"});
    const double step = round_step(2.0 * half_x, 6);
    for (double at = std::ceil((x - half_x) / step); at * step <= x + half_x; at += 1.0) {
        chart.tick_x(at * step, fmt::format("{:.6g}", at == 0.0 ? 0.0 : at * step));
    }
    for (double at = std::ceil((z - half_z) / step); at * step <= z + half_z; at += 1.0) {
        chart.tick_y(at * step, fmt::format("{:.6g}", at == 0.0 ? 0.0 : at * step));
    }
    return chart;
}

void draw_footprint(const Tracks& tracks, Chart& chart) {
    const std::size_t step = drawn_step(tracks.frame_count, 300);
    std::vector<Chart::Point> path;
    for (std::size_t frame = 0; frame < tracks.frame_count; frame += step) {
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const capture::MarkerPlace& place = tracks.at(frame, marker);
            if (place.source != PlaceSource::lost) {
                chart.dot({place.place.x, place.place.z}, 1.1, "fill=\"#cbd5e1\"");
            }
        }
        const glm::dvec3 middle = middle_of(tracks, frame);
        if (std::isfinite(middle.x)) {
            path.emplace_back(middle.x, middle.z);
        }
    }
    chart.line(path, fmt::format("stroke=\"{}\" stroke-width=\"1.5\"", kBlue));
}

/// The runs of one value over the frames: calls `each(first, last)` for each run where `is` holds.
template <typename Predicate, typename Each>
void for_runs(std::size_t frames, Predicate is, Each each) {
    for (std::size_t first = 0; first < frames; ++first) {
        if (!is(first)) {
            continue;
        }
        std::size_t last = first;
        while (last + 1 < frames && is(last + 1)) {
            ++last;
        }
        each(first, last);
        first = last;
    }
}

const char* colour_of_source(PlaceSource source) {
    return source == PlaceSource::seen ? kGreen : source == PlaceSource::filled ? kAmber : kRed;
}

/// Ticks of seconds, from the first frame to the last.
void tick_seconds(double low, double high, int wanted, Chart& chart) {
    const double step = round_step(high - low, wanted);
    for (double at = std::ceil(low / step); at * step <= high; at += 1.0) {
        chart.tick_x(at * step, fmt::format("{:.6g}", at == 0.0 ? 0.0 : at * step));
    }
}

/// A line through the greatest value of each group of frames; it is broken where none is known.
/// `value(frame)` in the unit of the chart; not finite: not known.
template <typename Value>
void draw_greatest(const Tracks& tracks, Value value, std::string_view style, Chart& chart) {
    const std::size_t step = drawn_step(tracks.frame_count, 320);
    std::vector<Chart::Point> points;
    const auto end_line = [&] {
        if (!points.empty()) {
            chart.line(points, style);
        }
        points.clear();
    };
    for (std::size_t frame = 0; frame < tracks.frame_count; frame += step) {
        double greatest = -1.0;
        const std::size_t end = std::min(tracks.frame_count, frame + step);
        for (std::size_t at = frame; at < end; ++at) {
            const double here = value(at);
            greatest = std::isfinite(here) ? std::max(greatest, here) : greatest;
        }
        if (greatest < 0.0) {
            end_line();
        } else {
            points.emplace_back(tracks.time_of(frame), greatest);
        }
    }
    end_line();
}

}  // namespace

std::string draw_room(const capture::Rig& rig, const Tracks* tracks) {
    const Extent extent = extent_of(rig, tracks);
    Chart chart = room_chart(extent);
    const double length =
        0.3 * std::max(extent.high_x - extent.low_x, extent.high_z - extent.low_z);
    if (tracks != nullptr) {
        draw_footprint(*tracks, chart);
    }
    for (const capture::Camera& camera : rig.cameras) {
        const glm::dvec3 centre = camera.centre();
        const glm::dvec3 left = side_of_view(camera, 0.0, length);
        const glm::dvec3 right = side_of_view(camera, camera.lens.width, length);
        const std::array<Chart::Point, 3> wedge = {
            Chart::Point{left.x, left.z}, {centre.x, centre.z}, {right.x, right.z}};
        chart.line(wedge, fmt::format("stroke=\"{}\" stroke-width=\"1\"", kSlate));
        chart.dot({centre.x, centre.z}, 4.0, "fill=\"#0f172a\"");
        chart.mark({centre.x, centre.z}, -8.0, "#0f172a", camera.name);
    }
    return chart.svg();
}

std::string draw_visibility(const Tracks& tracks) {
    constexpr double kRow = 17.0;
    const double rows = static_cast<double>(tracks.markers.size());
    const double frame_seconds = 1.0 / tracks.frames_per_second;
    const double low = tracks.first_time;
    const double high = tracks.time_of(tracks.frame_count);
    Chart chart({.width = 1160.0,
                 .height = 44.0 + kRow * rows,
                 .x = {low, high},
                 .y = {rows, 0.0},
                 .x_label = "capture time, seconds",
                 .left = 150.0});
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        const double top = static_cast<double>(marker);
        chart.tick_y(top + 0.5, tracks.markers[marker]);
        for (const PlaceSource source :
             {PlaceSource::seen, PlaceSource::filled, PlaceSource::lost}) {
            for_runs(
                tracks.frame_count,
                [&](std::size_t frame) { return tracks.at(frame, marker).source == source; },
                [&](std::size_t first, std::size_t last) {
                    chart.box({tracks.time_of(first), top + 0.15},
                              {tracks.time_of(last) + frame_seconds, top + 0.7},
                              fmt::format("fill=\"{}\"", colour_of_source(source)));
                });
        }
    }
    for (const capture::Flag& flag : tracks.flags) {
        const double top = static_cast<double>(flag.marker);
        chart.box({tracks.time_of(flag.first), top + 0.76},
                  {tracks.time_of(flag.last) + frame_seconds, top + 0.9},
                  "fill=\"#7c3aed\"");
    }
    tick_seconds(low, high, 12, chart);
    return chart.svg();
}

std::string draw_deviation(const Tracks& tracks,
                           const std::vector<double>& errors,
                           std::size_t marker,
                           double most) {
    const double low = tracks.first_time;
    const double high = tracks.time_of(tracks.frame_count);
    Chart chart({.width = 380.0,
                 .height = 116.0,
                 .x = {low, high},
                 .y = {0.0, most},
                 .left = 40.0,
                 .bottom = 18.0,
                 .top = 4.0});
    chart.grid_y(3);
    tick_seconds(low, high, 5, chart);
    const auto millimetres = [most](double metres) {
        return std::isfinite(metres) ? std::min(1000.0 * metres, most) : metres;
    };
    if (!errors.empty()) {
        draw_greatest(
            tracks,
            [&](std::size_t frame) {
                return millimetres(errors[frame * tracks.markers.size() + marker]);
            },
            fmt::format("stroke=\"{}\" stroke-width=\"1.2\"", kRed),
            chart);
    }
    draw_greatest(
        tracks,
        [&](std::size_t frame) {
            const capture::MarkerPlace& place = tracks.at(frame, marker);
            return place.source == PlaceSource::lost ? std::numeric_limits<double>::infinity()
                                                     : millimetres(place.deviation);
        },
        fmt::format("stroke=\"{}\" stroke-width=\"1.4\"", kBlue),
        chart);
    return chart.svg();
}

std::string draw_strip(const std::vector<StickPicture>& pictures) {
    constexpr double kStep = 1.3;     // metres from one figure to the next
    constexpr double kHighest = 2.2;  // metres
    constexpr double kWidth = 1160.0;
    const double span = kStep * static_cast<double>(pictures.size());
    // Equal scales: the height follows from the width; 24 pixels for the times below.
    Chart chart({.width = kWidth,
                 .height = 24.0 + (kHighest + 0.1) * kWidth / span,
                 .x = {-0.5 * kStep, span - 0.5 * kStep},
                 .y = {-0.1, kHighest},
                 .left = 0.0,
                 .bottom = 20.0,
                 .top = 4.0,
                 .right = 0.0});
    const std::array<Chart::Point, 2> floor = {Chart::Point{-0.5 * kStep, 0.0},
                                               {span - 0.5 * kStep, 0.0}};
    chart.line(floor, "stroke=\"#cbd5e1\" stroke-width=\"1\"");
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const double shift = kStep * static_cast<double>(i);
        for (const StickLine& line : pictures[i].lines) {
            const std::array<Chart::Point, 2> ends = {
                Chart::Point{shift + line.from_x, line.from_y}, {shift + line.to_x, line.to_y}};
            chart.line(ends, "stroke=\"#0f172a\" stroke-width=\"2\" stroke-linecap=\"round\"");
        }
        chart.tick_x(shift, fmt::format("{:.1f} s", pictures[i].time));
    }
    return chart.svg();
}

}  // namespace raks::apps
