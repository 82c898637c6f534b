#include "motion/skeleton/body/up_finder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "base/printable.hpp"

namespace raks::motion {
namespace {

constexpr std::array<glm::dvec3, 6> kAxes = {
    {{0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {-1, 0, 0}, {0, -1, 0}}};
constexpr std::array<std::string_view, 6> kAxisNames = {"+y", "+z", "-z", "+x", "-x", "-y"};

// The head of somebody who stands, sits or dances is that near to straight over the feet.
const double kOver = std::cos(35.0 * glm::pi<double>() / 180.0);
constexpr double kMostFrames = 0.6;  // share of the frames: "most"
// Of the body's height: what lies or stands on a floor moves that little along its normal.
constexpr double kFlat = 0.012;

Bone topmost(const PosedBody& body) {
    for (const Bone bone : {Bone::head, Bone::neck, Bone::upper_chest, Bone::chest}) {
        if (body.has(bone)) {
            return bone;
        }
    }
    return Bone::hips;
}

/// Share of the frames in which the head is over the feet along an axis.
double upright_share(const PosedBody& body, const glm::dvec3& axis) {
    const Bone top = topmost(body);
    std::size_t over = 0;
    for (std::size_t i = 0; i < body.frames(); ++i) {
        const glm::dvec3 feet =
            0.5 * (body.place(i, Bone::left_foot) + body.place(i, Bone::right_foot));
        const glm::dvec3 head = body.place(i, top) - feet;
        over += glm::dot(head, axis) > kOver * glm::length(head) ? 1U : 0U;
    }
    return static_cast<double>(over) / static_cast<double>(body.frames());
}

/// How much the lowest joint along an axis moves along it: standard deviation, file units.
double unevenness(const PosedBody& body, const glm::dvec3& axis) {
    double sum = 0.0;
    double squares = 0.0;
    double first = 0.0;
    for (std::size_t i = 0; i < body.frames(); ++i) {
        double lowest = std::min(glm::dot(body.toe_tip(i, Side::left), axis),
                                 glm::dot(body.toe_tip(i, Side::right), axis));
        for (const auto& joint : body.mapping().joints) {
            if (joint) {
                lowest = std::min(lowest, glm::dot(body.world(i).positions[*joint], axis));
            }
        }
        first = i == 0 ? lowest : first;
        sum += lowest - first;
        squares += (lowest - first) * (lowest - first);
    }
    const double n = static_cast<double>(body.frames());
    return std::sqrt(std::max(0.0, squares / n - sum / n * sum / n));
}

/// Rough size of the body, file units.
double rough_height(const PosedBody& body) {
    return 2.0 * (body.distance(Bone::left_upper_leg, Bone::left_lower_leg) +
                  body.distance(Bone::left_lower_leg, Bone::left_foot));
}

}  // namespace

FoundUp find_up(const PosedBody& body) {
    FoundUp found;
    std::size_t best = 0;
    std::array<double, kAxes.size()> shares{};
    for (std::size_t a = 0; a < kAxes.size(); ++a) {
        shares[a] = upright_share(body, kAxes[a]);
        best = shares[a] > shares[best] ? a : best;
    }
    if (shares[best] < kMostFrames) {
        found.confidence = 0.3;
        found.reason = "the body is upright along no axis in most frames; y is usual";
        return found;
    }
    if (best != 0) {
        const double along_y = unevenness(body, kAxes[0]);
        if (along_y < kFlat * rough_height(body) && along_y < 0.5 * unevenness(body, kAxes[best])) {
            found.confidence = 0.5;
            found.reason = fmt::format("the head points along {}, but the floor is level along y",
                                       kAxisNames[best]);
            return found;
        }
    }
    found.axis = kAxes[best];
    found.upright = turn_to_y(found.axis);
    found.confidence = shares[best];
    found.reason =
        fmt::format("the head is over the feet in {:.0f} % of the frames", 100.0 * shares[best]);
    return found;
}

glm::dquat turn_to_y(const glm::dvec3& axis) {
    if (axis == kAxes[0]) {
        return {1.0, 0.0, 0.0, 0.0};
    }
    if (axis == kAxes[5]) {
        return {0.0, 1.0, 0.0, 0.0};
    }
    const glm::dvec3 normal = glm::normalize(glm::cross(axis, kAxes[0]));
    const double angle = std::acos(std::clamp(axis.y, -1.0, 1.0));
    return glm::angleAxis(angle, normal);
}

Expected<glm::dvec3> read_axis(std::string_view text) {
    for (std::size_t a = 0; a < kAxes.size(); ++a) {
        if (text == kAxisNames[a] || (kAxisNames[a][0] == '+' && text == kAxisNames[a].substr(1))) {
            return kAxes[a];
        }
    }
    return fail(fmt::format("\"{}\" is not an axis; known: x, y, z, -x, -y, -z",
                            printable(std::string(text), 20)));
}

std::string axis_name(const glm::dvec3& axis) {
    for (std::size_t a = 0; a < kAxes.size(); ++a) {
        if (axis == kAxes[a]) {
            return std::string(kAxisNames[a]);
        }
    }
    return fmt::format("{:.2f} {:.2f} {:.2f}", axis.x, axis.y, axis.z);
}

}  // namespace raks::motion
