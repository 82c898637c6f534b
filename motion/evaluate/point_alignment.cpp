#include "motion/evaluate/point_alignment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <Eigen/Eigenvalues>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {
namespace {

// Two places of one point at one moment.
struct PlacePair {
    glm::dvec3 one;
    glm::dvec3 other;
};

// What both see; with `hips`, from those of the first, over which the second's lie.
std::vector<PlacePair> places_in_common(const WorldPoints& one,
                                        const WorldPoints& other,
                                        const std::vector<PointPair>& pairs,
                                        std::optional<std::size_t> hips) {
    std::vector<PlacePair> places;
    for (std::size_t frame = 0; frame < one.clip.frame_count; ++frame) {
        const glm::dvec3 from = hips ? one.clip.position(frame, *hips) : glm::dvec3(0.0);
        for (const PointPair& pair : pairs) {
            const PlacePair both{one.clip.position(frame, pair.one) - from,
                                 other.clip.position(frame, pair.other) - from};
            if (!std::isnan(both.one.x) && !std::isnan(both.other.x)) {
                places.push_back(both);
            }
        }
    }
    return places;
}

// A turn, then a move.
struct Move {
    glm::dquat turn{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 shift{0.0};
};

// The turn about the origin that brings the others nearest to the ones: the eigenvector of Horn's
// matrix with the largest eigenvalue.
glm::dquat nearest_turn(const std::vector<PlacePair>& places) {
    Eigen::Matrix3d s = Eigen::Matrix3d::Zero();
    for (const PlacePair& both : places) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                s(row, column) += both.other[row] * both.one[column];
            }
        }
    }
    Eigen::Matrix4d n;
    n << s.trace(), s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0),                   //
        s(1, 2) - s(2, 1), s(0, 0) - s(1, 1) - s(2, 2), s(0, 1) + s(1, 0), s(2, 0) + s(0, 2),  //
        s(2, 0) - s(0, 2), s(0, 1) + s(1, 0), s(1, 1) - s(0, 0) - s(2, 2), s(1, 2) + s(2, 1),  //
        s(0, 1) - s(1, 0), s(2, 0) + s(0, 2), s(1, 2) + s(2, 1), s(2, 2) - s(0, 0) - s(1, 1);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(n);
    const Eigen::Vector4d q = solver.eigenvectors().col(3);
    return glm::normalize(glm::dquat(q[0], q[1], q[2], q[3]));
}

Move nearest_move(std::vector<PlacePair> places) {
    glm::dvec3 one(0.0);
    glm::dvec3 other(0.0);
    for (const PlacePair& both : places) {
        one += both.one / static_cast<double>(places.size());
        other += both.other / static_cast<double>(places.size());
    }
    for (PlacePair& both : places) {
        both.one -= one;
        both.other -= other;
    }
    const glm::dquat turn = nearest_turn(places);
    return {turn, one - turn * other};
}

// The point that is a motion's hips: the bone, else one of their usual names.
std::optional<std::size_t> hips_of(const WorldPoints& points) {
    for (std::size_t i = 0; i < points.bones.size(); ++i) {
        if (points.bones[i] == Bone::hips) {
            return i;
        }
    }
    constexpr std::array<std::string_view, 6> kNames = {
        "hips", "midhip", "pelvis", "chip", "root", "mid_hip"};
    for (const std::string_view wanted : kNames) {
        for (std::size_t i = 0; i < points.named; ++i) {
            if (lower(points.clip.names[i]) == wanted) {
                return i;
            }
        }
    }
    return std::nullopt;
}

// Moves each frame of the other so that the hips lie over each other, after a turn about them.
void move_hips(const WorldPoints& one,
               WorldPoints& other,
               std::size_t our_hips,
               std::size_t their_hips,
               const glm::dquat& turn) {
    const std::size_t count = other.clip.names.size();
    for (std::size_t frame = 0; frame < other.clip.frame_count; ++frame) {
        const glm::dvec3 from = other.clip.position(frame, their_hips);
        const glm::dvec3 to = one.clip.position(frame, our_hips);
        for (std::size_t point = 0; point < count; ++point) {
            glm::dvec3& place = other.clip.positions[frame * count + point];
            // Where hips were not seen the frame cannot be laid over: NaN, as they are.
            place = to + turn * (place - from);
            place = std::isnan(place.x + place.y + place.z)
                        ? glm::dvec3(std::numeric_limits<double>::quiet_NaN())
                        : place;
        }
    }
}

// The same where they suffice to tell a turn.
Expected<std::vector<PlacePair>> enough_places(const WorldPoints& one,
                                               const WorldPoints& other,
                                               const std::vector<PointPair>& pairs,
                                               std::optional<std::size_t> hips) {
    constexpr std::size_t kLeastPlaces = 3;
    auto places = places_in_common(one, other, pairs, hips);
    if (places.size() < kLeastPlaces) {
        return fail("the two motions share too few places to be turned onto each other");
    }
    return places;
}

Expected<void> align_rigidly(const WorldPoints& one,
                             WorldPoints& other,
                             const std::vector<PointPair>& pairs) {
    auto places = enough_places(one, other, pairs, std::nullopt);
    if (!places) {
        return fail(std::move(places.error()));
    }
    const Move move = nearest_move(std::move(*places));
    for (glm::dvec3& place : other.clip.positions) {
        place = move.turn * place + move.shift;
    }
    return {};
}

}  // namespace

Expected<void> align(const WorldPoints& one,
                     WorldPoints& other,
                     const std::vector<PointPair>& pairs,
                     PointAlignment alignment) {
    if (alignment == PointAlignment::none) {
        return {};
    }
    if (alignment == PointAlignment::rigid) {
        return align_rigidly(one, other, pairs);
    }
    const auto our_hips = hips_of(one);
    const auto their_hips = hips_of(other);
    if (!our_hips || !their_hips) {
        return fail(std::string(our_hips ? "the second" : "the first") +
                    " motion has no hips to align by; --align rigid needs none");
    }
    move_hips(one, other, *our_hips, *their_hips, glm::dquat(1.0, 0.0, 0.0, 0.0));
    if (alignment == PointAlignment::both) {
        const auto places = enough_places(one, other, pairs, our_hips);
        if (!places) {
            return fail(places.error());
        }
        move_hips(one, other, *our_hips, *their_hips, nearest_turn(*places));
    }
    return {};
}

}  // namespace raks::motion
