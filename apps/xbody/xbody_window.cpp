#include "apps/xbody/xbody_window.hpp"

#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "apps/xbody/xbody_pane.hpp"
#include "apps/xbody/xbody_texts.hpp"
#include "base/printable.hpp"
#include "base/time.hpp"
#include "render/panes/pane_window.hpp"
#include "render/renderer.hpp"
#include "render/scene/scene.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

engine::ClipTransport transport_of(const ShownModel& model, std::size_t frame) {
    return model.clip && frame == 0
               ? engine::ClipTransport(model.frame_count(), model.rate())
               : engine::ClipTransport(model.frame_count(), model.rate(), frame);
}

/// The rectangle of the window that a box of units is.
render::FrameTarget target_of(const render::Box& box, const render::PaneFrame& frame) {
    const auto pixels = [&frame](float units) {
        return static_cast<int>(std::lround(units * frame.pen.unit()));
    };
    return {.framebuffer = 0,
            .x = pixels(box.x),
            .y = pixels(frame.area.height) - pixels(box.bottom()),
            .width = pixels(box.right()) - pixels(box.x),
            .height = pixels(box.bottom()) - pixels(box.y)};
}

/// What the window shows; keeps model, session and what is made from them.
class XbodyContent : public render::PaneContent {
 public:
    XbodyContent(ShownModel model, render::Renderer renderer, const XbodyStart& start)
        : model_(std::move(model)),
          renderer_(std::move(renderer)),
          shown_(model_),
          session_(
              xbody_session(model_.as_read,
                            model_.labels ? model_.labels->bones : std::vector<render::BoneLabel>(),
                            transport_of(model_, start.frame),
                            {})),
          drawn_hidden_(session_.tree.is_hidden) {
        session_.has_names = start.has_names;
        scene_.theme = render::find_theme("studio_light").value_or(scene_.theme);
        view_.meshes = mesh_lines(model_.as_read);
        view_.file = file_lines(model_);
        first_view_ = start.view;
    }

    void draw(const render::PaneFrame& frame) override {
        const XbodyLayout layout = xbody_layout(frame.area);
        aspect_ = layout.view.width / layout.view.height;
        if (!first_view_.empty()) {
            fulfil(FitView{std::exchange(first_view_, std::string())});
        }
        draw_model(frame, layout.view);
        view_.kinds = node_kinds(model_.as_read, session_.humanoid);
        view_.seen = seen_skeleton(model_,
                                   shown_,
                                   session_.humanoid,
                                   session_.tree.is_hidden,
                                   session_.camera,
                                   layout.view);
        std::vector<XbodyWish> wishes = xbody_pane(frame, session_, view_);
        if (wishes.empty()) {
            for (const KeyEvent& key : frame.keys) {
                static_cast<void>(session_.transport.handle(key));
            }
        }
        for (const XbodyWish& wish : wishes) {
            std::visit([this](const auto& one) { fulfil(one); }, wish);
        }
    }
    bool is_moving() override {
        const HostTime now = HostClock::now();
        session_.transport.advance(to_seconds(now - std::exchange(advanced_, now)));
        return !session_.transport.is_paused() && model_.frame_count() > 1;
    }
    bool may_close() override {
        if (session_.labels.is_saved() || is_warned_) {
            return true;
        }
        is_warned_ = true;
        session_.message = "Not saved: S saves, Q once more closes without";
        return false;
    }
    [[nodiscard]] bool is_finished() const override { return is_finished_; }

 private:
    void draw_model(const render::PaneFrame& frame, const render::Box& box) {
        if (drawn_hidden_ != session_.tree.is_hidden) {
            drawn_hidden_ = session_.tree.is_hidden;
            hide_nodes(drawn_hidden_, model_);
            if (auto added = renderer_.add(*model_.avatar)) {
                renderer_.remove(std::exchange(handle_, *added));
            } else {
                session_.message = added.error().message;
            }
            shown_ = ShownPose(model_);
        }
        show_frame(model_, session_.transport.frame(), shown_);
        scene_.camera = session_.camera;
        const render::Dancer dancer{.avatar = handle_, .pose = shown_.pose, .state = &shown_.state};
        renderer_.draw(scene_, std::span(&dancer, 1), target_of(box, frame));
    }

    void fulfil(const XbodyAction& action) {
        if (!std::holds_alternative<MoveCamera>(action)) {
            is_warned_ = false;
        }
        apply(action, session_);
    }
    void fulfil(const FitView& wish) {
        session_.camera = camera_before(model_, shown_, wish.view, aspect_);
    }
    void fulfil(const FrameChosen& /*wish*/) {
        std::vector<glm::vec3> points;
        if (session_.node) {
            points = branch_places(model_, shown_, *session_.node);
        }
        if (points.empty()) {
            points = branch_places(model_, shown_, -1);
        }
        if (!points.empty()) {
            session_.camera = camera_before(session_.camera, points, aspect_);
        }
    }
    void fulfil(const SaveXbody& /*wish*/) {
        const auto saved = engine::save_labels(model_.labels_file, session_.labels);
        session_.message =
            saved ? "Saved: " + printable(model_.labels_file.string()) : saved.error().message;
    }
    void fulfil(const CloseXbody& /*wish*/) { is_finished_ = may_close(); }

    ShownModel model_;
    render::Renderer renderer_;
    ShownPose shown_;
    XbodySession session_;
    std::vector<bool> drawn_hidden_;  // what the drawn avatar leaves out
    render::AvatarHandle handle_;
    render::Scene scene_;
    XbodyView view_;
    std::string first_view_;  // until the window's form is known
    float aspect_ = 1.0F;
    HostTime advanced_ = HostClock::now();
    bool is_warned_ = false;  // that labels are not saved
    bool is_finished_ = false;
};

}  // namespace

Expected<void> xbody_in_window(ShownModel model,
                               const XbodyStart& start,
                               const std::function<bool()>& is_stop_requested) {
    auto window = render::PaneWindow::create(
        {.title = "Raks: xbody " + printable(model.file.filename().string()),
         .width = start.width,
         .height = start.height,
         .max_fps = 60.0,
         .otherwise = "draw a picture: -o X.png"});
    if (!window) {
        return fail(std::move(window.error()));
    }
    auto renderer = render::Renderer::create(*model.avatar);
    if (!renderer) {
        return fail(std::move(renderer.error()));
    }
    XbodyContent content(std::move(model), std::move(*renderer), start);
    window->run(content, is_stop_requested);
    return {};
}

}  // namespace raks::apps
