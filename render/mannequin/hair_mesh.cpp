#include "render/mannequin/hair_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/smooth_steps.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

// All lengths in metres, in the T-pose.
constexpr glm::vec3 kSkull{0.0F, 1.6180F, -0.0080F};  // from here the shell is seen
constexpr std::uint32_t kHairColumns = 44;
constexpr std::uint32_t kHairRows = 10;
constexpr float kFullTurn = glm::radians(360.0F);

constexpr std::array kTail = {
    glm::vec3{0.0F, 1.6640F, -0.1000F},
    glm::vec3{0.0F, 1.6790F, -0.1380F},
    glm::vec3{0.0F, 1.6500F, -0.1740F},
    glm::vec3{0.0F, 1.5940F, -0.1880F},
    glm::vec3{0.0F, 1.5280F, -0.1860F},
    glm::vec3{0.0F, 1.4650F, -0.1760F},
    glm::vec3{0.0F, 1.4000F, -0.1640F},
};

/// How a shell is cut, by the direction `side` from the front (0) over the ears (0.5) to the back
/// (1).
struct Cut {
    float edge;   // angle of its lower edge from straight up, radians
    float thick;  // over the skull at its fullest
};

float blend(float a, float b, float t) noexcept { return a + (b - a) * t; }

/// The hairline: high over the forehead, down before the ears, to the nape.
Cut cut_of(HairStyle style, float side) noexcept {
    const float temple = smoothstep(0.10F, 0.36F, side);
    const float behind = smoothstep(0.52F, 0.80F, side);
    if (style == HairStyle::cropped) {
        const float edge = blend(blend(47.0F, 92.0F, temple), 128.0F, behind);
        const float front = 1.0F - smoothstep(0.05F, 0.40F, side);
        return {glm::radians(edge), blend(0.0120F, 0.0250F, front)};
    }
    const float edge = blend(blend(49.0F, 122.0F, temple), 130.0F, behind);
    return {glm::radians(edge), blend(0.0120F, 0.0200F, smoothstep(0.3F, 0.9F, side))};
}

/// Share of the fullest thickness, `down` from the crown (0) to the edge (1).
float fullness(HairStyle style, float side, float down) noexcept {
    const float edge = 1.0F - smoothstep(0.72F, 1.0F, down);
    if (style == HairStyle::cropped) {
        // Full over the forehead, shaved close at sides and nape.
        const float front = 1.0F - smoothstep(0.10F, 0.35F, side);
        const float close = smoothstep(0.45F, 0.70F, down) * (1.0F - front);
        const float lift = 0.55F + 0.75F * front * smoothstep(0.2F, 0.85F, down);
        return blend(lift * blend(1.0F, edge, 1.0F - 0.6F * front), 0.22F, close);
    }
    return 0.30F + 0.70F * edge;
}

/// Skin of the head seen from inside the skull: how far it is in a direction of the left half.
float skull_radius(const BodyField& field, glm::vec3 direction) noexcept {
    direction.x = std::abs(direction.x);
    float away = 0.20F;
    for (int i = 0; i < 20; ++i) {
        away -= 0.8F * field.core(kSkull + away * direction);
    }
    return away;
}

/// A shell in rows from the crown to the edge, which turns in to the skin.
class Shell {
 public:
    Shell(const BodyField& field, HairStyle style, std::uint16_t head, PaintedMesh& mesh)
        : field_(field), style_(style), head_(head), mesh_(mesh) {}

    void add() {
        const std::uint32_t first = mesh_.size();
        for (std::uint32_t row = 0; row <= kHairRows; ++row) {
            for (std::uint32_t i = 0; i < kHairColumns; ++i) {
                add_point(row, i);
            }
        }
        // Seen from above the azimuth runs from the front over the left: to +x, counter-clockwise.
        mesh_.connect(
            {.first = first, .rows = kHairRows + 1, .columns = kHairColumns, .is_ring = true});
    }

 private:
    // Mirror images have the same numbers: `i` counts to the back on both sides.
    static float side_of(std::uint32_t i) noexcept {
        const std::uint32_t half = std::min(i, kHairColumns - i);
        return 2.0F * static_cast<float>(half) / static_cast<float>(kHairColumns);
    }

    [[nodiscard]] glm::vec3 place(float down, float side, float sign, float lift) const noexcept {
        const Cut cut = cut_of(style_, side);
        const float polar = down * cut.edge;
        const float azimuth = 0.5F * kFullTurn * side;
        const glm::vec3 direction{std::sin(polar) * std::sin(azimuth),
                                  std::cos(polar),
                                  std::sin(polar) * std::cos(azimuth)};
        // Strands: waves across, which die out towards the crown.
        const float wave =
            std::cos(kFullTurn * 11.0F * side) * 0.0012F * smoothstep(0.15F, 0.6F, down);
        // At the crown all directions meet.
        constexpr float kCrown = 0.0150F;
        const float off_crown = smoothstep(0.0F, 0.35F, down);
        const float thick =
            kCrown + off_crown * (cut.thick * fullness(style_, side, down) - kCrown) + wave;
        const float away = skull_radius(field_, direction) + lift * thick;
        glm::vec3 at = kSkull + away * direction;
        at.x *= sign;
        return at;
    }

    void add_point(std::uint32_t row, std::uint32_t i) {
        const float side = side_of(i);
        const float sign = i <= kHairColumns / 2 ? 1.0F : -1.0F;
        const bool is_inner = row == kHairRows;  // the edge, turned in
        const float down = is_inner ? 1.0F : static_cast<float>(row) / (kHairRows - 1);
        PaintedPoint point{.paint = Paint::hair};
        point.position = place(down, side, sign, is_inner ? -0.25F : 1.0F);
        point.normal = normal_at(down, side, sign);
        const float strand = 0.5F + 0.5F * std::cos(kFullTurn * 11.0F * side);
        const float streak = 0.5F + 0.5F * std::cos(kFullTurn * 29.0F * side + 9.0F * down);
        point.tint =
            glm::vec3(0.80F + 0.30F * strand * smoothstep(0.1F, 0.5F, down) + 0.16F * streak);
        point.open = is_inner ? 0.35F : 0.8F + 0.2F * (1.0F - down);
        point.joints = {head_, 0, 0, 0};
        mesh_.add(point);
    }

    [[nodiscard]] glm::vec3 normal_at(float down, float side, float sign) const noexcept {
        constexpr float kStep = 0.02F;
        const float inner = std::max(down, kStep);
        const glm::vec3 along =
            place(inner + kStep, side, 1.0F, 1.0F) - place(inner - kStep, side, 1.0F, 1.0F);
        const float low = std::max(side - kStep, 0.0F);
        const float high = std::min(side + kStep, 1.0F);
        glm::vec3 around = place(inner, high, 1.0F, 1.0F) - place(inner, low, 1.0F, 1.0F);
        // In the middle both halves meet: there the shell runs straight across.
        if (side == 0.0F || side == 1.0F) {
            around = {side == 0.0F ? 1.0F : -1.0F, 0.0F, 0.0F};
        }
        glm::vec3 normal = glm::normalize(glm::cross(along, around));
        if (down == 0.0F) {
            normal = {0.0F, 1.0F, 0.0F};
        }
        return {sign * normal.x, normal.y, normal.z};
    }

    const BodyField& field_;
    HairStyle style_;
    std::uint16_t head_;
    PaintedMesh& mesh_;
};

/// A lock: a tapered tube along a line of places.
struct Lock {
    std::span<const glm::vec3> line;
    std::span<const std::uint16_t> joints;  ///< one a place
    float wide = 0.01F;                     ///< half axes at its fullest
    float deep = 0.005F;
    float start = 0.3F;  ///< share of the fullest at the root
    float fullest = 0.4F;
    glm::vec3 across{1.0F, 0.0F, 0.0F};  ///< direction of `wide`
    bool is_right = false;
    Paint paint = Paint::hair;
};

/// Point and direction of a smooth line (Catmull-Rom) at t in 0..1.
glm::vec3 line_at(std::span<const glm::vec3> line, float t) noexcept {
    const float scaled = t * static_cast<float>(line.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(scaled), line.size() - 2);
    const float u = scaled - static_cast<float>(i);
    const glm::vec3 p1 = line[i];
    const glm::vec3 p2 = line[i + 1];
    const glm::vec3 p0 = i > 0 ? line[i - 1] : p1 + (p1 - p2);
    const glm::vec3 p3 = i + 2 < line.size() ? line[i + 2] : p2 + (p2 - p1);
    return 0.5F * (2.0F * p1 + u * (p2 - p0) + u * u * (2.0F * p0 - 5.0F * p1 + 4.0F * p2 - p3) +
                   u * u * u * (3.0F * p1 - p0 - 3.0F * p2 + p3));
}

/// Joints of a point at t: the place before it and the one behind it.
void set_weights(const Lock& lock, float t, PaintedPoint& point) noexcept {
    const float scaled = t * static_cast<float>(lock.joints.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(scaled), lock.joints.size() - 1);
    const auto next = std::min(i + 1, lock.joints.size() - 1);
    const float share = smoothstep(0.5F, 1.0F, scaled - static_cast<float>(i));
    point.joints = {lock.joints[i], lock.joints[next], 0, 0};
    point.weights = {1.0F - share, share, 0.0F, 0.0F};
}

float girth_of(const Lock& lock, float t) noexcept {
    if (t < lock.fullest) {
        return lock.start + (1.0F - lock.start) * smoothstep(0.0F, 1.0F, t / lock.fullest);
    }
    const float rest = (t - lock.fullest) / (1.0F - lock.fullest);
    return std::sqrt(std::max(1.0F - rest * rest, 0.0F)) * (1.0F - 0.25F * rest) + 0.02F;
}

void add_lock(const Lock& lock, std::uint32_t rows, std::uint32_t columns, PaintedMesh& mesh) {
    const std::uint32_t first = mesh.size();
    for (std::uint32_t row = 0; row < rows; ++row) {
        const float t = static_cast<float>(row) / static_cast<float>(rows - 1);
        constexpr float kStep = 0.02F;
        const glm::vec3 at = line_at(lock.line, t);
        const glm::vec3 along = glm::normalize(line_at(lock.line, std::min(t + kStep, 1.0F)) -
                                               line_at(lock.line, std::max(t - kStep, 0.0F)));
        const glm::vec3 out = glm::normalize(glm::cross(along, lock.across));
        const glm::vec3 across = glm::cross(out, along);
        const float girth = girth_of(lock, t);
        for (std::uint32_t column = 0; column < columns; ++column) {
            const float angle =
                kFullTurn * static_cast<float>(column) / static_cast<float>(columns);
            const float ripple = 1.0F + 0.10F * std::cos(3.0F * angle);
            const glm::vec3 off =
                ripple * girth *
                (lock.wide * std::cos(angle) * across + lock.deep * std::sin(angle) * out);
            const glm::vec3 normal = glm::normalize(std::cos(angle) / lock.wide * across +
                                                    std::sin(angle) / lock.deep * out);
            const float side = lock.is_right ? -1.0F : 1.0F;
            PaintedPoint point{.paint = lock.paint};
            point.position = at + off;
            point.normal = normal;
            point.position.x *= side;
            point.normal.x *= side;
            point.tint = glm::vec3(0.84F + 0.26F * std::cos(3.0F * angle) + 0.15F * t);
            point.open = 0.75F + 0.25F * t;
            set_weights(lock, t, point);
            mesh.add(point);
        }
    }
    mesh.connect({.first = first,
                  .rows = rows,
                  .columns = columns,
                  .is_turned = !lock.is_right,
                  .is_ring = true});
}

// Locks beside the face, left: from the parting over the temple to the cheek.
constexpr std::array kFringe = {glm::vec3{0.0060F, 1.6890F, 0.0660F},
                                glm::vec3{0.0300F, 1.6790F, 0.0820F},
                                glm::vec3{0.0560F, 1.6480F, 0.0740F},
                                glm::vec3{0.0730F, 1.6120F, 0.0540F},
                                glm::vec3{0.0780F, 1.5780F, 0.0420F}};
constexpr std::array kFringeInner = {glm::vec3{0.0050F, 1.6890F, 0.0680F},
                                     glm::vec3{0.0200F, 1.6800F, 0.0870F},
                                     glm::vec3{0.0420F, 1.6560F, 0.0860F},
                                     glm::vec3{0.0600F, 1.6300F, 0.0730F}};
constexpr std::array kSideLock = {glm::vec3{0.0690F, 1.6450F, 0.0330F},
                                  glm::vec3{0.0800F, 1.6050F, 0.0300F},
                                  glm::vec3{0.0800F, 1.5600F, 0.0270F},
                                  glm::vec3{0.0740F, 1.5180F, 0.0290F}};
// Swept up over the forehead and back, left half.
constexpr std::array kQuiffInner = {glm::vec3{0.0085F, 1.6720F, 0.0720F},
                                    glm::vec3{0.0110F, 1.6990F, 0.0800F},
                                    glm::vec3{0.0130F, 1.7160F, 0.0500F},
                                    glm::vec3{0.0150F, 1.7215F, 0.0050F},
                                    glm::vec3{0.0170F, 1.7140F, -0.0350F}};
constexpr std::array kQuiffMiddle = {glm::vec3{0.0300F, 1.6680F, 0.0640F},
                                     glm::vec3{0.0340F, 1.6930F, 0.0700F},
                                     glm::vec3{0.0370F, 1.7080F, 0.0420F},
                                     glm::vec3{0.0390F, 1.7125F, 0.0F},
                                     glm::vec3{0.0380F, 1.7040F, -0.0380F}};
constexpr std::array kQuiffOuter = {glm::vec3{0.0500F, 1.6570F, 0.0500F},
                                    glm::vec3{0.0560F, 1.6800F, 0.0520F},
                                    glm::vec3{0.0600F, 1.6925F, 0.0280F},
                                    glm::vec3{0.0610F, 1.6950F, -0.0080F},
                                    glm::vec3{0.0570F, 1.6880F, -0.0380F}};

void add_both_sides(Lock lock, std::uint32_t rows, std::uint32_t columns, PaintedMesh& mesh) {
    for (const bool is_right : {false, true}) {
        lock.is_right = is_right;
        add_lock(lock, rows, columns, mesh);
    }
}

void add_ponytail(std::uint16_t head, std::span<const std::uint16_t> tail, PaintedMesh& mesh) {
    const std::array heads = {head, head, head, head, head};
    const auto on_head = [&](std::span<const glm::vec3> line) {
        return std::span(heads).first(line.size());
    };
    add_both_sides({.line = kFringe,
                    .joints = on_head(kFringe),
                    .wide = 0.0125F,
                    .deep = 0.0055F,
                    .start = 0.55F,
                    .across = {0.55F, 0.60F, 0.58F}},
                   9,
                   6,
                   mesh);
    add_both_sides({.line = kFringeInner,
                    .joints = on_head(kFringeInner),
                    .wide = 0.0085F,
                    .deep = 0.0045F,
                    .start = 0.6F,
                    .across = {0.45F, 0.75F, 0.48F}},
                   7,
                   6,
                   mesh);
    add_both_sides({.line = kSideLock,
                    .joints = on_head(kSideLock),
                    .wide = 0.0095F,
                    .deep = 0.0050F,
                    .start = 0.6F,
                    .across = {0.10F, 0.0F, 1.0F}},
                   7,
                   6,
                   mesh);
    // The ribbon that ties it.
    constexpr std::array kRibbon = {glm::vec3{0.0F, 1.6730F, -0.1160F},
                                    glm::vec3{0.0F, 1.6775F, -0.1290F},
                                    glm::vec3{0.0F, 1.6760F, -0.1420F}};
    add_lock({.line = kRibbon,
              .joints = on_head(kRibbon),
              .wide = 0.0245F,
              .deep = 0.0225F,
              .start = 0.80F,
              .fullest = 0.5F,
              .paint = Paint::trim},
             4,
             10,
             mesh);
    add_lock({.line = kTail,
              .joints = tail,
              .wide = 0.0330F,
              .deep = 0.0290F,
              .start = 0.52F,
              .fullest = 0.36F},
             14,
             12,
             mesh);
}

void add_quiff(std::uint16_t head, PaintedMesh& mesh) {
    struct Part {
        std::span<const glm::vec3> line;
        glm::vec3 across;
    };
    const std::array parts = {Part{kQuiffInner, {1.0F, -0.08F, 0.0F}},
                              Part{kQuiffMiddle, {0.95F, -0.30F, 0.0F}},
                              Part{kQuiffOuter, {0.80F, -0.60F, 0.0F}}};
    const std::array heads = {head, head, head, head, head};
    for (const Part& part : parts) {
        add_both_sides({.line = part.line,
                        .joints = heads,
                        .wide = 0.0135F,
                        .deep = 0.0085F,
                        .start = 0.72F,
                        .fullest = 0.3F,
                        .across = glm::normalize(part.across)},
                       9,
                       6,
                       mesh);
    }
}

}  // namespace

std::span<const glm::vec3> hair_tail(HairStyle style) noexcept {
    return style == HairStyle::ponytail ? std::span<const glm::vec3>(kTail)
                                        : std::span<const glm::vec3>();
}

void add_hair(const BodyField& field,
              HairStyle style,
              std::uint16_t head,
              std::span<const std::uint16_t> tail,
              PaintedMesh& mesh) {
    Shell(field, style, head, mesh).add();
    if (style == HairStyle::ponytail) {
        add_ponytail(head, tail, mesh);
    } else {
        add_quiff(head, mesh);
    }
}

}  // namespace raks::render
