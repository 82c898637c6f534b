#include "motion/capture/markers/marker_set.hpp"

#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/plain_name.hpp"
#include "base/printable.hpp"

namespace raks::capture {
namespace {

using motion::Bone;

constexpr std::string_view kSetFormat = "raks-markers";
constexpr std::size_t kFewestMarkers = 6;
constexpr std::size_t kMostMarkers = 100;
constexpr double kFarthest = 0.5;  // metres from the joint

/// A marker of the shipped set, on the left or in the middle, and its colours of five.
struct ShippedMarker {
    std::string_view name;
    Bone bone;
    glm::dvec3 place;
    int colour;        ///< of the left or the middle
    int right_colour;  ///< -1: there is no right one
};

constexpr std::array<std::string_view, 5> kFiveColours = {
    "green", "blue", "yellow", "magenta", "cyan"};

constexpr std::array<ShippedMarker, 12> kShipped = {{
    {"head", Bone::head, {0.0, 0.255, 0.0}, 0, -1},
    {"c7", Bone::upper_chest, {0.0, 0.165, -0.090}, 1, -1},
    {"sternum", Bone::upper_chest, {0.0, 0.080, 0.115}, 2, -1},
    {"sacrum", Bone::hips, {0.0, 0.040, -0.120}, 2, -1},
    {"shoulder", Bone::left_shoulder, {0.125, 0.072, -0.020}, 3, 4},
    {"waist", Bone::hips, {0.115, 0.070, 0.085}, 0, 1},
    {"elbow", Bone::left_lower_arm, {0.0, 0.050, 0.0}, 4, 3},
    {"wrist", Bone::left_lower_arm, {0.225, 0.040, 0.0}, 1, 0},
    {"knee", Bone::left_lower_leg, {0.055, 0.0, 0.0}, 4, 2},
    {"ankle", Bone::left_lower_leg, {0.045, -0.395, -0.020}, 0, 1},
    {"hand", Bone::left_hand, {0.075, 0.030, 0.0}, 3, 4},
    {"toe", Bone::left_foot, {0.0, -0.035, 0.130}, 2, 3},
}};

void read_head(const toml::table& root, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {"format", "version", "radius", "marker"};
    complaints.check_keys(root, kKeys);
    complaints.check_head(root, kSetFormat, 1);
}

void check_name(const toml::table& table,
                const std::string& name,
                const MarkerSet& set,
                TomlComplaints& complaints) {
    if (!is_plain_name(name) || name.find_first_of(",\t\"") != std::string::npos) {
        complaints.complain(table, "name must be a short text without commas, tabs and quotes");
    } else if (set.index_of(name)) {
        complaints.complain(table, fmt::format("two markers are called \"{}\"", name));
    }
}

Marker read_marker(const toml::table& table, const MarkerSet& set, TomlComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {"name", "colour", "bone", "place"};
    complaints.check_keys(table, kKeys);
    Marker marker;
    marker.name = complaints.text(table, "name");
    check_name(table, marker.name, set, complaints);
    marker.colour = complaints.text(table, "colour");
    if (!is_plain_name(marker.colour) ||
        marker.colour.find_first_of(",\t\"") != std::string::npos) {
        complaints.complain(table, "needs colour = \"green\" or another short text");
    }
    if (const toml::node* const bone = complaints.needed(table, "bone", "bone = \"leftHand\"")) {
        marker.bone = static_cast<Bone>(complaints.word(*bone, "bone", motion::kBoneNames));
    }
    if (const toml::node* const place = complaints.needed(table, "place", "place = [x, y, z]")) {
        const auto at = complaints.numbers<3>(
            *place, "place", {-kFarthest, kFarthest}, "[x, y, z], metres from the bone's joint");
        marker.place = {at[0], at[1], at[2]};
    }
    return marker;
}

Marker shipped_marker(const ShippedMarker& shipped, bool is_right, MarkerColours colours) {
    const bool is_paired = shipped.right_colour >= 0;
    Marker marker;
    marker.name = is_paired ? fmt::format("{}_{}", is_right ? "right" : "left", shipped.name)
                            : std::string(shipped.name);
    const int colour = is_right ? shipped.right_colour : shipped.colour;
    marker.colour = colours == MarkerColours::unique
                        ? "colour of " + marker.name
                        : std::string(kFiveColours[static_cast<std::size_t>(colour)]);
    marker.bone = is_right ? motion::mirrored(shipped.bone) : shipped.bone;
    marker.place = shipped.place;
    if (is_right) {
        marker.place.x = -marker.place.x;
    }
    return marker;
}

}  // namespace

std::optional<std::size_t> MarkerSet::index_of(std::string_view name) const noexcept {
    for (std::size_t i = 0; i < markers.size(); ++i) {
        if (markers[i].name == name) {
            return i;
        }
    }
    return std::nullopt;
}

std::vector<std::string> MarkerSet::colours() const {
    std::vector<std::string> names;
    for (const Marker& marker : markers) {
        if (std::find(names.begin(), names.end(), marker.colour) == names.end()) {
            names.push_back(marker.colour);
        }
    }
    return names;
}

std::vector<std::size_t> MarkerSet::classes() const {
    const std::vector<std::string> names = colours();
    std::vector<std::size_t> classes;
    for (const Marker& marker : markers) {
        const auto found = std::find(names.begin(), names.end(), marker.colour);
        classes.push_back(static_cast<std::size_t>(found - names.begin()));
    }
    return classes;
}

Expected<MarkerSet> read_marker_set(std::string_view text, const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    read_head(*root, complaints);
    MarkerSet set;
    complaints.read(*root, "radius", {0.002, 0.1}, set.radius);
    const toml::array* const markers = (*root)["marker"].as_array();
    const std::size_t count = markers != nullptr ? markers->size() : 0;
    if (count < kFewestMarkers || count > kMostMarkers) {
        complaints.complain(
            fmt::format("has {} [[marker]], needs {} to {}", count, kFewestMarkers, kMostMarkers));
        return fail(complaints.fault());
    }
    for (const toml::node& node : *markers) {
        if (const toml::table* const table = node.as_table()) {
            set.markers.push_back(read_marker(*table, set, complaints));
        } else {
            complaints.complain(node, "a marker must be a table [[marker]]");
        }
    }
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return set;
}

std::string marker_set_text(const MarkerSet& set) {
    std::string text =
        fmt::format("format = \"{}\"\nversion = 1\nradius = {}\n", kSetFormat, set.radius);
    for (const Marker& marker : set.markers) {
        text += fmt::format(
            "\n[[marker]]\nname = {}\ncolour = {}\nbone = \"{}\"\nplace = [{}, {}, {}]\n",
            toml_quoted(marker.name),
            toml_quoted(marker.colour),
            motion::kBoneNames[motion::index_of(marker.bone)],
            marker.place.x + 0.0,  // no -0, which would be read as a whole number
            marker.place.y + 0.0,
            marker.place.z + 0.0);
    }
    return text;
}

MarkerSet default_markers(MarkerColours colours) {
    MarkerSet set;
    for (const ShippedMarker& shipped : kShipped) {
        set.markers.push_back(shipped_marker(shipped, false, colours));
        if (shipped.right_colour >= 0) {
            set.markers.push_back(shipped_marker(shipped, true, colours));
        }
    }
    return set;
}

}  // namespace raks::capture
