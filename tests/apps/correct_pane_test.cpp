#include "apps/raks_capture/correct_pane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "render/panes/timeline.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using render::Box;
using render::MouseButton;
using render::MouseButtonEvent;
using render::MouseDragEvent;
using render::WindowEvent;

/// The pane without a window, with four views of markers in a row.
class CorrectPanes : public ::testing::Test {
 protected:
    CorrectPanes() {
        for (const capture::Marker& marker : markers_.markers) {
            session_.tracks.markers.push_back(marker.name);
        }
        session_.cameras = {"a", "b", "c", "d"};
        session_.tracks.frames_per_second = 50.0;
        session_.tracks.frame_count = 100;
        session_.tracks.places.resize(100 * markers_.markers.size(),
                                      {glm::dvec3(0.0), 0.005, 3, capture::PlaceSource::seen});
        scene_.views.resize(4);
        for (CorrectView& view : scene_.views) {
            for (std::size_t marker = 0; marker < markers_.markers.size(); ++marker) {
                view.places.emplace_back(
                    glm::dvec2(100.0 + 55.0 * static_cast<double>(marker), 300.0));
            }
        }
        scene_.errors.assign(100, 5.0);
        frames({});
    }

    [[nodiscard]] CorrectLayout layout() const {
        return layout_of({0.0F, 0.0F, 1280.0F, 720.0F}, session_, scene_);
    }
    [[nodiscard]] glm::vec2 at(std::size_t camera, const glm::dvec2& pixel) const {
        const CorrectView& view = scene_.views[camera];
        return render::PicturePlace(layout().views[camera], view.width, view.height, view.zoom)
            .in_box(pixel);
    }
    void frames(const std::vector<WindowEvent>& events) {
        context_.take(events);
        for (int frame = 0; frame < 2 || context_.has_waiting(); ++frame) {
            const auto wishes = correct_pane(context_.begin({}, pointer_), session_, scene_);
            context_.end();
            for (const CorrectWish& wish : wishes) {
                if (const auto* const action = std::get_if<CorrectAction>(&wish)) {
                    apply(*action, session_);
                } else if (const auto* const zoom = std::get_if<SetViewZoom>(&wish)) {
                    scene_.views[zoom->camera].zoom = zoom->zoom;
                } else {
                    others_.push_back(wish.index());
                }
            }
        }
    }
    void click(const glm::vec2& place) {
        pointer_ = {place.x, place.y};
        frames({MouseButtonEvent{MouseButton::left, true, place.x, place.y},
                MouseButtonEvent{MouseButton::left, false, place.x, place.y}});
    }
    void click(const Box& box) {
        click(glm::vec2(box.x + box.width / 2.0F, box.y + box.height / 2.0F));
    }
    void drag(const glm::vec2& from, const glm::vec2& to) {
        pointer_ = {to.x, to.y};
        frames({MouseButtonEvent{MouseButton::left, true, from.x, from.y},
                MouseDragEvent{.x = to.x, .y = to.y},
                MouseButtonEvent{MouseButton::left, false, to.x, to.y}});
    }
    void press(Key key) { frames({KeyEvent{.key = key}}); }

    capture::MarkerSet markers_ = capture::default_markers();
    CorrectSession session_;
    CorrectScene scene_{markers_, {}, {}, 0, false, false, {}};
    render::PaneContext context_;
    render::PointerPlace pointer_;
    std::vector<std::size_t> others_;  // kinds of wishes that are not the session's
};

TEST_F(CorrectPanes, the_marker_is_dragged_in_one_view) {
    drag(at(2, *scene_.views[2].places[0]), at(2, {180.0, 400.0}));
    ASSERT_EQ(session_.edits.now().size(), 1U);
    const capture::Edit& edit = session_.edits.now().front();
    EXPECT_EQ(edit.camera, "c");
    EXPECT_EQ(edit.marker, markers_.markers[0].name);
    EXPECT_LT(glm::distance(edit.pixel, {180.0, 400.0}), 0.02);
}

TEST_F(CorrectPanes, a_drag_ends_on_a_spot_of_its_colour_that_is_near) {
    scene_.views[2].spots = {{{184.0, 402.0}, markers_.classes()[0], 20.0},
                             {{180.0, 400.0}, markers_.classes()[1], 20.0}};
    drag(at(2, *scene_.views[2].places[0]), at(2, {180.0, 400.0}));
    ASSERT_EQ(session_.edits.now().size(), 1U);
    EXPECT_EQ(session_.edits.now().front().pixel, glm::dvec2(184.0, 402.0));
}

TEST_F(CorrectPanes, a_press_on_another_marker_chooses_it) {
    click(at(1, *scene_.views[1].places[6]));
    EXPECT_EQ(session_.marker, 6U);
    click(layout().markers[3]);
    EXPECT_EQ(session_.marker, 3U);
    EXPECT_TRUE(session_.edits.now().empty());
}

TEST_F(CorrectPanes, a_lost_marker_is_set_where_a_view_is_clicked) {
    for (CorrectView& view : scene_.views) {
        view.places[0].reset();
    }
    click(at(0, {700.0, 500.0}));
    ASSERT_EQ(session_.edits.now().size(), 1U);
    EXPECT_LT(glm::distance(session_.edits.now().front().pixel, {700.0, 500.0}), 0.02);
}

TEST_F(CorrectPanes, a_swap_takes_its_other_marker_from_list_or_view) {
    click(layout().swap);
    click(layout().markers[9]);
    press(key_of(U'e'));
    click(at(3, *scene_.views[3].places[4]));
    ASSERT_EQ(session_.edits.now().size(), 2U);
    EXPECT_EQ(session_.edits.now()[0].other, markers_.markers[9].name);
    EXPECT_EQ(session_.edits.now()[1].other, markers_.markers[4].name);
}

TEST_F(CorrectPanes, the_timeline_leads_to_a_frame) {
    const Box frames_box = render::timeline_frames(layout().timeline);
    click(glm::vec2(render::timeline_x(frames_box, 70, 100), layout().timeline.y + 20.0F));
    EXPECT_EQ(session_.frame, 70U);
}

TEST_F(CorrectPanes, buttons_and_keys_do_the_same) {
    press(Key::right);
    press(Key::right);
    press(Key::left);
    EXPECT_EQ(session_.frame, 1U);
    press(Key::end);
    EXPECT_EQ(session_.frame, 99U);
    click(layout().hide);
    press(key_of(U'i'));
    EXPECT_EQ(session_.edits.now().size(), 2U);
    click(layout().undo);
    press(key_of(U'u'));
    EXPECT_TRUE(session_.edits.now().empty());
    click(layout().redo);
    press(key_of(U'y'));
    EXPECT_EQ(session_.edits.now().size(), 2U);
    press(key_of(U't'));
    click(layout().track);
    press(key_of(U's'));
    click(layout().save);
    ASSERT_EQ(others_.size(), 4U);
    EXPECT_EQ(others_[0], others_[1]);
    EXPECT_EQ(others_[2], others_[3]);
    press(Key::space);
    EXPECT_TRUE(session_.is_playing);
    click(layout().play);
    EXPECT_FALSE(session_.is_playing);
}

TEST_F(CorrectPanes, of_joints_views_are_chosen_and_their_sides_exchanged) {
    session_.is_of_joints = true;
    for (CorrectView& view : scene_.views) {
        view.skeleton.emplace();
    }
    click(at(2, {640.0, 600.0}));
    EXPECT_EQ(session_.camera, 2U);
    EXPECT_TRUE(session_.edits.now().empty()) << "a click sets no joint";
    press(key_of(U'e'));
    click(layout().exchange);
    frames({KeyEvent{.key = key_of(U'e'), .has_shift = true}});
    click(layout().exchange_limb);
    press(key_of(U'h'));
    click(layout().hide);
    press(key_of(U'p'));
    click(layout().hide_view);
    const auto& edits = session_.edits.now();
    ASSERT_EQ(edits.size(), 8U);
    for (std::size_t i = 0; i < 8; i += 2) {
        EXPECT_EQ(edits[i], edits[i + 1]) << "key and button do the same";
        EXPECT_EQ(edits[i].camera, "c");
    }
    EXPECT_EQ(edits[0].kind, capture::EditKind::exchange);
    EXPECT_EQ(edits[4].marker, markers_.markers[0].name);
    EXPECT_EQ(edits[6].marker, "");
    press(Key::tab);
    EXPECT_EQ(session_.camera, 3U);
    press(key_of(U'2'));
    EXPECT_EQ(session_.camera, 1U);
}

TEST_F(CorrectPanes, one_view_fills_all_and_gives_way_again) {
    press(key_of(U'3'));
    EXPECT_GT(layout().views[2].width, 900.0F);
    EXPECT_EQ(layout().views[0].width, 0.0F);
    press(key_of(U'3'));
    EXPECT_LT(layout().views[2].width, 600.0F);
}

TEST_F(CorrectPanes, views_go_near_to_the_markers_and_back) {
    for (CorrectView& view : scene_.views) {
        for (auto& place : view.places) {
            *place = 600.0 + 0.1 * *place;
        }
    }
    press(key_of(U'f'));
    EXPECT_GT(scene_.views[1].zoom.times, 3.0);
    const glm::vec2 seen = at(1, *scene_.views[1].places[0]);
    EXPECT_TRUE(seen.x > layout().views[1].x && seen.x < layout().views[1].right());
    press(key_of(U'f'));
    EXPECT_EQ(scene_.views[1].zoom, render::PictureZoom{});
}

TEST(CorrectLayouts, hold_everything_at_any_size_and_number_of_cameras) {
    for (const auto& [width, height] :
         {std::pair{1024.0F, 600.0F}, {1280.0F, 720.0F}, {1536.0F, 864.0F}}) {
        for (const std::size_t cameras : {2U, 4U, 6U, 8U, 17U}) {
            const std::vector<double> shapes(cameras, 16.0 / 9.0);
            for (const CorrectKind kind : {CorrectKind::markers, CorrectKind::joints}) {
                const CorrectLayout layout =
                    correct_layout({0.0F, 0.0F, width, height}, shapes, 20, std::nullopt, kind);
                EXPECT_LE(layout.track.right(), layout.undo.x);
                EXPECT_LE(layout.save.right(), width);
                EXPECT_LE(layout.markers.back().bottom(), layout.timeline.y);
                EXPECT_LE(layout.keys.bottom(), height);
                for (const Box& view : layout.views) {
                    EXPECT_GT(view.width, 100.0F);
                    EXPECT_LE(view.right(), layout.title.x);
                    EXPECT_LE(view.bottom(), layout.timeline.y);
                }
            }
        }
    }
}

}  // namespace
}  // namespace raks::apps
