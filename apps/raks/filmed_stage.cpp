#include "apps/raks/filmed_stage.hpp"

#include <algorithm>
#include <utility>

#include "motion/skeleton/skeleton.hpp"

namespace raks::apps {
namespace {

bool wear_the_same(const engine::DancerBodies& one, const engine::DancerBodies& other) {
    const auto& a = one.wardrobe();
    const auto& b = other.wardrobe();
    return std::equal(
        a.begin(), a.end(), b.begin(), b.end(), [](const auto& builds, const auto& others) {
            return std::equal(builds.begin(),
                              builds.end(),
                              others.begin(),
                              others.end(),
                              [](const auto& body, const auto& another) {
                                  return body.handle.number == another.handle.number &&
                                         body.avatar == another.avatar;
                              });
        });
}

}  // namespace

void follow_stage(engine::Staging& staging, const engine::StageState& stage) {
    const HopIndex newest = stage.music.hop;
    const HopIndex oldest = newest - static_cast<HopIndex>(engine::StageState::kRecent) + 1;
    const HopIndex last = staging.last_hop().value_or(-1);
    for (HopIndex hop = std::max({last + 1, oldest, HopIndex{0}}); hop <= newest; ++hop) {
        if (const MusicState* const state = stage.state_of(hop)) {
            staging.advance(*state, std::span(stage.tracks).first(stage.dancers));
        }
    }
}

engine::ShownMoment shown_moment(const engine::StageState& stage, StreamTime moment) {
    return {stage.music,
            stage.dancer,
            {.tracks = std::span(stage.tracks).first(stage.dancers),
             .places = std::span(stage.places).first(stage.dancers),
             .moment = moment}};
}

FilmedStage::FilmedStage(const engine::Settings& settings, engine::PictureSize size)
    : size_(size),
      staging_(static_cast<std::uint64_t>(settings.seed),
               settings.calm ? render::Liveliness::calm : render::Liveliness::usual),
      rgba_(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height) * 4) {}

Expected<void> FilmedStage::make_target(int samples) {
    if (!target_) {
        auto made = render::OffscreenTarget::create(
            {.width = size_.width, .height = size_.height, .samples = samples});
        if (!made) {
            return fail(made.error());
        }
        target_.emplace(std::move(*made));
    }
    return {};
}

engine::DancerBodies& FilmedStage::bodies_as(const engine::DancerBodies& shown) {
    if (!bodies_ || !wear_the_same(*bodies_, shown)) {
        bodies_.emplace(shown.wardrobe(), motion::mannequin_skeleton(), shown.habits());
    }
    return *bodies_;
}

Expected<void> FilmedStage::draw(const engine::StageState& stage,
                                 StreamTime moment,
                                 const engine::WindowView& view,
                                 const Describe& describe) {
    if (auto made = make_target(view.drawing.renderer.samples()); !made) {
        return made;
    }
    engine::DancerBodies& bodies = bodies_as(view.drawing.bodies);
    const render::FrameTarget frame = target_->frame();
    const engine::ShownMoment danced = shown_moment(stage, moment);
    const engine::ShownMoment shown =
        view.performance != nullptr ? view.performance->at(danced) : danced;
    render::Scene scene = view.scene;
    engine::CameraChoice choice = view.camera;
    staging_.set_picture(static_cast<float>(frame.width) / static_cast<float>(frame.height),
                         bodies.size());
    follow_stage(staging_, stage);
    if (const auto camera =
            view.performance != nullptr ? view.performance->camera(bodies.size()) : std::nullopt) {
        scene.camera = *camera;
        choice.is_held = true;
    }
    staging_.set(scene, choice, {.time = moment}, shown.danced.tracks);
    engine::draw_moment(shown, view.drawing.renderer, bodies, scene, frame);
    if (describe) {
        render::OverlayState info;
        describe(shown, info);
        constexpr float kOrdinaryMonitor = 1.0F;
        view.drawing.overlay.draw(info, render::OverlayView::shown, frame, kOrdinaryMonitor);
    }
    target_->begin_reading();
    return {};
}

bool FilmedStage::copy_to(const render::FrameTarget& target) {
    if (!target_ || target.width != size_.width || target.height != size_.height) {
        return false;
    }
    target_->copy_to(target);
    return true;
}

Expected<std::span<const std::uint8_t>> FilmedStage::picture() {
    if (auto read = target_->finish_reading(rgba_); !read) {
        return fail(read.error());
    }
    return rgba_;
}

}  // namespace raks::apps
