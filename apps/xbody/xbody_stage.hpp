// Xbody stage: a model with what draws it, in a window or a film.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "apps/xbody/model_look.hpp"
#include "apps/xbody/pose_tuning.hpp"
#include "apps/xbody/shown_model.hpp"
#include "base/expected.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

namespace raks::apps {

/// One model on the studio's floor. Threads: the one of the OpenGL context, which must be current.
class XbodyStage {
 public:
    /// Errors: those of Renderer.
    [[nodiscard]] static Expected<XbodyStage> create(ShownModel model);

    [[nodiscard]] const ShownModel& model() const noexcept { return model_; }
    [[nodiscard]] const ShownPose& shown() const noexcept { return shown_; }
    /// A pixel, that a target should have.
    [[nodiscard]] int samples() const noexcept { return renderer_.samples(); }
    /// Fast or high.
    [[nodiscard]] render::Quality quality() const noexcept { return renderer_.quality(); }

    /// Draws it so from now on. Errors: a shader that the driver refuses; it is drawn as before.
    [[nodiscard]] Expected<void> set_look(const ModelLook& look);
    /// As apps::stand_by_labels; the look stays. Errors: as set_look.
    [[nodiscard]] Expected<void> stand_by_labels(std::vector<render::BoneLabel> labels);
    /// As apps::wear.
    void wear(std::string motion, engine::AvatarClip clip);
    /// Another model, as it looks itself. Errors: as set_look.
    [[nodiscard]] Expected<void> take_model(ShownModel model);

    /// Goes to a frame.
    void show(std::size_t frame, const PoseTuning& tuning);
    /// Draws it into a target.
    void draw(const render::Camera& camera, bool is_wireframe, const render::FrameTarget& target);

 private:
    XbodyStage(ShownModel model, render::Renderer renderer);
    Expected<void> upload();

    ShownModel model_;
    render::Renderer renderer_;
    render::AvatarHandle handle_;
    ModelLook look_;
    ShownPose shown_;
    render::Scene scene_;
};

}  // namespace raks::apps
