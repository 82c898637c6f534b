#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "base/expected.hpp"
#include "render/avatar/avatar.hpp"
#include "render/gl/mesh.hpp"
#include "render/gl/shader_program.hpp"
#include "render/renderer.hpp"
#include "render/scene/stick_figure.hpp"

#include <glm/mat4x4.hpp>

namespace raks::render {

/// The programs that draw painted bodies and stick figures: one set a renderer.
struct BodyPrograms {
    gl::Program dancer;
    gl::Program mannequin;
    gl::Program stick;
    gl::Program depth;

    /// `quality` is fast or high. Errors: a shader that the driver refuses.
    [[nodiscard]] static Expected<BodyPrograms> build(Quality quality);
};

/// One avatar's painted skin and its stick figure in the driver's memory. Dancers of this avatar
/// have numbers from 0 on. Sets no state but program, vertex array and the binding of its bones;
/// the frame's uniform blocks must be bound. Threads: the context's.
class BodyPainter {
 public:
    /// Uploads the avatar; keeps no reference to it. `programs` must outlive it.
    BodyPainter(const Avatar& avatar, const BodyPrograms& programs);

    /// Computes and uploads the joint matrices of a dancer.
    void set_pose(std::size_t dancer, const motion::Pose& pose, View view);

    /// Draws this figure in place of the avatar, as dancer 0, until its next `set_pose`: its
    /// vertices are in world space and all of bone 0.
    void set_recorded_body(const Shape<StickVertex>& in_world);

    /// Body, or its image in the floor.
    enum class Image { upright, mirrored };
    /// Draws a dancer; for `mirrored` the caller reverses the front face's winding.
    void draw(std::size_t dancer, Dress dress, Image image) const noexcept;

    /// Depth alone, for the shadow map.
    void draw_depth(std::size_t dancer, const glm::mat4& clip_from_light) const noexcept;

 private:
    [[nodiscard]] const gl::Mesh& mesh() const noexcept;
    void upload_bones(std::size_t dancer,
                      std::span<const glm::mat4, kPaletteSize> world_from_joint);

    Avatar joints_;  // without its vertices and triangles
    gl::Mesh skin_;
    gl::Mesh stick_;
    std::optional<gl::Mesh> figure_;  // shown instead, where there is one
    std::vector<gl::Buffer> bones_;   // by dancer
    const BodyPrograms* programs_;
    View view_ = View::skin;
};

}  // namespace raks::render
