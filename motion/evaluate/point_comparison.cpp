#include "motion/evaluate/point_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "motion/skeleton/text_lines.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

const glm::dvec3 kUnseen(std::numeric_limits<double>::quiet_NaN());

bool is_place(const glm::dvec3& place) { return !std::isnan(place.x); }

// "mixamorig:LeftArm" and "leftarm" are one.
std::string loose_name(std::string_view name) { return lower(name.substr(name.rfind(':') + 1)); }

// Points that have found nobody yet, by a key of theirs; a key that two have is none.
class ByKey {
 public:
    void add(std::string key, std::size_t point) {
        const auto [at, is_new] = points_.emplace(std::move(key), point);
        at->second = is_new ? at->second : kTwice;
    }
    [[nodiscard]] std::optional<std::size_t> find(const std::string& key) const {
        const auto at = points_.find(key);
        return at == points_.end() || at->second == kTwice ? std::nullopt
                                                           : std::optional(at->second);
    }

 private:
    static constexpr std::size_t kTwice = std::numeric_limits<std::size_t>::max();
    std::map<std::string, std::size_t> points_;
};

// Ways in which points are the same, the surest first. Empty: the point has no such key.
std::string key_of(const WorldPoints& points, std::size_t point, int way) {
    const std::string& name = points.clip.names[point];
    if (way == 0) {
        return name;
    }
    if (way == 1) {
        return loose_name(name);
    }
    const bool has_bone = point < points.bones.size() && points.bones[point].has_value();
    return has_bone ? std::string(kBoneNames[index_of(*points.bones[point])]) : std::string();
}

}  // namespace

std::vector<PointPair> common_points(const WorldPoints& one, const WorldPoints& other) {
    std::vector<PointPair> pairs;
    std::vector<bool> is_one_taken(one.named, false);
    std::vector<bool> is_other_taken(other.named, false);
    for (const int way : {0, 1, 2}) {
        ByKey ours;
        ByKey theirs;
        for (std::size_t i = 0; i < one.named; ++i) {
            if (std::string key = key_of(one, i, way); !is_one_taken[i] && !key.empty()) {
                ours.add(std::move(key), i);
            }
        }
        for (std::size_t i = 0; i < other.named; ++i) {
            if (std::string key = key_of(other, i, way); !is_other_taken[i] && !key.empty()) {
                theirs.add(std::move(key), i);
            }
        }
        for (std::size_t i = 0; i < one.named; ++i) {
            const std::string key = key_of(one, i, way);
            const auto found = theirs.find(key);
            if (!is_one_taken[i] && !key.empty() && found && ours.find(key) == i) {
                pairs.push_back({i, *found, one.clip.names[i]});
                is_one_taken[i] = true;
                is_other_taken[*found] = true;
            }
        }
    }
    std::sort(pairs.begin(), pairs.end(), [](const PointPair& a, const PointPair& b) {
        return a.one < b.one;
    });
    return pairs;
}

WorldPoints at_frames_of(const WorldPoints& one, const WorldPoints& other, double shift) {
    // Rounding of a rate in a file must not lose the last frame, nor a point beside one not seen.
    constexpr double kNearly = 1e-3;
    WorldPoints result = other;
    result.clip.frames_per_second = one.clip.frames_per_second;
    result.clip.frame_count = one.clip.frame_count;
    result.clip.positions.clear();
    const double last = static_cast<double>(other.clip.frame_count) - 1.0;
    for (std::size_t frame = 0; frame < one.clip.frame_count; ++frame) {
        const double seconds = static_cast<double>(frame) / one.clip.frames_per_second - shift;
        const double wanted = seconds * other.clip.frames_per_second;
        const bool is_there = wanted >= -kNearly && wanted <= last + kNearly;
        const double whole = std::round(wanted);
        const double at =
            std::clamp(std::abs(wanted - whole) <= kNearly ? whole : wanted, 0.0, last);
        const auto before = static_cast<std::size_t>(at);
        const std::size_t after = std::min(before + 1, other.clip.frame_count - 1);
        const double share = at - static_cast<double>(before);
        for (std::size_t point = 0; point < other.clip.names.size(); ++point) {
            const glm::dvec3& from = other.clip.position(before, point);
            // On a frame its neighbour does not count, seen or not.
            const glm::dvec3 place =
                share > 0.0 ? glm::mix(from, other.clip.position(after, point), share) : from;
            result.clip.positions.push_back(is_there && is_place(place) ? place : kUnseen);
        }
    }
    return result;
}

namespace {

// Sums of squares of a frame's distances.
struct SquareSum {
    double sum = 0.0;
    std::size_t count = 0;

    void add(double distance) {
        sum += distance * distance;
        ++count;
    }
    [[nodiscard]] double rms() const {
        return count == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(count));
    }
};

}  // namespace

Expected<PointComparison> compare_points(const WorldPoints& one,
                                         const WorldPoints& other,
                                         const std::vector<PointPair>& pairs) {
    if (pairs.empty()) {
        return fail("the two motions have no point of the same name");
    }
    const std::size_t frames = one.clip.frame_count;
    PointComparison comparison;
    SquareSum all;
    std::vector<SquareSum> by_frame(frames);
    for (const PointPair& pair : pairs) {
        PointDistance point;
        point.name = pair.name;
        point.over_time.assign(frames, std::numeric_limits<float>::quiet_NaN());
        SquareSum own;
        for (std::size_t frame = 0; frame < frames; ++frame) {
            const double distance = glm::distance(one.clip.position(frame, pair.one),
                                                  other.clip.position(frame, pair.other));
            if (std::isnan(distance)) {
                continue;
            }
            point.over_time[frame] = static_cast<float>(distance);
            own.add(distance);
            all.add(distance);
            by_frame[frame].add(distance);
            if (own.count == 1 || distance > point.worst) {
                point.worst = distance;
                point.worst_frame = frame;
            }
        }
        point.rms = own.rms();
        point.frames = own.count;
        comparison.points.push_back(std::move(point));
    }
    if (all.count == 0) {
        return fail(
            "the two motions have no moment in common in which both see a point; is --shift "
            "right?");
    }
    comparison.rms = all.rms();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        if (comparison.points[i].rms > comparison.points[comparison.worst_point].rms) {
            comparison.worst_point = i;
        }
    }
    for (std::size_t frame = 0; frame < frames; ++frame) {
        const bool is_seen = by_frame[frame].count > 0;
        comparison.frames += is_seen ? 1U : 0U;
        const double rms = by_frame[frame].rms();
        comparison.rms_over_time.push_back(is_seen ? static_cast<float>(rms)
                                                   : std::numeric_limits<float>::quiet_NaN());
        if (rms > comparison.worst_frame_rms) {
            comparison.worst_frame_rms = rms;
            comparison.worst_frame = frame;
        }
    }
    return comparison;
}

}  // namespace raks::motion
