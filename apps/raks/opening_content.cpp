#include "apps/raks/opening_content.hpp"

#include <span>

#include "base/time.hpp"
#include "motion/dance/standing.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::apps {
namespace {

class OpeningContent final : public engine::WindowContent {
 public:
    explicit OpeningContent(const std::function<bool()>& is_ready) : is_ready_(is_ready) {}

    void advance(double seconds) override { shown_for_ += seconds; }
    void draw(const engine::WindowPicture& picture, render::OverlayState& overlay) override {
        const render::Dancer dancer = picture.bodies.still(
            motion::idle_pose(motion::mannequin_skeleton(), stream_time_from_seconds(shown_for_)));
        picture.renderer.draw(picture.scene, std::span(&dancer, 1), picture.target);
        overlay.message = "loading the dances";
    }
    [[nodiscard]] bool is_finished() const override { return is_ready_(); }
    [[nodiscard]] bool has_avatar() const override { return false; }

 private:
    const std::function<bool()>& is_ready_;
    double shown_for_ = 0.0;
};

}  // namespace

bool show_opening(engine::WindowLoop& window, const std::function<bool()>& is_ready) {
    OpeningContent content(is_ready);
    engine::ActionDispatcher actions([&](const std::string& line) { window.say(line); });
    return window.run(content, actions) == engine::WindowEnd::finished;
}

}  // namespace raks::apps
