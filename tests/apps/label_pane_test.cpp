#include "apps/raks_capture/label_pane.hpp"

#include <gtest/gtest.h>

#include <variant>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using render::Box;
using render::MouseButton;
using render::MouseButtonEvent;
using render::MouseDragEvent;
using render::WindowEvent;

glm::vec2 middle_of(const Box& box) {
    return {box.x + box.width / 2.0F, box.y + box.height / 2.0F};
}

/// The pane without a window: events in, the session changed.
class LabelPanes : public ::testing::Test {
 protected:
    LabelPanes() { frames({}); }

    [[nodiscard]] LabelLayout layout() const {
        return label_layout({0.0F, 0.0F, 1280.0F, 720.0F}, 2, session_.markers.markers.size());
    }
    [[nodiscard]] glm::vec2 at(const glm::dvec2& pixel) const {
        return render::PicturePlace(layout().picture, view_.width, view_.height, view_.zoom)
            .in_box(pixel);
    }
    void frames(const std::vector<WindowEvent>& events) {
        context_.take(events);
        for (int frame = 0; frame < 2 || context_.has_waiting(); ++frame) {
            const auto wishes = label_pane(context_.begin({}, pointer_), session_, view_);
            context_.end();
            for (const LabelWish& wish : wishes) {
                if (const auto* const action = std::get_if<LabelAction>(&wish)) {
                    apply(*action, session_);
                } else if (const auto* const zoom = std::get_if<SetLabelZoom>(&wish)) {
                    view_.zoom = zoom->zoom;
                } else {
                    saves_ += std::holds_alternative<SaveLabels>(wish) ? 1 : 0;
                }
            }
        }
    }
    void click(const glm::vec2& place) {
        pointer_ = {place.x, place.y};
        frames({MouseButtonEvent{MouseButton::left, true, place.x, place.y},
                MouseButtonEvent{MouseButton::left, false, place.x, place.y}});
    }
    void press(Key key) { frames({KeyEvent{.key = key}}); }

    LabelSession session_ = label_session({"left", "right"}, capture::default_markers(), {});
    LabelView view_;
    render::PaneContext context_;
    render::PointerPlace pointer_;
    int saves_ = 0;
};

TEST_F(LabelPanes, a_click_and_a_row_make_a_label) {
    click(at({300.0, 200.0}));
    click(middle_of(layout().markers[2]));
    ASSERT_EQ(session_.labels.now().size(), 1U);
    EXPECT_EQ(session_.labels.now().front().marker, session_.markers.markers[2].name);
    EXPECT_LT(glm::distance(session_.labels.now().front().pixel, {300.0, 200.0}), 0.02);
}

TEST_F(LabelPanes, a_click_near_a_spot_is_meant_for_it_and_enter_takes_its_marker) {
    view_.proposals = {{{310.0, 204.0}, 1, 5}};
    click(at({306.0, 203.0}));
    ASSERT_TRUE(session_.picked);
    EXPECT_EQ(*session_.picked, glm::dvec2(310.0, 204.0));
    press(Key::enter);
    ASSERT_NE(session_.label_of(5), nullptr);
    EXPECT_EQ(session_.label_of(5)->pixel, glm::dvec2(310.0, 204.0));
}

TEST_F(LabelPanes, a_label_is_dragged_to_where_the_pointer_lets_it_go) {
    click(at({300.0, 200.0}));
    click(middle_of(layout().markers[0]));
    const glm::vec2 from = at({300.0, 200.0});
    const glm::vec2 to = at({350.0, 230.0});
    pointer_ = {to.x, to.y};
    frames({MouseButtonEvent{MouseButton::left, true, from.x, from.y}});
    frames({MouseDragEvent{.x = to.x, .y = to.y}});
    frames({MouseButtonEvent{MouseButton::left, false, to.x, to.y}});
    EXPECT_LT(glm::distance(session_.label_of(0)->pixel, {350.0, 230.0}), 0.02);
    press(key_of(U'u'));
    EXPECT_LT(glm::distance(session_.label_of(0)->pixel, {300.0, 200.0}), 0.02);
    press(key_of(U'y'));
    EXPECT_LT(glm::distance(session_.label_of(0)->pixel, {350.0, 230.0}), 0.02);
}

TEST_F(LabelPanes, buttons_and_keys_do_the_same) {
    click(middle_of(layout().cameras[1]));
    EXPECT_EQ(session_.camera, 1U);
    press(Key::tab);
    EXPECT_EQ(session_.camera, 0U);
    press(key_of(U'2'));
    EXPECT_EQ(session_.camera, 1U);
    click(middle_of(layout().after));
    press(Key::right);
    EXPECT_EQ(session_.picture(), 2U);
    click(middle_of(layout().before));
    press(Key::left);
    press(Key::left);
    EXPECT_EQ(session_.picture(), 0U);
    press(Key::down);
    EXPECT_EQ(session_.chosen, 0U);
    click(at({100.0, 100.0}));
    ASSERT_NE(session_.label_of(0), nullptr);
    click(middle_of(layout().undo));
    EXPECT_EQ(session_.label_of(0), nullptr);
    click(middle_of(layout().redo));
    ASSERT_NE(session_.label_of(0), nullptr);
    press(key_of(U's'));
    click(middle_of(layout().save));
    EXPECT_EQ(saves_, 2);
    press(Key::escape);
    click(at({100.0, 100.0}));
    press(Key::backspace);
    EXPECT_EQ(session_.label_of(0), nullptr);
}

TEST_F(LabelPanes, all_that_is_proposed_is_accepted_at_once) {
    view_.proposals = {{{310.0, 204.0}, 1, 5}, {{20.0, 30.0}, 2, std::nullopt}, {{9.0, 9.0}, 0, 0}};
    click(middle_of(layout().accept));
    EXPECT_EQ(session_.labels.now().size(), 2U);
}

TEST_F(LabelPanes, nothing_is_labelled_while_the_picture_is_read) {
    view_.is_loading = true;
    click(at({300.0, 200.0}));
    EXPECT_FALSE(session_.picked);
}

TEST(LabelLayouts, hold_everything_at_any_size) {
    for (const auto& [width, height] :
         {std::pair{800.0F, 480.0F}, {1280.0F, 720.0F}, {1920.0F, 1080.0F}}) {
        for (const std::size_t markers : {6U, 20U, 100U}) {
            const LabelLayout layout = label_layout({0.0F, 0.0F, width, height}, 6, markers);
            EXPECT_GT(layout.picture.width, 300.0F);
            EXPECT_GT(layout.picture.height, 300.0F);
            EXPECT_LE(layout.markers.size(), markers);
            EXPECT_GT(layout.cameras.back().width, 30.0F);
            EXPECT_LE(layout.cameras.back().right(), layout.before.x);
            EXPECT_LE(layout.markers.back().bottom(), layout.accept.y);
            EXPECT_LE(layout.keys.bottom(), height);
            EXPECT_LE(layout.picture.bottom(), layout.status.y);
        }
    }
}

}  // namespace
}  // namespace raks::apps
