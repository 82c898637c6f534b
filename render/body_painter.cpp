#include "render/body_painter.hpp"
#include "render/avatar/avatar.hpp"

#include <cstddef>
#include <glm/ext/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <utility>
#include <vector>

namespace raks::render {
namespace {

using gl::Attribute;
using gl::Reading;

// Locations as in body.vert; layout as in avatar.hpp. Masks take two attributes: one holds four.
constexpr std::array<Attribute, 7> kSkinAttributes = {{
    {0, 3, GL_FLOAT, Reading::normalized, offsetof(AvatarVertex, position)},
    {1, 3, GL_SHORT, Reading::normalized, offsetof(AvatarVertex, normal)},
    {2, 4, GL_UNSIGNED_BYTE, Reading::raw, offsetof(AvatarVertex, joints)},
    {3, 4, GL_UNSIGNED_BYTE, Reading::normalized, offsetof(AvatarVertex, weights)},
    {4, 4, GL_BYTE, Reading::normalized, offsetof(AvatarVertex, masks)},
    {5, 3, GL_BYTE, Reading::normalized, offsetof(AvatarVertex, masks) + 4},
    {6, 1, GL_UNSIGNED_BYTE, Reading::normalized, offsetof(AvatarVertex, ambient_occlusion)},
}};

/// The avatar's arrays as they are.
gl::Mesh skin_mesh(const Avatar& avatar) {
    return {std::as_bytes(std::span(avatar.vertices)),
            sizeof(AvatarVertex),
            kSkinAttributes,
            avatar.indices};
}

/// A stick figure in the avatar's vertex form, so that one vertex shader serves both: masks
/// "suit" and "stripe" carry the shares of the left's and the right's colour.
gl::Mesh stick_mesh(const Shape<StickVertex>& stick) {
    // Components of unit vectors need no clamping.
    const auto snorm16 = [](float x) { return static_cast<std::int16_t>(x * 32767.0F); };
    std::vector<AvatarVertex> vertices;
    vertices.reserve(stick.vertices.size());
    for (const StickVertex& point : stick.vertices) {
        AvatarVertex& vertex = vertices.emplace_back();
        vertex.position = {point.position.x, point.position.y, point.position.z};
        vertex.normal = {
            snorm16(point.normal.x), snorm16(point.normal.y), snorm16(point.normal.z), 0};
        vertex.joints = {point.bone, 0, 0, 0};
        vertex.weights = {255, 0, 0, 0};
        // Shares 0..255 halved: a mask is a signed byte.
        vertex.masks = {static_cast<std::int8_t>(point.left / 2),
                        static_cast<std::int8_t>(point.right / 2)};
        vertex.ambient_occlusion = point.occlusion;
    }
    return {std::as_bytes(std::span<const AvatarVertex>(vertices)),
            sizeof(AvatarVertex),
            kSkinAttributes,
            stick.indices};
}

/// Skeleton, helpers and inverse bind matrices: what posing needs once the mesh is in the driver.
Avatar without_mesh(const Avatar& avatar) {
    Avatar joints;
    joints.skeleton = avatar.skeleton;
    joints.inverse_bind = avatar.inverse_bind;
    joints.helpers = avatar.helpers;
    return joints;
}

}  // namespace

Expected<BodyPrograms> BodyPrograms::build(Quality quality) {
    static constexpr std::array<std::string_view, 4> kVertex = {
        "frame.glsl", "skin.glsl", "light.glsl", "body.vert"};
    static constexpr std::array<std::string_view, 6> kFragmentHigh = {
        "frame.glsl", "dress.glsl", "light.glsl", "materials.glsl", "shadow.glsl", "body.frag"};
    static constexpr std::array<std::string_view, 4> kFragmentFast = {
        "frame.glsl", "dress.glsl", "materials.glsl", "body.frag"};
    static constexpr std::array<std::string_view, 2> kDepthVertex = {"skin.glsl", "depth.vert"};
    static constexpr std::array<std::string_view, 1> kDepthFragment = {"depth.frag"};

    // The looks are variants of one shader, chosen by a macro: no branch per fragment.
    const auto build_body = [quality](std::string_view name, std::string_view dress) {
        std::vector<std::string_view> defines = {dress};
        std::span<const std::string_view> fragment = kFragmentHigh;
        if (quality == Quality::fast) {
            defines.emplace_back("FAST");
            fragment = kFragmentFast;
        }
        return gl::Program::build({name, kVertex, fragment, defines});
    };
    Expected<gl::Program> dancer = build_body("dancer", "DRESS_DANCER");
    if (!dancer) {
        return fail(std::move(dancer.error()));
    }
    Expected<gl::Program> mannequin = build_body("mannequin", "DRESS_MANNEQUIN");
    if (!mannequin) {
        return fail(std::move(mannequin.error()));
    }
    Expected<gl::Program> stick = build_body("stick figure", "DRESS_STICK");
    if (!stick) {
        return fail(std::move(stick.error()));
    }
    Expected<gl::Program> depth =
        gl::Program::build({"shadow depth", kDepthVertex, kDepthFragment, {}});
    if (!depth) {
        return fail(std::move(depth.error()));
    }
    return BodyPrograms{
        std::move(*dancer), std::move(*mannequin), std::move(*stick), std::move(*depth)};
}

BodyPainter::BodyPainter(const Avatar& avatar, const BodyPrograms& programs)
    : joints_(without_mesh(avatar)),
      skin_(skin_mesh(avatar)),
      stick_(stick_mesh(stick_figure(avatar.skeleton))),
      programs_(&programs) {}

void BodyPainter::set_pose(std::size_t dancer, const motion::Pose& pose, View view) {
    view_ = view;
    figure_.reset();
    std::array<glm::mat4, kPaletteSize> world_from_joint{};
    if (view == View::skin) {
        // The skin's vertices are given in the bind pose: matrices lead from there into the world.
        skinning_palette(joints_, pose, world_from_joint);
    } else {
        // A stick vertex is given in its bone's frame: the bone's own matrix leads into the world.
        const motion::WorldPose world =
            motion::world_pose(joints_.skeleton, with_shoulder_rhythm(pose));
        for (std::size_t i = 0; i < world.positions.size(); ++i) {
            world_from_joint[i] = glm::translate(glm::mat4(1.0F), world.positions[i]) *
                                  glm::mat4_cast(world.rotations[i]);
        }
    }
    upload_bones(dancer, world_from_joint);
}

void BodyPainter::set_recorded_body(const Shape<StickVertex>& in_world) {
    view_ = View::stick;
    figure_.emplace(stick_mesh(in_world));
    std::array<glm::mat4, kPaletteSize> world_from_joint{};
    // The figure's vertices are in the world: one identity for all.
    world_from_joint.fill(glm::mat4(1.0F));
    upload_bones(0, world_from_joint);
}

void BodyPainter::upload_bones(std::size_t dancer,
                               std::span<const glm::mat4, kPaletteSize> world_from_joint) {
    std::array<glm::mat3x4, kPaletteSize> rows{};  // three rows a joint, as skin.glsl reads them
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i] = glm::mat3x4(glm::transpose(world_from_joint[i]));
    }
    // The fourth row of these matrices is constant: three rows for each of 66 joints.
    static_assert(sizeof(rows) == 198 * sizeof(glm::vec4));
    while (bones_.size() <= dancer) {
        bones_.emplace_back();
    }
    glBindBuffer(GL_UNIFORM_BUFFER, bones_[dancer].name());
    glBufferData(GL_UNIFORM_BUFFER, sizeof(rows), rows.data(), GL_STREAM_DRAW);
}

const gl::Mesh& BodyPainter::mesh() const noexcept {
    if (figure_) {
        return *figure_;
    }
    return view_ == View::skin ? skin_ : stick_;
}

void BodyPainter::draw(std::size_t dancer, Dress dress, Image image) const noexcept {
    const gl::Program& skin_program =
        dress == Dress::dancer ? programs_->dancer : programs_->mannequin;
    const gl::Program& program = view_ == View::stick ? programs_->stick : skin_program;
    program.use();
    // The shader multiplies the height by it: -1 mirrors at the floor.
    glUniform1f(program.uniform("mirror"), image == Image::upright ? 1.0F : -1.0F);
    glBindBufferBase(GL_UNIFORM_BUFFER, gl::kBonesBinding, bones_[dancer].name());
    mesh().draw();
}

void BodyPainter::draw_depth(std::size_t dancer, const glm::mat4& clip_from_light) const noexcept {
    programs_->depth.use();
    glUniformMatrix4fv(
        programs_->depth.uniform("clip_from_light"), 1, GL_FALSE, &clip_from_light[0][0]);
    glBindBufferBase(GL_UNIFORM_BUFFER, gl::kBonesBinding, bones_[dancer].name());
    mesh().draw();
}

}  // namespace raks::render
