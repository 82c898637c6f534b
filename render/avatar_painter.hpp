#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/body_painter.hpp"
#include "render/model/mannequin_style.hpp"
#include "render/renderer.hpp"
#include "render/surface_painter.hpp"

namespace raks::render {

/// One avatar in the driver's memory: what can be drawn of it. Threads: the context's.
class AvatarPainter {
 public:
    /// Uploads what is painted; `programs` must outlive it.
    AvatarPainter(const Avatar& avatar, const BodyPrograms& programs);
    /// Takes its surface, too.
    void set_surface(LoadedSurface surface, std::shared_ptr<const AvatarRig> rig);
    /// SurfacePainter::warm_up, the figure in a pose. False: no such step.
    [[nodiscard]] bool warm_up(std::size_t step);

    [[nodiscard]] float size() const noexcept { return size_; }
    /// How an outfit colours it.
    [[nodiscard]] MannequinStyle style() const noexcept { return style_; }
    [[nodiscard]] const motion::Skeleton& skeleton() const noexcept { return skeleton_; }
    /// A pose of the body that dances are solved for, on its own.
    [[nodiscard]] motion::Pose own(const motion::Pose& pose) const noexcept;
    [[nodiscard]] BodyPainter& body() noexcept { return body_; }

    /// Takes a dancer; returns its number for the calls below. Its state must stay until they are
    /// done.
    std::size_t take(const Dancer& dancer, View view);
    void draw_solid(std::size_t number, const Scene& scene, BodyPainter::Image image);
    void draw_blended(std::size_t number, const Scene& scene);
    void draw_depth(std::size_t number, const Scene& scene, const glm::mat4& clip_from_light);
    /// Forgets all dancers.
    void begin_picture() noexcept { states_.clear(); }

 private:
    /// A body may have a painted skin, a surface or both; sticks are the painter's own.
    [[nodiscard]] bool shows_surface() const noexcept {
        return surface_.has_value() && view_ == View::skin;
    }
    [[nodiscard]] bool shows_body() const noexcept { return has_skin_ || view_ == View::stick; }
    [[nodiscard]] const RigState* state_of(const Dancer& dancer);
    void prepare(std::size_t number);

    float size_;
    MannequinStyle style_;
    bool has_skin_;
    motion::Skeleton skeleton_;
    float pelvis_drop_;
    BodyPainter body_;
    std::optional<SurfacePainter> surface_;
    std::shared_ptr<const AvatarRig> rig_;  // of the surface
    std::vector<const RigState*> states_;   // of this picture's dancers
    // Of those that bring none; what `states_` points to stays where it is.
    std::vector<std::unique_ptr<RigState>> own_states_;
    View view_ = View::skin;
};

}  // namespace raks::render
