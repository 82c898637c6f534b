#include "render/mannequin/face_mesh.hpp"

#include <cmath>
#include <cstddef>
#include <vector>

#include "render/mannequin/face_shape.hpp"
#include "render/mannequin/face_sheets.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

/// Brings points of sheets onto the skin.
class FaceSkin {
 public:
    explicit FaceSkin(const BodyField& field) noexcept : field_(field) {}

    /// On the left half; mirrored where x is below 0, so that both sides have the same bits.
    [[nodiscard]] PaintedPoint place(const FacePoint& point) const noexcept {
        const float side = point.x < 0.0F ? -1.0F : 1.0F;
        glm::vec3 at{std::abs(point.x), point.y, kFrom};
        // From the front to the skin, in steps that the field's slope allows.
        for (int i = 0; i < kSteps; ++i) {
            at.z -= 0.8F * field_.core(at);
        }
        glm::vec3 normal = glm::normalize(field_.gradient(at, kNormalStep));
        if (at.x == 0.0F) {
            normal = glm::normalize(glm::vec3(0.0F, normal.y, normal.z));
        }
        at += point.off * normal;
        PaintedPoint placed{.paint = point.paint, .tint = point.tint};
        placed.position = {side * at.x, at.y, at.z};
        placed.normal = {side * normal.x, normal.y, normal.z};
        return placed;
    }

 private:
    static constexpr float kFrom = 0.13F;  // before the nose
    static constexpr int kSteps = 24;
    static constexpr float kNormalStep = 0.0040F;

    const BodyField& field_;
};

/// Points of a sheet on its side of the face.
std::vector<PaintedPoint> placed(const FaceSkin& skin, const Sheet& sheet) {
    std::vector<PaintedPoint> points;
    points.reserve(sheet.points.size());
    for (const FacePoint& point : sheet.points) {
        PaintedPoint& made = points.emplace_back(skin.place(point));
        if (sheet.is_right) {
            made.position.x = -made.position.x;
            made.normal.x = -made.normal.x;
        }
    }
    return points;
}

void connect(const Sheet& sheet, std::uint32_t first, PaintedMesh& mesh) {
    // Discs run outward and counter-clockwise, the others down and to +x.
    mesh.connect({.first = first,
                  .rows = sheet.rows,
                  .columns = sheet.columns,
                  .is_turned = sheet.is_right,
                  .is_ring = sheet.is_disc});
}

/// What a shape moves against the face at rest.
MorphTarget target_of(const FaceSkin& skin,
                      const FaceShape& shape,
                      MannequinBuild build,
                      const std::vector<Sheet>& at_rest,
                      std::uint32_t first,
                      const PaintedMesh& mesh) {
    MorphTarget target;
    const std::vector<Sheet> sheets = face_sheets(shape, build);
    std::uint32_t number = first;
    for (std::size_t s = 0; s < sheets.size(); ++s) {
        for (std::size_t i = 0; i < sheets[s].points.size(); ++i, ++number) {
            const FacePoint& moved = sheets[s].points[i];
            const FacePoint& rest = at_rest[s].points[i];
            if (moved.x == rest.x && moved.y == rest.y) {
                continue;
            }
            Sheet one{.rows = 1, .columns = 1, .points = {moved}, .is_right = sheets[s].is_right};
            const PaintedPoint point = placed(skin, one).front();
            target.vertices.push_back(number);
            target.positions.push_back(point.position - mesh.primitive().positions[number]);
            target.normals.push_back(point.normal - mesh.primitive().normals[number]);
        }
    }
    return target;
}

}  // namespace

glm::vec3 face_eyes() noexcept { return {0.0F, kEyeHeight, 0.07F}; }

std::vector<MorphTarget> add_face(const BodyField& field,
                                  MannequinBuild build,
                                  std::uint16_t head,
                                  PaintedMesh& mesh) {
    const FaceSkin skin(field);
    const std::vector<Sheet> rest = face_sheets({}, build);
    const std::uint32_t first = mesh.size();
    for (const Sheet& sheet : rest) {
        const std::uint32_t begin = mesh.size();
        for (PaintedPoint& point : placed(skin, sheet)) {
            point.joints = {head, 0, 0, 0};
            mesh.add(point);
        }
        connect(sheet, begin, mesh);
    }
    std::vector<MorphTarget> targets;
    for (std::size_t i = 0; i < kFaceExpressionCount; ++i) {
        const FaceShape shape = face_shape(static_cast<FaceExpression>(i));
        targets.push_back(target_of(skin, shape, build, rest, first, mesh));
    }
    return targets;
}

}  // namespace raks::render
