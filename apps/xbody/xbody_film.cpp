#include "apps/xbody/xbody_film.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "render/gl/offscreen.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

bool is_picture(const XbodyFilmPlan& plan) { return plan.output.extension() == ".png"; }

engine::ClipFilmPlan film_plan(const XbodyFilmPlan& plan) {
    return {.output = plan.output,
            .size = plan.size,
            .shown = {},
            .quality = render::VideoQuality::high};
}

engine::FilmedFrames frames_of(const XbodyFilmPlan& plan, const ShownModel& model) {
    engine::FilmedFrames shown =
        engine::filmed_frames(model.frame_count(), model.rate(), plan.rate);
    if (plan.frame || is_picture(plan)) {
        shown.frames = {plan.frame.value_or(0)};
    }
    return shown;
}

// One that has the model in all of these frames: of many some, evenly, with the last.
render::Camera camera_for(const std::vector<std::size_t>& frames,
                          const XbodyFilmPlan& plan,
                          const ShownModel& model) {
    constexpr std::size_t kLooks = 60;
    const float aspect = static_cast<float>(plan.size.width) / static_cast<float>(plan.size.height);
    ShownPose shown(model);
    std::vector<glm::vec3> points;
    const std::size_t looks = std::min(kLooks, frames.size());
    for (std::size_t i = 0; i < looks; ++i) {
        show_frame(model, frames[looks == 1 ? 0 : i * (frames.size() - 1) / (looks - 1)], shown);
        const std::vector<glm::vec3> places = reached_places(model, shown);
        points.insert(points.end(), places.begin(), places.end());
    }
    return points.empty() ? camera_before(model, shown, plan.view, aspect)
                          : camera_before(camera_of_view(plan.view), points, aspect);
}

}  // namespace

Expected<void> check_xbody_film(const XbodyFilmPlan& plan) {
    constexpr std::array<std::string_view, 6> kKnown = {
        "", ".png", ".mp4", ".avi", ".mkv", ".webm"};
    const std::string ending = plan.output.extension().string();
    if (std::find(kKnown.begin(), kKnown.end(), ending) == kKnown.end()) {
        return fail(printable(plan.output.string()) +
                    ": cannot write this kind of picture; known: .png, .mp4, .avi, .mkv, .webm, or "
                    "a folder");
    }
    if (plan.rate == 0.0) {
        return fail("--rate is 0: a film that stands still has no end");
    }
    return engine::check_clip_film(film_plan(plan));
}

Expected<std::filesystem::path> write_xbody_film(const XbodyFilmPlan& plan,
                                                 ShownModel model,
                                                 const engine::FilmProgress& progress) {
    if (plan.frame && *plan.frame >= model.frame_count()) {
        return fail(fmt::format("{}: has no frame {}, its last is {}",
                                printable(model.file().string()),
                                *plan.frame,
                                model.frame_count() - 1));
    }
    const auto context = render::OffscreenContext::create();
    if (!context) {
        return fail(context.error());
    }
    auto host = render::PaneHost::create();
    if (!host) {
        return fail(host.error());
    }
    auto stage = XbodyStage::create(std::move(model));
    if (!stage) {
        return fail(std::move(stage.error()));
    }
    engine::ClipFilmPlan film = film_plan(plan);
    film.shown = frames_of(plan, stage->model());
    constexpr int kPictureSamples = 4;
    film.samples = is_picture(plan) ? kPictureSamples : stage->samples();
    const render::Camera camera = camera_for(film.shown.frames, plan, stage->model());
    const float scale = render::pane_scale(plan.size.width, plan.size.height, 1.0F);
    return engine::write_clip_film(
        film,
        [&](std::size_t frame, const render::FrameTarget& target) {
            stage->show(frame, {});
            draw_xbody_picture(*stage,
                               stage->model().figure.model.character.humanoid,
                               {},
                               camera,
                               {.has_names = plan.has_names},
                               scale,
                               *host,
                               target);
        },
        progress);
}

void draw_xbody_picture(XbodyStage& stage,
                        const render::HumanoidMap& humanoid,
                        const std::vector<bool>& is_hidden,
                        const render::Camera& camera,
                        const XbodyMarks& marks,
                        float scale,
                        render::PaneHost& host,
                        const render::FrameTarget& target) {
    stage.draw(camera, marks.is_wireframe, target);
    host.draw(target, scale, {}, [&](const render::PaneFrame& frame) {
        const SeenMarks seen = seen_marks(
            stage.model(), stage.shown(), humanoid, is_hidden, camera, frame.area, marks);
        draw_marks(frame, frame.area, seen, marks);
    });
}

}  // namespace raks::apps
