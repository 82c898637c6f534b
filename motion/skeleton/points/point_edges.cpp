#include "motion/skeleton/points/point_edges.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <utility>

#include "base/printable.hpp"
#include "motion/skeleton/text_lines.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::size_t kMostEdges = 10'000;

// A pair of places in a set's list of names.
using SetEdge = std::pair<std::size_t, std::size_t>;

// Names in the order of the set, in lower case and without signs, "l" and "r" for the sides.
struct EdgeSet {
    std::string_view name;
    std::span<const std::string_view> points;
    std::span<const SetEdge> edges;
};

// OpenPose, "Output: Pose Output Format (BODY_25)".
constexpr std::array<std::string_view, 25> kBody25 = {
    "nose", "neck",    "rshoulder", "relbow", "rwrist",  "lshoulder", "lelbow", "lwrist", "midhip",
    "rhip", "rknee",   "rankle",    "lhip",   "lknee",   "lankle",    "reye",   "leye",   "rear",
    "lear", "lbigtoe", "lsmalltoe", "lheel",  "rbigtoe", "rsmalltoe", "rheel"};
constexpr std::array<SetEdge, 24> kBody25Edges = {
    {{1, 8},  {1, 2},   {1, 5},   {2, 3},   {3, 4},   {5, 6},   {6, 7},   {8, 9},
     {9, 10}, {10, 11}, {8, 12},  {12, 13}, {13, 14}, {1, 0},   {0, 15},  {15, 17},
     {0, 16}, {16, 18}, {14, 19}, {19, 20}, {14, 21}, {11, 22}, {22, 23}, {11, 24}}};

// COCO's person keypoints, "skeleton" of its annotations.
constexpr std::array<std::string_view, 17> kCoco = {"nose",
                                                    "leye",
                                                    "reye",
                                                    "lear",
                                                    "rear",
                                                    "lshoulder",
                                                    "rshoulder",
                                                    "lelbow",
                                                    "relbow",
                                                    "lwrist",
                                                    "rwrist",
                                                    "lhip",
                                                    "rhip",
                                                    "lknee",
                                                    "rknee",
                                                    "lankle",
                                                    "rankle"};
constexpr std::array<SetEdge, 19> kCocoEdges = {{{15, 13},
                                                 {13, 11},
                                                 {16, 14},
                                                 {14, 12},
                                                 {11, 12},
                                                 {5, 11},
                                                 {6, 12},
                                                 {5, 6},
                                                 {5, 7},
                                                 {6, 8},
                                                 {7, 9},
                                                 {8, 10},
                                                 {1, 2},
                                                 {0, 1},
                                                 {0, 2},
                                                 {1, 3},
                                                 {2, 4},
                                                 {3, 5},
                                                 {4, 6}}};

constexpr std::array<EdgeSet, 2> kSets = {
    {{"body25", kBody25, kBody25Edges}, {"coco", kCoco, kCocoEdges}}};

constexpr std::array<std::string_view, kSets.size()> kSetNames = {kSets[0].name, kSets[1].name};

const EdgeSet* set_named(std::string_view name) {
    const auto* const found = std::find_if(
        kSets.begin(), kSets.end(), [name](const EdgeSet& set) { return set.name == name; });
    return found != kSets.end() ? found : nullptr;
}

// "Left_Knee", "l.knee" and "LKnee" are "lknee"; Pose2Sim's "CHip" is the middle of the hips.
std::string plain_name(std::string_view name) {
    std::string plain;
    for (const char c : lower(name)) {
        if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) {
            plain += c;
        }
    }
    for (const std::string_view side : {"left", "right"}) {
        if (plain.starts_with(side)) {
            plain.erase(1, side.size() - 1);
        }
    }
    return plain == "chip" || plain == "pelvis" ? "midhip" : plain;
}

// The place of a point in a set: by its name, else by its number.
std::optional<std::size_t> place_in(const EdgeSet& set, std::string_view name) {
    const std::string plain = plain_name(name);
    const auto at = std::find(set.points.begin(), set.points.end(), plain);
    if (at != set.points.end()) {
        return static_cast<std::size_t>(at - set.points.begin());
    }
    std::size_t number = 0;
    const char* const end = plain.data() + plain.size();
    const auto read = std::from_chars(plain.data(), end, number);
    const bool is_number = !plain.empty() && read.ec == std::errc() && read.ptr == end;
    return is_number && number < set.points.size() ? std::optional(number) : std::nullopt;
}

void add_edge(std::size_t one, std::size_t other, FoundEdges& found) {
    if (one != other) {
        found.edges.push_back({std::min(one, other), std::max(one, other)});
    }
}

void sort_edges(FoundEdges& found) {
    std::sort(found.edges.begin(), found.edges.end());
    found.edges.erase(std::unique(found.edges.begin(), found.edges.end()), found.edges.end());
}

bool separates(char c) { return is_blank(c) || c == ',' || c == ';'; }

// The names of one line. Errors: a quote that is not closed.
Expected<std::vector<std::string>> names_of(std::string_view line) {
    std::vector<std::string> names;
    for (;;) {
        while (!line.empty() && separates(line.front())) {
            line.remove_prefix(1);
        }
        if (line.empty() || line.front() == '#') {
            return names;
        }
        if (line.front() == '"') {
            const std::size_t end = line.find('"', 1);
            if (end == std::string_view::npos) {
                return fail("a quote is not closed");
            }
            names.emplace_back(line.substr(1, end - 1));
            line.remove_prefix(end + 1);
            continue;
        }
        std::size_t end = 0;
        while (end < line.size() && !separates(line[end]) && line[end] != '#') {
            ++end;
        }
        names.emplace_back(line.substr(0, end));
        line.remove_prefix(end);
    }
}

}  // namespace

Expected<std::vector<NamedEdge>> parse_edges(std::string_view text, const std::string& name) {
    if (text.find('\0') != std::string_view::npos) {
        return fail(name + ": is not a text; an edges file has two names a line");
    }
    std::vector<NamedEdge> edges;
    for (const Line& line : split_lines(text)) {
        const auto fault = [&](const std::string& what) {
            return fail(fmt::format("{}: line {}: {}", name, line.number, what));
        };
        auto names = names_of(line.text);
        if (!names) {
            return fault(names.error().message);
        }
        if (names->empty()) {
            continue;
        }
        if (names->size() != 2) {
            return fault(
                fmt::format("{} name{}, must be two: the points that are joined, such as "
                            "\"RHip RKnee\"",
                            names->size(),
                            names->size() == 1 ? "" : "s"));
        }
        if ((*names)[0] == (*names)[1]) {
            return fault("joins \"" + printable((*names)[0], 60) + "\" with itself");
        }
        if (edges.size() == kMostEdges) {
            return fault(fmt::format("more than {} edges", kMostEdges));
        }
        edges.push_back({std::move((*names)[0]), std::move((*names)[1]), line.number});
    }
    if (edges.empty()) {
        return fail(name + ": has no edges; give two names a line");
    }
    return edges;
}

std::span<const std::string_view> known_edge_sets() noexcept { return kSetNames; }

std::optional<std::vector<NamedEdge>> edges_of_set(std::string_view name) {
    const EdgeSet* const set = set_named(name);
    if (set == nullptr) {
        return std::nullopt;
    }
    std::vector<NamedEdge> edges;
    for (const auto& [from, to] : set->edges) {
        edges.push_back({std::string(set->points[from]), std::string(set->points[to]), 0});
    }
    return edges;
}

FoundEdges find_edges(std::span<const NamedEdge> edges, std::span<const std::string> points) {
    std::map<std::string_view, std::size_t> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        places.emplace(points[i], i);  // the first of a name stays
    }
    FoundEdges found;
    for (const NamedEdge& edge : edges) {
        bool is_known = true;
        for (const std::string& name : {edge.from, edge.to}) {
            if (!places.contains(name)) {
                is_known = false;
                if (std::find(found.unknown.begin(), found.unknown.end(), name) ==
                    found.unknown.end()) {
                    found.unknown.push_back(name);
                }
            }
        }
        if (is_known) {
            add_edge(places.find(edge.from)->second, places.find(edge.to)->second, found);
        } else {
            ++found.left_out;
        }
    }
    sort_edges(found);
    return found;
}

FoundEdges find_set_edges(std::string_view name, std::span<const std::string> points) {
    FoundEdges found;
    const EdgeSet* const set = set_named(name);
    if (set == nullptr) {
        return found;
    }
    std::map<std::size_t, std::size_t> point_at;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (const auto place = place_in(*set, points[i])) {
            point_at.emplace(*place, i);
        }
    }
    for (const auto& [from, to] : set->edges) {
        const auto one = point_at.find(from);
        const auto other = point_at.find(to);
        if (one != point_at.end() && other != point_at.end()) {
            add_edge(one->second, other->second, found);
        }
    }
    sort_edges(found);
    return found;
}

}  // namespace raks::motion
