#pragma once

#include <array>
#include <optional>
#include <span>

#include "base/expected.hpp"
#include "render/avatar/avatar.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/program.hpp"
#include "render/renderer.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/mat4x4.hpp>

namespace raks::render {

/// One avatar in the driver's memory, as skin and as stick figure. Sets no state but program,
/// vertex array and the binding of its bones; the frame's uniform block must be bound.
/// Threads: the context's.
class BodyPainter {
 public:
    /// Uploads the avatar and builds the programs; keeps no reference to it. `quality` is fast or
    /// high. Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<BodyPainter> create(const Avatar& avatar, Quality quality);

    /// Computes and uploads the joint matrices for everything drawn until the next call.
    void set_pose(const motion::Pose& pose, View view) noexcept;

    /// Draws this figure in place of the avatar until the next `set_pose`: its vertices are in
    /// world space and all of bone 0.
    void set_figure(const Shape<StickVertex>& in_world);

    /// Body, or its image in the floor.
    enum class Image { upright, mirrored };
    /// Draws the body; for `mirrored` the caller reverses the front face's winding.
    void draw(Dress dress, Image image) const noexcept;

    /// Depth alone, for the shadow map.
    void draw_depth(const glm::mat4& clip_from_light) const noexcept;

 private:
    struct Programs {
        gl::Program dancer;
        gl::Program mannequin;
        gl::Program stick;
        gl::Program depth;
    };
    BodyPainter(const Avatar& avatar, Programs programs);
    [[nodiscard]] static Expected<Programs> build_programs(Quality quality);
    [[nodiscard]] const gl::Mesh& mesh() const noexcept;
    void upload_bones(std::span<const glm::mat4, kPaletteSize> world_from_joint) noexcept;

    Avatar joints_;  // without its vertices and triangles
    gl::Mesh skin_;
    gl::Mesh stick_;
    std::optional<gl::Mesh> figure_;  // shown instead, where there is one
    gl::Buffer bones_;
    Programs programs_;
    View view_ = View::skin;
};

}  // namespace raks::render
