#include "motion/capture/angles/posture_weigher.hpp"

#include <array>

#include "base/simd_clones.hpp"
#include "motion/capture/angles/posture_tables.hpp"

namespace raks::capture {

namespace {

constexpr std::size_t kMostLinks = 2 * kMostJoints;
constexpr float kLimitCost = 50.0F;      // a radian beyond a limit, squared
constexpr float kNearestDepth = 0.05F;   // metres from the camera
constexpr float kEpipoleRadius = 30.0F;  // pixels around an epipole in which lines say nothing

/// Eight places or vectors.
struct LaneVector {
    Lanes x;
    Lanes y;
    Lanes z;
};

/// Eight rotations as quaternions.
struct LaneTurn {
    Lanes w;
    Lanes x;
    Lanes y;
    Lanes z;
};

/// Eight links in the world.
struct LaneLink {
    LaneTurn turn;
    std::array<Lanes, 9> axes;  // rows of the matrix
    LaneVector place;
};

RAKS_LANES_INLINE Lanes lesser(const Lanes& a, const Lanes& b) { return a < b ? a : b; }
RAKS_LANES_INLINE Lanes greater(const Lanes& a, const Lanes& b) { return a > b ? a : b; }

// The rotation of eight vectors, by the series of cos and sin, which hold beyond half a turn.
RAKS_LANES_INLINE LaneTurn turned(const LaneVector& by) {
    const Lanes h = 0.25F * (by.x * by.x + by.y * by.y + by.z * by.z);
    const Lanes cosine =
        1.0F + h * (-0.5F + h * (1.0F / 24.0F +
                                 h * (-1.0F / 720.0F +
                                      h * (1.0F / 40320.0F +
                                           h * (-1.0F / 3628800.0F + h * (1.0F / 479001600.0F))))));
    const Lanes sine =
        0.5F + h * (-1.0F / 12.0F +
                    h * (1.0F / 240.0F + h * (-1.0F / 10080.0F +
                                              h * (1.0F / 725760.0F + h * (-1.0F / 79833600.0F)))));
    return {cosine, sine * by.x, sine * by.y, sine * by.z};
}

RAKS_LANES_INLINE LaneTurn product(const LaneTurn& a, const LaneTurn& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
            a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

RAKS_LANES_INLINE void set_axes(LaneLink& link) {
    const LaneTurn& q = link.turn;
    const Lanes xx = q.x * q.x;
    const Lanes yy = q.y * q.y;
    const Lanes zz = q.z * q.z;
    const Lanes xy = q.x * q.y;
    const Lanes xz = q.x * q.z;
    const Lanes yz = q.y * q.z;
    const Lanes wx = q.w * q.x;
    const Lanes wy = q.w * q.y;
    const Lanes wz = q.w * q.z;
    link.axes = {1.0F - 2.0F * (yy + zz),
                 2.0F * (xy - wz),
                 2.0F * (xz + wy),
                 2.0F * (xy + wz),
                 1.0F - 2.0F * (xx + zz),
                 2.0F * (yz - wx),
                 2.0F * (xz - wy),
                 2.0F * (yz + wx),
                 1.0F - 2.0F * (xx + yy)};
}

RAKS_LANES_INLINE LaneVector at(const LaneLink& link, const TableVector& local) {
    const auto& m = link.axes;
    return {link.place.x + (m[0] * local[0] + m[1] * local[1] + m[2] * local[2]),
            link.place.y + (m[3] * local[0] + m[4] * local[1] + m[5] * local[2]),
            link.place.z + (m[6] * local[0] + m[7] * local[1] + m[8] * local[2])};
}

// What a joint beyond its limit costs.
RAKS_LANES_INLINE Lanes limit_cost(const TableLink& link,
                                   const Lanes& hinge_change,
                                   const LaneTurn& local) {
    Lanes beyond{};
    if (link.is_hinge) {
        const Lanes angle = link.angle + hinge_change;
        beyond = greater(Lanes{}, greater(link.lowest - angle, angle - link.highest));
    } else {
        const auto& usual = link.usual;
        const Lanes turn =
            usual[0] * local.w + usual[1] * local.x + usual[2] * local.y + usual[3] * local.z;
        const Lanes w = greater(turn, -turn);
        beyond = link.w_to_angle * greater(Lanes{}, link.least_w - w);
    }
    return kLimitCost * beyond * beyond;
}

/// Where eight postures have one marker in a picture.
struct LanePixel {
    Lanes x;
    Lanes y;
};

RAKS_LANES_INLINE LanePixel seen_by(const TablePicture& picture, const LaneVector& place) {
    const Lanes x = picture[0] * place.x + picture[1] * place.y + picture[2] * place.z + picture[9];
    const Lanes y =
        picture[3] * place.x + picture[4] * place.y + picture[5] * place.z + picture[10];
    const Lanes z =
        picture[6] * place.x + picture[7] * place.y + picture[8] * place.z + picture[11];
    const Lanes near = Lanes{} + kNearestDepth;
    const Lanes inverse = 1.0F / greater(z, near);
    return {x * inverse, y * inverse};
}

// A marker's cost in all pictures, by reprojection.
RAKS_LANES_INLINE Lanes reprojection_cost(const PostureTables& tables,
                                          std::size_t marker,
                                          const LaneVector& place) {
    const std::size_t pictures = tables.pictures.size();
    Lanes cost{};
    for (std::size_t i = 0; i < pictures; ++i) {
        const MarkRange range = tables.ranges[marker * pictures + i];
        if (range.count == 0) {
            cost += 1.0F;
            continue;
        }
        const LanePixel pixel = seen_by(tables.pictures[i], place);
        Lanes nearest = Lanes{} + 1e12F;
        for (std::size_t k = range.first; k < range.first + range.count; ++k) {
            const Lanes x = pixel.x - tables.mark_x[k];
            const Lanes y = pixel.y - tables.mark_y[k];
            nearest = lesser(nearest, x * x + y * y);
        }
        cost += nearest / (nearest + tables.square_bound);
    }
    return cost;
}

/// For eight postures the mark that is nearest to a marker, and its place.
struct LaneMarks {
    std::array<std::size_t, kLanes> index;
    Lanes x;
    Lanes y;
};

RAKS_LANES_INLINE LaneMarks nearest_marks(const PostureTables& tables,
                                          const MarkRange& range,
                                          const LanePixel& pixel) {
    Lanes nearest = Lanes{} + 1e12F;
    Lanes which{};
    LaneMarks marks{{}, Lanes{}, Lanes{}};
    for (std::size_t k = 0; k < range.count; ++k) {
        const float mark_x = tables.mark_x[range.first + k];
        const float mark_y = tables.mark_y[range.first + k];
        const Lanes x = pixel.x - mark_x;
        const Lanes y = pixel.y - mark_y;
        const Lanes square = x * x + y * y;
        const auto is_nearer = square < nearest;
        nearest = is_nearer ? square : nearest;
        which = is_nearer ? Lanes{} + static_cast<float>(k) : which;
        marks.x = is_nearer ? Lanes{} + mark_x : marks.x;
        marks.y = is_nearer ? Lanes{} + mark_y : marks.y;
    }
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        marks.index[lane] = range.first + static_cast<std::size_t>(which[lane]);
    }
    return marks;
}

// D^2 of the marks in picture `from` and the pixels in picture `to`.
RAKS_LANES_INLINE Lanes pair_distance(const PostureTables& tables,
                                      std::size_t from,
                                      std::size_t to,
                                      const LaneMarks& marks,
                                      const LanePixel& other) {
    const std::size_t pictures = tables.pictures.size();
    Lanes a{};
    Lanes b{};
    Lanes c{};
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        const TableLine& line = tables.lines[marks.index[lane] * pictures + to];
        a[lane] = line.a;
        b[lane] = line.b;
        c[lane] = line.c;
    }
    const Lanes there = a * other.x + b * other.y + c;
    const std::array<float, 9>& back = tables.pairs[to * pictures + from].lines;
    const Lanes line_x = back[0] * other.x + back[1] * other.y + back[2];
    const Lanes line_y = back[3] * other.x + back[4] * other.y + back[5];
    const Lanes line_z = back[6] * other.x + back[7] * other.y + back[8];
    const Lanes here = line_x * marks.x + line_y * marks.y + line_z;
    const Lanes length = line_x * line_x + line_y * line_y + 1e-20F;
    return there * there + here * here / length;
}

// A marker's cost in all pictures, by epipolar distances.
RAKS_LANES_INLINE Lanes epipolar_cost(const PostureTables& tables,
                                      std::size_t marker,
                                      const LaneVector& place) {
    const std::size_t pictures = tables.pictures.size();
    std::array<LanePixel, PostureTables::kMostPictures> pixels;  // NOLINT: filled below
    for (std::size_t i = 0; i < pictures; ++i) {
        pixels[i] = seen_by(tables.pictures[i], place);
    }
    Lanes cost{};
    for (std::size_t i = 0; i < pictures; ++i) {
        const MarkRange range = tables.ranges[marker * pictures + i];
        if (range.count == 0) {
            cost += 1.0F;
            continue;
        }
        const LaneMarks marks = nearest_marks(tables, range, pixels[i]);
        Lanes sum{};
        Lanes count = Lanes{} + 1e-6F;
        for (std::size_t j = 0; j < pictures; ++j) {
            if (j == i) {
                continue;
            }
            const TablePair& pair = tables.pairs[i * pictures + j];
            const Lanes x = pixels[j].x - pair.epipole_x;
            const Lanes y = pixels[j].y - pair.epipole_y;
            const Lanes apart = x * x + y * y;
            const Lanes counts = apart < kEpipoleRadius * kEpipoleRadius ? Lanes{} : Lanes{} + 1.0F;
            const Lanes square = pair_distance(tables, i, j, marks, pixels[j]);
            sum += counts * (square / (square + tables.square_bound));
            count += counts;
        }
        cost += sum / count;
    }
    return cost;
}

// Places a link and adds what its joint costs.
RAKS_LANES_INLINE void place_link(const TableLink& link,
                                  const float* changes,
                                  std::size_t stride,
                                  LaneLink* placed,
                                  std::size_t index,
                                  Lanes& cost) {
    const float* const change = changes + link.first * stride;
    LaneVector by;
    Lanes hinge_change{};
    if (link.is_hinge) {
        hinge_change = lanes_at(change);
        by = {
            link.axis[0] * hinge_change, link.axis[1] * hinge_change, link.axis[2] * hinge_change};
    } else {
        by = {link.share * lanes_at(change),
              link.share * lanes_at(change + stride),
              link.share * lanes_at(change + 2 * stride)};
    }
    const Lanes zero{};
    const LaneTurn reference{
        zero + link.turn[0], zero + link.turn[1], zero + link.turn[2], zero + link.turn[3]};
    const LaneTurn local = product(reference, turned(by));
    cost += link.share * limit_cost(link, hinge_change, local);
    LaneLink& here = placed[index];
    if (index == 0) {
        here.turn = local;
    } else {
        here.turn = product(placed[link.parent].turn, local);
        here.place = at(placed[link.parent], link.offset);
    }
    set_axes(here);
}

RAKS_SIMD_CLONES void weigh_block(const PostureTables& tables,
                                  const JointGroup& group,
                                  const float* changes,
                                  std::size_t stride,
                                  float* costs) {
    std::array<LaneLink, kMostLinks> placed;  // NOLINT: those that are read are filled below
    placed[0].place = {tables.hips[0] + lanes_at(changes),
                       tables.hips[1] + lanes_at(changes + stride),
                       tables.hips[2] + lanes_at(changes + 2 * stride)};
    Lanes cost{};
    for (const std::size_t i : group.links) {
        place_link(tables.links[i], changes, stride, placed.data(), i, cost);
    }
    for (const std::size_t i : group.markers) {
        const TableMarker& marker = tables.markers[i];
        const LaneVector place = at(placed[marker.link], marker.place);
        cost += tables.likelihood == Likelihood::reprojection ? reprojection_cost(tables, i, place)
                                                              : epipolar_cost(tables, i, place);
    }
    store_lanes(cost, costs);
}

}  // namespace

PostureWeigher::PostureWeigher(const BodyModel& model,
                               const BodyLinks& links,
                               const FrameMarks& marks,
                               const BodyState& reference,
                               Likelihood likelihood,
                               double bound)
    : tables_(std::make_shared<const PostureTables>(
          posture_tables(model, links, marks, reference, likelihood, bound))) {}

void PostureWeigher::weigh(const JointGroup& group,
                           const PostureChanges& changes,
                           std::size_t first,
                           float* costs) const {
    weigh_block(*tables_, group, changes.values.data() + first, changes.stride, costs);
}

}  // namespace raks::capture
