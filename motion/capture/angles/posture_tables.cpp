#include "motion/capture/angles/posture_tables.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::capture {
namespace {

constexpr double kFreeTurn = 3.15;  // radians: a joint that may turn further has no limit

TableVector single(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

TableLine line_through(const TablePair& pair, float x, float y) {
    const auto row = [&](std::size_t i) {
        return pair.lines[3 * i] * x + pair.lines[3 * i + 1] * y + pair.lines[3 * i + 2];
    };
    TableLine line{row(0), row(1), row(2)};
    const float length = std::max(1e-12F, std::hypot(line.a, line.b));
    return {line.a / length, line.b / length, line.c / length};
}

void add_links(const BodyModel& model,
               const BodyLinks& links,
               const BodyState& reference,
               PostureTables& tables) {
    for (const BodyLink& link : links.links) {
        const TurningJoint& joint = model.joints()[link.joint];
        const glm::dquat turn = model.local_turn(reference, link.joint);
        TableLink& made = tables.links.emplace_back();
        made.parent = link.parent;
        made.joint = link.joint;
        made.first = joint.first;
        made.is_hinge = joint.is_hinge;
        made.axis = single(link.share * joint.axis);
        made.share = static_cast<float>(link.share);
        made.offset = single(link.offset);
        made.turn = {static_cast<float>(turn.w),
                     static_cast<float>(turn.x),
                     static_cast<float>(turn.y),
                     static_cast<float>(turn.z)};
        made.angle = static_cast<float>(reference.angles[link.joint]);
        made.lowest = static_cast<float>(joint.lowest);
        made.highest = static_cast<float>(joint.highest);
        const double half = 0.5 * link.share * joint.highest;
        if (!joint.is_hinge && joint.highest < kFreeTurn) {
            const glm::dquat usual = joint.usual;
            made.usual = {static_cast<float>(usual.w),
                          static_cast<float>(usual.x),
                          static_cast<float>(usual.y),
                          static_cast<float>(usual.z)};
            made.least_w = static_cast<float>(std::cos(half));
            made.w_to_angle = static_cast<float>(2.0 / (link.share * std::sin(half)));
        }
    }
}

void add_pictures(const FrameMarks& marks, PostureTables& tables) {
    for (const MarkPicture& picture : marks.pictures()) {
        TablePicture& made = tables.pictures.emplace_back();
        for (std::size_t row = 0; row < 3; ++row) {
            const double scale = row < 2 ? kFocalLength : 1.0;
            const auto r = static_cast<glm::length_t>(row);
            for (std::size_t column = 0; column < 3; ++column) {
                made[3 * row + column] = static_cast<float>(
                    scale * picture.rotation[static_cast<glm::length_t>(column)][r]);
            }
            made[9 + row] = static_cast<float>(scale * picture.translation[r]);
        }
    }
}

// The essential matrix between pictures, for places times the focal length.
TablePair pair_of(const MarkPicture& from, const MarkPicture& to) {
    TablePair pair;
    const glm::dmat3 turn = to.rotation * glm::transpose(from.rotation);
    const glm::dvec3 move = to.translation - turn * from.translation;
    for (glm::length_t column = 0; column < 3; ++column) {
        const glm::dvec3 line = glm::cross(move, turn[column]);
        for (glm::length_t row = 0; row < 3; ++row) {
            const double scale =
                (row == 2 ? kFocalLength : 1.0) / (column == 2 ? 1.0 : kFocalLength);
            pair.lines[3 * static_cast<std::size_t>(row) + static_cast<std::size_t>(column)] =
                static_cast<float>(scale * line[row]);
        }
    }
    constexpr double kFarOff = 1e6;
    const bool is_far = std::abs(move.z) * kFarOff < kFocalLength * glm::length(move);
    pair.epipole_x = static_cast<float>(is_far ? kFarOff : kFocalLength * move.x / move.z);
    pair.epipole_y = static_cast<float>(is_far ? kFarOff : kFocalLength * move.y / move.z);
    return pair;
}

void add_epipolar(const FrameMarks& marks, PostureTables& tables) {
    const std::size_t pictures = marks.pictures().size();
    for (const MarkPicture& from : marks.pictures()) {
        for (const MarkPicture& to : marks.pictures()) {
            tables.pairs.push_back(&from == &to ? TablePair{} : pair_of(from, to));
        }
    }
    tables.lines.resize(marks.marks().size() * pictures);
    for (std::size_t marker = 0; marker < marks.markers(); ++marker) {
        for (std::size_t from = 0; from < pictures; ++from) {
            const MarkRange range = marks.of(marker, from);
            for (std::size_t k = range.first; k < range.first + range.count; ++k) {
                for (std::size_t to = 0; to < pictures; ++to) {
                    tables.lines[k * pictures + to] = line_through(
                        tables.pairs[from * pictures + to], tables.mark_x[k], tables.mark_y[k]);
                }
            }
        }
    }
}

}  // namespace

PostureTables posture_tables(const BodyModel& model,
                             const BodyLinks& links,
                             const FrameMarks& marks,
                             const BodyState& reference,
                             Likelihood likelihood,
                             double bound) {
    RAKS_ASSERT(marks.pictures().size() <= PostureTables::kMostPictures);
    PostureTables tables;
    tables.likelihood = likelihood;
    tables.square_bound = static_cast<float>(bound * bound);
    tables.hips = single(reference.hips);
    add_links(model, links, reference, tables);
    for (const LinkedPoint& marker : links.markers) {
        tables.markers.push_back({marker.link, single(marker.place)});
    }
    add_pictures(marks, tables);
    for (std::size_t marker = 0; marker < marks.markers(); ++marker) {
        for (std::size_t picture = 0; picture < marks.pictures().size(); ++picture) {
            tables.ranges.push_back(marks.of(marker, picture));
        }
    }
    for (const Mark& mark : marks.marks()) {
        tables.mark_x.push_back(static_cast<float>(mark.place.x));
        tables.mark_y.push_back(static_cast<float>(mark.place.y));
    }
    if (likelihood == Likelihood::epipolar) {
        add_epipolar(marks, tables);
    }
    return tables;
}

}  // namespace raks::capture
