#include "motion/capture/tracking/distance_limits.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "motion/skeleton/skeleton.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;

constexpr double kMargin = 0.03;       // metres, beside the share
constexpr double kMarginShare = 0.08;  // of the distance
constexpr double kRigidMargin = 0.04;  // metres, once the distance was seen

/// The bones that bend between two markers, as their joints' places in T-pose; rigid ones in
/// between are one.
struct Chain {
    std::vector<glm::dvec3> joints;  ///< one or two
};

// The joints from one bone to another one: those where the way up from each meets. None: more than
// two of them.
std::optional<Chain> chain_between(Bone one, Bone other, const motion::WorldPose& rest) {
    Chain chain;
    std::size_t a = motion::index_of(one);
    std::size_t b = motion::index_of(other);
    while (a != b) {
        // A parent comes before its children: the greater index is no ancestor of the other.
        std::size_t& deeper = a > b ? a : b;
        chain.joints.emplace_back(rest.positions[deeper]);
        deeper = motion::kBoneParents[deeper];
    }
    constexpr std::size_t kMostJoints = 2;
    return chain.joints.size() <= kMostJoints ? std::optional(chain) : std::nullopt;
}

// Least and most distance of the ends of a chain whose parts have these lengths and turn freely.
DistanceLimit reach_of(const std::vector<double>& lengths) {
    double most = 0.0;
    double longest = 0.0;
    for (const double length : lengths) {
        most += length;
        longest = std::max(longest, length);
    }
    return {0, 0, std::max(0.0, 2.0 * longest - most), most, lengths.size() == 1};
}

}  // namespace

std::vector<DistanceLimit> distance_limits(const MarkerSet& markers, double height) {
    constexpr double kUsualHeight = 1.714;
    const double scale = height > 0.0 ? height / kUsualHeight : 1.0;
    const motion::WorldPose rest = motion::world_pose(motion::mannequin_skeleton(), {});
    const auto place_of = [&](const Marker& marker) {
        return glm::dvec3(rest.point(marker.bone, glm::vec3(marker.place)));
    };
    std::vector<DistanceLimit> limits;
    for (std::size_t i = 0; i < markers.markers.size(); ++i) {
        for (std::size_t j = i + 1; j < markers.markers.size(); ++j) {
            auto chain = chain_between(markers.markers[i].bone, markers.markers[j].bone, rest);
            if (!chain) {
                continue;
            }
            // Joints of the way up from the first, then from the second, lie in order of distance.
            std::vector<glm::dvec3> points = {place_of(markers.markers[i])};
            points.insert(points.end(), chain->joints.begin(), chain->joints.end());
            points.push_back(place_of(markers.markers[j]));
            if (chain->joints.size() == 2 &&
                glm::distance(points[0], points[1]) > glm::distance(points[0], points[2])) {
                std::swap(points[1], points[2]);
            }
            std::vector<double> lengths;
            for (std::size_t k = 1; k < points.size(); ++k) {
                lengths.push_back(scale * glm::distance(points[k - 1], points[k]));
            }
            DistanceLimit limit = reach_of(lengths);
            limit.one = i;
            limit.other = j;
            limit.least = std::max(0.0, limit.least * (1.0 - kMarginShare) - kMargin);
            limit.most = limit.most * (1.0 + kMarginShare) + kMargin;
            limits.push_back(limit);
        }
    }
    return limits;
}

void narrow_to(const std::vector<glm::dvec3>& places, std::vector<DistanceLimit>& limits) {
    for (DistanceLimit& limit : limits) {
        const double apart = glm::distance(places[limit.one], places[limit.other]);
        if (std::isfinite(apart) && limit.is_rigid) {
            limit.least = std::max(0.0, apart - kRigidMargin);
            limit.most = apart + kRigidMargin;
        }
    }
}

std::optional<double> scale_of(const std::vector<glm::dvec3>& places,
                               const std::vector<DistanceLimit>& limits) {
    constexpr std::size_t kFewestLimits = 6;
    constexpr double kStep = 0.02;         // of the factor's logarithm
    constexpr double kFarthest = 9.2;      // a factor of 10,000
    constexpr double kSmallestPart = 0.9;  // of the most limits that hold: those count as well
    std::vector<std::pair<double, const DistanceLimit*>> known;
    for (const DistanceLimit& limit : limits) {
        const double apart = glm::distance(places[limit.one], places[limit.other]);
        if (std::isfinite(apart)) {
            known.emplace_back(apart, &limit);
        }
    }
    if (known.size() < kFewestLimits) {
        return std::nullopt;
    }
    std::vector<std::pair<double, std::ptrdiff_t>> held;  // logarithm of a factor, and how many
    std::ptrdiff_t most = 0;
    for (double at = -kFarthest; at <= kFarthest; at += kStep) {
        const double factor = std::exp(at);
        held.emplace_back(at, std::count_if(known.begin(), known.end(), [factor](const auto& one) {
                              return one.first >= factor * one.second->least &&
                                     one.first <= factor * one.second->most;
                          }));
        most = std::max(most, held.back().second);
    }
    double sum = 0.0;
    double count = 0.0;
    for (const auto& [at, holding] : held) {
        if (static_cast<double>(holding) >= kSmallestPart * static_cast<double>(most)) {
            sum += at;
            count += 1.0;
        }
    }
    return std::exp(sum / count);
}

}  // namespace raks::capture
