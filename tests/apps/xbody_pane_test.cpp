#include "apps/xbody/xbody_pane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "tests/render/import/tiny_tds.hpp"

namespace raks::apps {
namespace {

using motion::Bone;
using render::Box;
using render::MouseButton;
using render::MouseButtonEvent;
using render::WindowEvent;

/// The pane without a window: events in, the session changed.
class XbodyPanes : public ::testing::Test {
 protected:
    XbodyPanes()
        : model_(test::tds::read(test::tds::figure()).value()),
          session_(xbody_session(model_, {}, engine::ClipTransport(100, 30.0, 0), {})) {
        frames({});
    }

    [[nodiscard]] static XbodyLayout layout() {
        return xbody_layout({0.0F, 0.0F, 1280.0F, 720.0F});
    }
    void frames(const std::vector<WindowEvent>& events) {
        context_.take(events);
        for (int frame = 0; frame < 2 || context_.has_waiting(); ++frame) {
            view_.kinds = node_kinds(model_, session_.humanoid);
            const auto wishes = xbody_pane(context_.begin({}, pointer_), session_, view_);
            context_.end();
            for (const XbodyWish& wish : wishes) {
                if (const auto* const action = std::get_if<XbodyAction>(&wish)) {
                    apply(*action, session_);
                }
                saves_ += std::holds_alternative<SaveXbody>(wish) ? 1 : 0;
                if (const auto* const film = std::get_if<WriteFilm>(&wish)) {
                    film_ = film->ending;
                }
                film_ = std::holds_alternative<StopFilm>(wish) ? "stopped" : film_;
                if (const auto* const pick = std::get_if<PickSurface>(&wish)) {
                    picked_ = pick->at;
                }
                if (const auto* const files = std::get_if<TakeFiles>(&wish)) {
                    dropped_.push_back(files->paths);
                }
            }
        }
    }
    void click(const Box& box) {
        pointer_ = {box.x + box.width / 2.0F, box.y + box.height / 2.0F};
        frames({MouseButtonEvent{MouseButton::left, true, pointer_.x, pointer_.y},
                MouseButtonEvent{MouseButton::left, false, pointer_.x, pointer_.y}});
    }
    void press(Key key) { frames({KeyEvent{.key = key}}); }

    [[nodiscard]] int node(const std::string& name) const {
        const auto found = std::find_if(model_.nodes.begin(),
                                        model_.nodes.end(),
                                        [&](const auto& one) { return one.name == name; });
        return static_cast<int>(found - model_.nodes.begin());
    }
    [[nodiscard]] Box row_of(int wanted) const {
        const auto rows = tree_rows(model_, session_.tree);
        const auto found = std::find_if(
            rows.begin(), rows.end(), [&](const TreeRow& row) { return row.node == wanted; });
        return layout().rows[static_cast<std::size_t>(found - rows.begin())];
    }
    [[nodiscard]] Box line_of(Bone bone) const {
        const auto bones = listed_bones(session_.humanoid);
        return layout().lines[static_cast<std::size_t>(std::find(bones.begin(), bones.end(), bone) -
                                                       bones.begin())];
    }

    render::Model model_;
    XbodySession session_;
    XbodyView view_;
    render::PaneContext context_;
    render::PointerPlace pointer_;
    int saves_ = 0;
    std::string film_;
    std::optional<glm::vec2> picked_;
    std::vector<std::vector<std::string>> dropped_;
};

TEST_F(XbodyPanes, a_node_a_bone_and_label_make_a_label_which_is_taken_back_and_done_again) {
    click(row_of(node("HandL")));
    EXPECT_EQ(session_.node, node("HandL"));
    EXPECT_EQ(session_.bone, Bone::left_hand) << "what it is taken for is chosen with it";
    click(line_of(Bone::head));
    click(layout().label);
    ASSERT_EQ(session_.labels.now().size(), 1U);
    EXPECT_EQ(session_.labels.now().front().node, "HandL");
    EXPECT_EQ(session_.humanoid.nodes[motion::index_of(Bone::head)], node("HandL"));
    click(layout().undo);
    EXPECT_TRUE(session_.labels.now().empty());
    EXPECT_EQ(session_.humanoid.nodes[motion::index_of(Bone::left_hand)], node("HandL"));
    click(layout().redo);
    EXPECT_EQ(session_.labels.now().size(), 1U);
    click(layout().save);
    EXPECT_EQ(saves_, 1);
    click(layout().unlabel);
    EXPECT_TRUE(session_.labels.now().empty());
}

TEST_F(XbodyPanes, keys_do_the_same) {
    apply(ChooseNode{node("HandL")}, session_);
    apply(ChooseBone{Bone::head}, session_);
    press(Key{U'l'});
    EXPECT_EQ(session_.labels.now().size(), 1U);
    press(Key{U'u'});
    EXPECT_TRUE(session_.labels.now().empty());
    press(Key{U'y'});
    EXPECT_EQ(session_.labels.now().size(), 1U);
    press(Key{U's'});
    EXPECT_EQ(saves_, 1);
    press(Key{U'n'});
    EXPECT_TRUE(session_.has_names);
    press(Key{U'h'});
    EXPECT_TRUE(session_.tree.is_hidden[static_cast<std::size_t>(node("HandL"))]);
}

TEST_F(XbodyPanes, letters_of_a_search_do_nothing_else) {
    click(layout().search);
    for (const char32_t letter : U"hand") {
        if (letter != 0) {
            press(Key{letter});
        }
    }
    EXPECT_EQ(session_.tree.search, "hand");
    EXPECT_TRUE(std::none_of(session_.tree.is_hidden.begin(),
                             session_.tree.is_hidden.end(),
                             [](bool is_hidden) { return is_hidden; }));
    press(Key::enter);
    EXPECT_FALSE(session_.is_searching);
    const auto rows = tree_rows(model_, session_.tree);
    EXPECT_LT(rows.size(), model_.nodes.size());
}

TEST_F(XbodyPanes, the_transport_steps_and_jumps) {
    click(layout().steps[3]);
    EXPECT_EQ(session_.transport.frame(), 1U);
    click(layout().steps[4]);
    EXPECT_EQ(session_.transport.frame(), 99U);
    click(layout().steps[0]);
    EXPECT_EQ(session_.transport.frame(), 0U);
    click(layout().slower);
    EXPECT_EQ(session_.transport.rate(), 0.75);
    click(layout().steps[2]);
    EXPECT_FALSE(session_.transport.is_paused());
}

TEST_F(XbodyPanes, a_number_and_enter_go_to_that_frame) {
    press(Key{U'3'});
    press(Key{U'0'});
    press(Key::enter);
    EXPECT_EQ(session_.transport.frame(), 30U);
    press(Key{U'.'});
    EXPECT_EQ(session_.transport.frame(), 31U);
    press(Key::home);
    EXPECT_EQ(session_.transport.frame(), 0U);
}

TEST_F(XbodyPanes, a_node_that_is_picked_is_seen_in_the_tree_though_its_branch_was_folded) {
    apply(FoldBranch{0}, session_);
    frames({});
    ASSERT_LT(tree_rows(model_, session_.tree).size(), model_.nodes.size());
    apply(ChooseNode{node("HandL")}, session_);
    frames({});
    const auto rows = tree_rows(model_, session_.tree);
    const auto found = std::find_if(
        rows.begin(), rows.end(), [&](const TreeRow& row) { return row.node == session_.node; });
    EXPECT_NE(found, rows.end());
    EXPECT_FALSE(session_.is_node_to_see);
}

TEST_F(XbodyPanes, a_click_near_a_bone_in_the_view_picks_it) {
    const Box& view = layout().view;
    const glm::vec2 middle(view.x + view.width / 2.0F, view.y + view.height / 2.0F);
    view_.seen.skeleton.push_back(
        {3, -1, middle + glm::vec2(4.0F, 3.0F), {}, NodeKind::bone, "here"});
    view_.seen.skeleton.push_back(
        {4, -1, middle + glm::vec2(40.0F, 0.0F), {}, NodeKind::bone, "there"});
    click(view);
    EXPECT_EQ(session_.node, 3);
    EXPECT_FALSE(picked_);
}

TEST_F(XbodyPanes, a_click_away_from_all_bones_that_are_drawn_asks_for_the_surface_there) {
    const Box& view = layout().view;
    const glm::vec2 middle(view.x + view.width / 2.0F, view.y + view.height / 2.0F);
    view_.seen.skeleton.push_back(
        {3, -1, middle + glm::vec2(20.0F, 0.0F), {}, NodeKind::bone, "off"});
    click(view);
    EXPECT_EQ(picked_, middle);
    picked_.reset();
    view_.seen.skeleton.front().at = middle;
    apply(DrawBones{false}, session_);
    click(view);
    EXPECT_EQ(picked_, middle) << "what is not seen is not picked";
    EXPECT_FALSE(session_.node);
}

TEST_F(XbodyPanes, a_slider_of_the_chosen_bone_turns_it_and_the_button_above_puts_it_back) {
    view_.can_pose = true;
    view_.expressions = {"happy"};
    apply(ChooseBone{Bone::head}, session_);
    click(layout().pages[static_cast<std::size_t>(XbodyPage::pose)]);
    const Box line = layout().lines[2];  // under the button and the bone's title
    pointer_ = {line.right() - 70.0F, line.y + line.height / 2.0F};
    frames({MouseButtonEvent{MouseButton::left, true, pointer_.x, pointer_.y}});
    frames({MouseButtonEvent{MouseButton::left, false, pointer_.x, pointer_.y}});
    EXPECT_GT(session_.tuning.turns[motion::index_of(Bone::head)].x, 90.0F);
    EXPECT_EQ(session_.tuning.turns[motion::index_of(Bone::head)].y, 0.0F);
    click(layout().lines[0]);
    EXPECT_EQ(session_.tuning, PoseTuning());
}

TEST_F(XbodyPanes, the_rest_axis_of_a_label_goes_through_all_and_back_to_none) {
    apply(ChooseNode{node("HandL")}, session_);
    apply(ChooseBone{Bone::head}, session_);
    press(Key{U'a'});
    EXPECT_TRUE(session_.labels.now().empty()) << "nothing is labelled yet";
    press(Key{U'l'});
    click(layout().axis);
    EXPECT_EQ(session_.labels.now().front().axis, glm::vec3(1.0F, 0.0F, 0.0F));
    for (int i = 0; i < 6; ++i) {
        press(Key{U'a'});
    }
    EXPECT_EQ(session_.labels.now().front().axis, glm::vec3(0.0F));
}

TEST_F(XbodyPanes, colours_wires_and_springs_are_chosen_by_buttons) {
    click(layout().looks[5]);
    EXPECT_EQ(session_.look().paint, ModelPaint::weights);
    EXPECT_EQ(session_.look().joint, -1);
    EXPECT_FALSE(session_.message.empty()) << "which joint";
    apply(ChooseNode{node("HandL")}, session_);
    EXPECT_EQ(session_.look().joint, node("HandL"));
    click(layout().looks[6]);
    click(layout().looks[2]);
    EXPECT_TRUE(session_.marks().is_wireframe);
    EXPECT_TRUE(session_.marks().has_springs);
}

TEST_F(XbodyPanes, a_film_is_asked_for_and_stopped) {
    click(layout().pages[static_cast<std::size_t>(XbodyPage::film)]);
    click(layout().films[2]);
    EXPECT_EQ(film_, ".avi");
    view_.film_share = 0.5;
    click(layout().films[1]);
    EXPECT_EQ(film_, ".avi") << "one after the other";
    click(layout().films[4]);
    EXPECT_EQ(film_, "stopped");
}

TEST_F(XbodyPanes, files_that_are_dropped_together_are_handed_on_together) {
    frames({render::DropEvent{{"a.glb", "b.bvh"}}, render::DropEvent{{"c.wav"}}});
    EXPECT_EQ(dropped_, (std::vector<std::vector<std::string>>{{"a.glb", "b.bvh"}, {"c.wav"}}));
}

TEST_F(XbodyPanes, a_drag_in_the_view_turns_the_camera_and_picks_nothing) {
    const Box& view = layout().view;
    const float x = view.x + view.width / 2.0F;
    const float y = view.y + view.height / 2.0F;
    view_.seen.skeleton.push_back({3, -1, {x + 60.0F, y}, {}, NodeKind::bone, "here"});
    pointer_ = {x + 60.0F, y};
    const float yaw = session_.camera.yaw;
    frames({MouseButtonEvent{MouseButton::left, true, x, y},
            render::MouseDragEvent{.dx = 60.0F, .x = x + 60.0F, .y = y}});
    frames({MouseButtonEvent{MouseButton::left, false, x + 60.0F, y}});
    EXPECT_NE(session_.camera.yaw, yaw);
    EXPECT_FALSE(session_.node);
}

TEST(XbodyLayout, has_room_for_all_at_the_usual_sizes) {
    for (const Box& area : {Box{0.0F, 0.0F, 1280.0F, 720.0F}, Box{0.0F, 0.0F, 1536.0F, 864.0F}}) {
        const XbodyLayout layout = xbody_layout(area);
        EXPECT_GT(layout.rows.size(), 20U);
        EXPECT_GT(layout.lines.size(), 20U);
        EXPECT_GT(layout.view.width, 500.0F);
        EXPECT_LE(layout.keys.bottom(), area.bottom());
        EXPECT_LE(layout.save.right(), area.right());
        EXPECT_LE(layout.timeline.right(), area.right());
        EXPECT_GT(layout.timeline.width, 300.0F);
    }
}

}  // namespace
}  // namespace raks::apps
