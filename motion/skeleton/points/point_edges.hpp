// Point edges: which recorded points are joined, said by a file or known of a set of points.
#pragma once

#include <compare>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::motion {

/// Two points of a clip that are drawn joined; `from` < `to`.
struct PointEdge {
    std::size_t from = 0;  ///< index of a point
    std::size_t to = 0;    ///< index of another
    friend auto operator<=>(const PointEdge&, const PointEdge&) = default;
};

/// Two points by name, as a line of an edges file has them.
struct NamedEdge {
    std::string from;
    std::string to;
    std::size_t line = 0;  ///< of the file, from 1; 0: of a known set
};

/// Reads an edges file: two names a line, apart by blanks, a tab, a comma or a semicolon; a name
/// with one of these in it stands in double quotes; what follows '#' is passed over, but in quotes.
/// `name`: the file's, for messages.
///
///     # right leg
///     RHip  RKnee
///     RKnee RAnkle
///     "point 12", "point 13"
///
/// Errors, one line with its number: one name or three in a line, a quote that is not closed, a
/// point joined with itself, no line at all, what is no text, more than 10,000 lines. Pure.
[[nodiscard]] Expected<std::vector<NamedEdge>> parse_edges(std::string_view text,
                                                           const std::string& name);

/// Sets of points whose edges are known: OpenPose's BODY_25 ("body25") and COCO's 17 ("coco").
[[nodiscard]] std::span<const std::string_view> known_edge_sets() noexcept;
/// The edges of one of them. None: not known.
[[nodiscard]] std::optional<std::vector<NamedEdge>> edges_of_set(std::string_view set);

/// Edges as indices, and what could not be found.
struct FoundEdges {
    std::vector<PointEdge> edges;      ///< sorted, each once
    std::vector<std::string> unknown;  ///< names that are no point, each once, in their order
    std::size_t left_out = 0;          ///< edges that name one of these
};

/// Looks for named edges among the points of a clip: names as they are written. Of a name used
/// twice the first point counts.
[[nodiscard]] FoundEdges find_edges(std::span<const NamedEdge> edges,
                                    std::span<const std::string> points);
/// The same of a known set, whose names are written in many ways: case, signs and "left" or "L" do
/// not matter ("left_knee", "LKnee", "l.knee"), and points that are but numbers count in the set's
/// order. Points of the set that are not there have no edges, and are not named.
[[nodiscard]] FoundEdges find_set_edges(std::string_view set, std::span<const std::string> points);

}  // namespace raks::motion
