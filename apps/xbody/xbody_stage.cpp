#include "apps/xbody/xbody_stage.hpp"

#include <span>
#include <utility>

#include "engine/show/themes.hpp"

namespace raks::apps {

Expected<XbodyStage> XbodyStage::create(ShownModel model) {
    auto renderer = render::Renderer::create(*model.avatar);
    if (!renderer) {
        return fail(std::move(renderer.error()));
    }
    return XbodyStage(std::move(model), std::move(*renderer));
}

XbodyStage::XbodyStage(ShownModel model, render::Renderer renderer)
    : model_(std::move(model)), renderer_(std::move(renderer)), shown_(model_) {
    scene_.theme = engine::find_theme("studio_light").value_or(scene_.theme);
}

Expected<void> XbodyStage::upload() {
    auto added = renderer_.add(*model_.avatar);
    if (!added) {
        return fail(std::move(added.error()));
    }
    renderer_.remove(std::exchange(handle_, *added));
    return {};
}

Expected<void> XbodyStage::set_look(const ModelLook& look) {
    if (look == look_) {
        return {};
    }
    look_ = look;
    apps::set_look(look, model_);
    shown_ = ShownPose(model_);
    return upload();
}

Expected<void> XbodyStage::stand_by_labels(std::vector<render::BoneLabel> labels) {
    apps::stand_by_labels(std::move(labels), model_);
    if (look_ != ModelLook()) {
        apps::set_look(look_, model_);
    }
    shown_ = ShownPose(model_);
    return upload();
}

void XbodyStage::wear(std::string motion, engine::AvatarClip clip) {
    apps::wear(std::move(motion), std::move(clip), model_);
}

Expected<void> XbodyStage::take_model(ShownModel model) {
    model_ = std::move(model);
    look_ = {};
    shown_ = ShownPose(model_);
    return upload();
}

void XbodyStage::show(std::size_t frame, const PoseTuning& tuning) {
    show_tuned_frame(model_, frame, tuning, shown_);
}

void XbodyStage::draw(const render::Camera& camera,
                      bool is_wireframe,
                      const render::FrameTarget& target) {
    scene_.camera = camera;
    scene_.is_wireframe = is_wireframe;
    const render::Dancer dancer{.avatar = handle_, .pose = shown_.pose, .state = &shown_.state};
    renderer_.draw(scene_, std::span(&dancer, 1), target);
}

}  // namespace raks::apps
