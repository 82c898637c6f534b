#include "motion/capture/markerless/point_tracks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/printable.hpp"
#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/solving/body_size.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kFewestPoints = 6;
constexpr double kLowestDancer = 0.8;     // metres
constexpr double kTallestDancer = 2.5;    // metres
constexpr double kPointDeviation = 0.01;  // of a place that does not say its own; metres

// Which point of a clip is which marker.
struct PointUse {
    std::size_t point = 0;
    std::string marker;
};

struct ChosenMarkers {
    MarkerSet set;
    std::vector<PointUse> uses;
};

std::vector<PointUse> uses_by_set(const motion::PointClip& clip, const MarkerSet& set) {
    std::vector<PointUse> uses;
    for (std::size_t i = 0; i < clip.names.size(); ++i) {
        // Some programs write "subject:marker".
        const std::string name = clip.names[i].substr(clip.names[i].rfind(':') + 1);
        if (set.index_of(name)) {
            uses.push_back({i, name});
        }
    }
    return uses;
}

std::vector<PointUse> uses_by_words(const motion::PointClip& clip, const PointNameMap& map) {
    std::vector<PointUse> uses;
    const auto followed = followed_points();
    for (std::size_t i = 0; i < clip.names.size(); ++i) {
        const std::string name = clip.names[i].substr(clip.names[i].rfind(':') + 1);
        const auto meant = body_point_meant(name, map);
        const bool is_followed =
            meant && std::find(followed.begin(), followed.end(), *meant) != followed.end();
        const bool is_new =
            is_followed && std::none_of(uses.begin(), uses.end(), [&](const PointUse& use) {
                return use.marker == name_of(*meant);
            });
        if (is_new) {
            uses.push_back({i, std::string(name_of(*meant))});
        }
    }
    return uses;
}

std::string names_line(const std::vector<std::string>& names) {
    constexpr std::size_t kMost = 8;
    std::vector<std::string> said;
    for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) {
        said.push_back(printable(names[i], 24));
    }
    return fmt::format("{}{}", fmt::join(said, ", "), names.size() > kMost ? ", ..." : "");
}

Expected<ChosenMarkers> choose_markers(const motion::PointClip& clip, const PointReading& reading) {
    if (reading.markers) {
        ChosenMarkers chosen{*reading.markers, uses_by_set(clip, *reading.markers)};
        if (chosen.uses.size() < kFewestPoints) {
            return fail(
                fmt::format("only {} of its points ({}) are in the marker set; {} are needed",
                            chosen.uses.size(),
                            names_line(clip.names),
                            kFewestPoints));
        }
        return chosen;
    }
    ChosenMarkers shipped{default_markers(), uses_by_set(clip, default_markers())};
    ChosenMarkers joints{keypoint_markers(), uses_by_words(clip, reading.names)};
    ChosenMarkers& chosen = shipped.uses.size() > joints.uses.size() ? shipped : joints;
    if (chosen.uses.size() < kFewestPoints) {
        return fail(fmt::format(
            "its points ({}) are not called after joints, so nobody knows where on the body they "
            "are: tell the names by --names X.tsv, or where markers sit by --markers X.toml",
            names_line(clip.names)));
    }
    return std::move(chosen);
}

double middle_value(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

// Where up is: the axis along which the upper body is over the feet, with its sign.
struct UpDirection {
    glm::length_t axis = 1;
    double sign = 1.0;
};

bool is_low(motion::Bone bone) {
    return bone == motion::Bone::left_foot || bone == motion::Bone::right_foot ||
           bone == motion::Bone::left_lower_leg || bone == motion::Bone::right_lower_leg ||
           bone == motion::Bone::left_toes || bone == motion::Bone::right_toes;
}

// The mean of the used points of one kind at a frame; none: none is seen.
std::optional<glm::dvec3> mean_of(const motion::PointClip& clip,
                                  const ChosenMarkers& chosen,
                                  std::size_t frame,
                                  bool of_low_ones) {
    glm::dvec3 sum{};
    double count = 0.0;
    for (const PointUse& use : chosen.uses) {
        const motion::Bone bone = chosen.set.markers[*chosen.set.index_of(use.marker)].bone;
        const glm::dvec3& place = clip.position(frame, use.point);
        if (is_low(bone) == of_low_ones && std::isfinite(place.x)) {
            sum += place;
            count += 1.0;
        }
    }
    return count > 0.0 ? std::optional(sum / count) : std::nullopt;
}

Expected<UpDirection> guess_up(const motion::PointClip& clip, const ChosenMarkers& chosen) {
    std::array<std::vector<double>, 3> rises;
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        const auto low = mean_of(clip, chosen, frame, true);
        const auto high = mean_of(clip, chosen, frame, false);
        for (glm::length_t axis = 0; low && high && axis < 3; ++axis) {
            rises[static_cast<std::size_t>(axis)].push_back((*high)[axis] - (*low)[axis]);
        }
    }
    if (rises[0].empty()) {
        return fail("legs and upper body are never seen at once, so nobody knows where up is");
    }
    UpDirection up;
    double most = 0.0;
    for (glm::length_t axis = 0; axis < 3; ++axis) {
        const double rise = middle_value(rises[static_cast<std::size_t>(axis)]);
        if (std::abs(rise) > most) {
            most = std::abs(rise);
            up = {axis, rise < 0.0 ? -1.0 : 1.0};
        }
    }
    return most > 0.0 ? Expected<UpDirection>(up) : fail("all its points lie in one place");
}

Expected<UpDirection> choose_up(const motion::PointClip& clip,
                                const ChosenMarkers& chosen,
                                const PointReading& reading) {
    if (reading.up) {
        return UpDirection{*reading.up - 'x', 1.0};
    }
    if (clip.up) {
        for (glm::length_t axis = 0; axis < 3; ++axis) {
            if (std::abs((*clip.up)[axis]) > 0.9) {
                return UpDirection{axis, (*clip.up)[axis] < 0.0 ? -1.0 : 1.0};
            }
        }
    }
    return guess_up(clip, chosen);
}

// A place with y up; right-handed as before.
glm::dvec3 upright(const glm::dvec3& place, const UpDirection& up) {
    // Cyclic: the axis after up becomes z, the one after that x.
    const glm::length_t z = (up.axis + 1) % 3;
    const glm::length_t x = (up.axis + 2) % 3;
    return {place[x] * up.sign, place[up.axis] * up.sign, place[z]};
}

// Height of the dancer in file units: the points' extent along up, as it is in most frames.
double extent_of(const Tracks& tracks) {
    std::vector<double> extents;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        double low = std::numeric_limits<double>::max();
        double high = std::numeric_limits<double>::lowest();
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const MarkerPlace& place = tracks.at(frame, marker);
            if (place.source != PlaceSource::lost) {
                low = std::min(low, place.place.y);
                high = std::max(high, place.place.y);
            }
        }
        if (high > low) {
            extents.push_back(high - low);
        }
    }
    return extents.empty() ? 0.0 : middle_value(std::move(extents));
}

bool is_dancer(double height) {
    return height >= 0.6 * kLowestDancer && height <= 1.2 * kTallestDancer;
}

// Metres of the file's unit.
Expected<double> choose_unit(const motion::PointClip& clip,
                             const PointReading& reading,
                             double extent,
                             std::vector<std::string>& notes) {
    constexpr std::array<std::pair<const char*, double>, 3> kUnits = {
        {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}}};
    const auto fitting = std::find_if(kUnits.begin(), kUnits.end(), [extent](const auto& unit) {
        return is_dancer(extent * unit.second);
    });
    const std::optional<double> said =
        reading.metres_per_unit ? reading.metres_per_unit : clip.metres_per_unit;
    if (said && is_dancer(extent * *said)) {
        return *said;
    }
    const std::string help =
        fitting != kUnits.end()
            ? fmt::format(
                  "; --unit {} would make it {:.2f} m", fitting->first, extent * fitting->second)
            : std::string();
    if (said) {
        return fail(
            fmt::format("its unit gives a dancer {:.4g} m tall{}",
                        extent * *said,
                        help.empty() ? "; no unit makes one of it: scale the points first" : help));
    }
    if (fitting == kUnits.end()) {
        return fail(
            fmt::format("its points are {:.4g} units tall, which is no dancer in m, cm or "
                        "mm; scale them first",
                        extent));
    }
    notes.push_back(fmt::format("does not say its unit: taken as {}", fitting->first));
    return fitting->second;
}

// Moves all places so that the lowest points of the feet are where soles have them.
void put_on_floor(const MarkerSet& markers, Tracks& tracks) {
    const motion::WorldPose rest = motion::world_pose(motion::mannequin_skeleton(), motion::Pose{});
    const auto hips = static_cast<double>(motion::mannequin_skeleton().hips_height());
    std::vector<double> floors;
    for (std::size_t i = 0; i < tracks.markers.size(); ++i) {
        const Marker& marker = markers.markers[*markers.index_of(tracks.markers[i])];
        std::vector<double> heights;
        for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
            if (tracks.at(frame, i).source != PlaceSource::lost) {
                heights.push_back(tracks.at(frame, i).place.y);
            }
        }
        if (!is_low(marker.bone) || heights.empty()) {
            continue;
        }
        const double standing =
            static_cast<double>(rest.point(marker.bone, glm::vec3(marker.place)).y) -
            static_cast<double>(rest.position(motion::Bone::hips).y) + hips;
        constexpr double kOften = 0.05;
        std::sort(heights.begin(), heights.end());
        const auto at = static_cast<std::size_t>(kOften * static_cast<double>(heights.size()));
        // Knees are lifted and bent; what matters is near the floor.
        constexpr double kNearFloor = 0.15;
        if (standing < kNearFloor) {
            floors.push_back(heights[at] - standing);
        }
    }
    if (floors.empty()) {
        return;
    }
    const double floor = middle_value(std::move(floors));
    for (MarkerPlace& place : tracks.places) {
        place.place.y -= floor;
    }
}

}  // namespace

Expected<PointTracks> point_tracks(const motion::PointClip& clip, const PointReading& reading) {
    const auto chosen = choose_markers(clip, reading);
    if (!chosen) {
        return fail(chosen.error());
    }
    const auto up = choose_up(clip, *chosen, reading);
    if (!up) {
        return fail(up.error());
    }
    PointTracks found;
    found.markers = chosen->set;
    Tracks& tracks = found.tracks;
    tracks.frames_per_second = clip.frames_per_second;
    tracks.frame_count = clip.frame_count;
    for (const PointUse& use : chosen->uses) {
        tracks.markers.push_back(use.marker);
    }
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        for (const PointUse& use : chosen->uses) {
            MarkerPlace place;
            const glm::dvec3& at = clip.position(frame, use.point);
            if (std::isfinite(at.x)) {
                place = {upright(at, *up), kPointDeviation, 2, PlaceSource::seen};
            }
            tracks.places.push_back(place);
        }
    }
    const auto unit = choose_unit(clip, reading, extent_of(tracks), found.notes);
    if (!unit) {
        return fail(unit.error());
    }
    for (MarkerPlace& place : tracks.places) {
        place.place *= *unit;
    }
    put_on_floor(found.markers, tracks);
    for (const auto& [name, point] : reading.names) {
        const bool is_there = std::any_of(
            clip.names.begin(), clip.names.end(), [&called = name](const std::string& other) {
                return other.substr(other.rfind(':') + 1) == called;
            });
        if (!is_there) {
            found.notes.push_back(fmt::format(
                "no point is called \"{}\", which the names told have", printable(name, 40)));
        }
    }
    if (chosen->uses.size() < clip.names.size()) {
        found.notes.push_back(
            fmt::format("{} of its {} points are not used: their names say no "
                        "joint",
                        clip.names.size() - chosen->uses.size(),
                        clip.names.size()));
    }
    return found;
}

}  // namespace raks::capture
