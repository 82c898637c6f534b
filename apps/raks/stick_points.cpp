#include "apps/raks/stick_points.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "motion/skeleton/points/guessed_edges.hpp"
#include "motion/skeleton/points/point_edges.hpp"
#include "render/scene/point_body.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

constexpr std::size_t kLargestEdges = std::size_t{1} << 20U;  // bytes of an edges file
constexpr std::size_t kMostNamed = 5;                         // unknown points that get a line

// What of points is as given, as the file says, or else guessed, with a line that says so.
render::PointFrame frame_of(const StickArguments& arguments,
                            const std::string& name,
                            const motion::PointClip& clip) {
    auto guess = render::guess_point_frame(clip);
    const motion::BodyOptions given = arguments.body.options();
    if (given.metres_per_unit) {
        guess.frame.metres_per_unit = *given.metres_per_unit;
        guess.is_unit_guessed = false;
    }
    if (given.up) {
        guess.frame.up = *given.up;
        guess.is_up_guessed = false;
    }
    if (guess.is_unit_guessed) {
        say(fmt::format(
            "{}: one unit is taken for {:.4g} m, by the points' height (--scale sets it)",
            name,
            guess.frame.metres_per_unit));
    }
    if (guess.is_up_guessed) {
        say(fmt::format("{}: {} is taken for up, as the points reach further along it",
                        name,
                        guess.frame.up.z > 0.5 ? "z" : "y"));
    }
    return guess.frame;
}

// The first few unknown points by name, with what may be meant; the rest as a number.
void say_unknown(const std::string& where,
                 const motion::FoundEdges& found,
                 std::span<const std::string> points) {
    const std::vector<std::string_view> known(points.begin(), points.end());
    for (std::size_t i = 0; i < std::min(found.unknown.size(), kMostNamed); ++i) {
        say(where + ": " + unknown_name("point", printable(found.unknown[i], 60), known));
    }
    if (found.unknown.size() > kMostNamed) {
        say(fmt::format(
            "{}: {} more points are unknown", where, found.unknown.size() - kMostNamed));
    }
    say(fmt::format("{}: {} of {} edges are left out",
                    where,
                    found.left_out,
                    found.left_out + found.edges.size()));
}

// Those of a file, in which single lines may name what is not there.
Expected<std::vector<motion::PointEdge>> edges_of_file(const Path& path,
                                                       std::span<const std::string> points,
                                                       bool& is_partly) {
    const auto text = read_text_file(path, kLargestEdges);
    if (!text) {
        return fail(text.error());
    }
    const auto named = motion::parse_edges(*text, path.string());
    if (!named) {
        return fail(named.error());
    }
    auto found = motion::find_edges(*named, points);
    if (found.left_out > 0) {
        say_unknown(path.string(), found, points);
        is_partly = true;
    }
    return std::move(found.edges);
}

Expected<std::vector<motion::PointEdge>> edges_of(const StickArguments& arguments,
                                                  const std::string& name,
                                                  const motion::PointClip& clip,
                                                  bool& is_partly) {
    if (arguments.edges.empty()) {
        return std::vector<motion::PointEdge>();
    }
    if (arguments.edges == "auto") {
        auto edges = motion::guess_edges(clip);
        say(fmt::format(
            "{}: {} edges guessed, of points that keep their distance", name, edges.size()));
        return edges;
    }
    const auto sets = motion::known_edge_sets();
    if (std::find(sets.begin(), sets.end(), arguments.edges) == sets.end()) {
        return edges_of_file(arguments.edges, clip.names, is_partly);
    }
    auto found = motion::find_set_edges(arguments.edges, clip.names);
    if (found.edges.empty()) {
        return fail(fmt::format("{}: has no points of the set {}; its points: {}",
                                name,
                                arguments.edges,
                                printable(fmt::format("{}", fmt::join(clip.names, ", ")), 200)));
    }
    return std::move(found.edges);
}

}  // namespace

Expected<JoinedPoints> join_points(const StickArguments& arguments,
                                   const std::string& name,
                                   motion::PointClip clip) {
    JoinedPoints joined;
    auto edges = edges_of(arguments, name, clip, joined.is_partly);
    if (!edges) {
        return fail(std::move(edges.error()));
    }
    const render::PointFrame frame = frame_of(arguments, name, clip);
    joined.points =
        motion::world_points(std::move(clip), frame.metres_per_unit, frame.up, std::move(*edges));
    return joined;
}

std::string points_document(const std::string& name, const motion::WorldPoints& points) {
    const motion::PointClip& clip = points.clip;
    Json list = Json::array();
    for (std::size_t point = 0; point < clip.names.size(); ++point) {
        std::size_t seen = 0;
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            seen += std::isnan(clip.position(frame, point).x) ? 0U : 1U;
        }
        list.push_back({{"name", printable(clip.names[point])}, {"seen", seen}});
    }
    Json edges = Json::array();
    for (const motion::PointEdge& edge : points.edges) {
        edges.push_back({printable(clip.names[edge.from]), printable(clip.names[edge.to])});
    }
    const Json document = {{"format", "raks-points"},
                           {"version", 1},
                           {"file", printable(name)},
                           {"frames", clip.frame_count},
                           {"frames_per_second", clip.frames_per_second},
                           {"points", list},
                           {"edges", edges}};
    return document.text(2);
}

}  // namespace raks::apps
