#include "apps/grid/grid_pane.hpp"

#include <gtest/gtest.h>

#include <variant>
#include <vector>

namespace raks::apps::grid_pane_test {
namespace {

using render::Box;
using render::MouseButton;
using render::MouseButtonEvent;
using render::MouseDragEvent;
using render::WindowEvent;

/// The pane without a window: events in, the session changed.
class GridPanes : public ::testing::Test {
 protected:
    GridPanes() {
        motion::TakeGrid grid{"take", {}};
        for (int i = 0; i < 12; ++i) {
            grid.beats.push_back({1.0 + 0.5 * i, 1 + i % 2, true});
        }
        session_ = grid_session(grid, 20.0);
        cues_.impulse.resize(1201);
        cues_.hips_height.resize(1201, 1.0);
        cues_.feet_speed.resize(1201, 0.5);
        cues_.landings = {{2.0, motion::Side::left}, {2.5, motion::Side::right}};
        view_.cues = &cues_;
        view_.repeats = &repeats_;
        frames({});
    }

    [[nodiscard]] GridLayout layout() const {
        return grid_layout({0.0F, 0.0F, 1280.0F, 720.0F}, view_.song != nullptr);
    }
    [[nodiscard]] glm::vec2 at(double time) const {
        const GridLayout places = layout();
        return {place_of(places.lanes, view_, time), places.beats.y + 20.0F};
    }
    void frames(const std::vector<WindowEvent>& events) {
        context_.take(events);
        for (int frame = 0; frame < 2 || context_.has_waiting(); ++frame) {
            const auto wishes = grid_pane(context_.begin({}, pointer_), session_, view_);
            context_.end();
            for (const GridWish& wish : wishes) {
                if (const auto* const action = std::get_if<GridAction>(&wish)) {
                    apply(*action, session_);
                } else if (const auto* const seek = std::get_if<SeekTo>(&wish)) {
                    view_.now = seek->time;
                } else if (const auto* const range = std::get_if<ShowRange>(&wish)) {
                    view_.from = range->from;
                    view_.to = range->to;
                } else {
                    saves_ += std::holds_alternative<SaveGrid>(wish) ? 1 : 0;
                    plays_ += std::holds_alternative<PlayOrRest>(wish) ? 1 : 0;
                    closes_ += std::holds_alternative<CloseGrid>(wish) ? 1 : 0;
                }
            }
        }
    }
    void drag(const glm::vec2& from, const glm::vec2& to) {
        pointer_ = {from.x, from.y};
        frames({MouseButtonEvent{MouseButton::left, true, from.x, from.y}});
        pointer_ = {to.x, to.y};
        frames({MouseDragEvent{.x = to.x, .y = to.y}});
        frames({MouseButtonEvent{MouseButton::left, false, to.x, to.y}});
    }
    void click(const Box& box) {
        const glm::vec2 place{box.x + box.width / 2.0F, box.y + box.height / 2.0F};
        drag(place, place);
    }
    void press(Key key, bool has_control = false) {
        frames({KeyEvent{.key = key, .has_control = has_control}});
    }

    GridSession session_;
    motion::GridCues cues_;
    std::vector<motion::FoundLag> repeats_ = {{1.0, 4.0, 1.5, 0.2}};
    GridView view_;
    render::PaneContext context_;
    render::PointerPlace pointer_;
    int saves_ = 0;
    int plays_ = 0;
    int closes_ = 0;
};

TEST_F(GridPanes, a_press_on_a_beat_chooses_it_and_one_elsewhere_goes_there) {
    drag(at(2.5), at(2.5));
    EXPECT_EQ(session_.chosen, 3U);
    EXPECT_NEAR(view_.now, 2.5, 1e-6);
    EXPECT_FALSE(session_.beats.can_undo());
    drag(at(7.77), at(7.77));
    EXPECT_NEAR(view_.now, 7.77, 0.01);
}

TEST_F(GridPanes, a_beat_is_dragged_to_where_it_is_let_go) {
    drag(at(2.5), at(2.7));
    EXPECT_NEAR(session_.beats.now()[3].time, 2.7, 0.01);
    EXPECT_NEAR(view_.now, 2.7, 0.01) << "the body stands where the beat is";
    press(Key{U'u'});
    EXPECT_EQ(session_.beats.now()[3].time, 2.5);
    EXPECT_FALSE(session_.beats.can_undo()) << "a drag is one step";
}

TEST_F(GridPanes, keys_step_through_beats_and_move_one) {
    view_.now = 2.2;
    press(Key::down);
    EXPECT_EQ(session_.chosen, 3U);
    press(Key::down);
    EXPECT_EQ(session_.chosen, 4U);
    press(Key::up);
    EXPECT_EQ(session_.chosen, 3U);
    EXPECT_EQ(view_.now, 2.5);
    press(Key::right, true);
    EXPECT_NEAR(session_.beats.now()[3].time, 2.517, 1e-9);
    press(Key{U'1'});
    EXPECT_EQ(session_.beats.now()[3].half, 1);
}

TEST_F(GridPanes, taps_stretches_and_use_come_from_keys) {
    for (const double time : {7.1, 7.7}) {
        view_.now = time;
        press(Key{U't'});
    }
    EXPECT_EQ(session_.taps.size(), 2U);
    view_.now = 1.9;
    press(Key{U'['});
    EXPECT_TRUE(session_.taps.empty());
    EXPECT_EQ(session_.beats.now().size(), 14U);
    view_.now = 3.1;
    press(Key{U']'});
    press(Key{U'l'});
    EXPECT_FALSE(session_.beats.now()[2].is_used);
    EXPECT_TRUE(session_.beats.now()[5].is_used);
    press(Key{U'.'});
    EXPECT_NEAR(session_.beats.now()[2].time, 2.017, 1e-9);
    EXPECT_EQ(session_.beats.now()[6].time, 4.0);
}

TEST_F(GridPanes, buttons_do_what_is_on_them) {
    click(layout().half);
    EXPECT_EQ(session_.beats.now().size(), 6U);
    click(layout().twice);
    EXPECT_EQ(session_.beats.now().size(), 11U);
    click(layout().undo);
    click(layout().undo);
    EXPECT_EQ(session_.beats.now().size(), 12U);
    click(layout().remove);
    EXPECT_EQ(session_.beats.now().size(), 12U) << "none is chosen";
    click(layout().save);
    EXPECT_EQ(saves_, 0) << "nothing to save";
    click(layout().insert);
    click(layout().save);
    EXPECT_EQ(saves_, 1);
    click(layout().play);
    press(Key::space);
    EXPECT_EQ(plays_, 2);
    press(Key{U'q'});
    EXPECT_EQ(closes_, 1);
}

TEST_F(GridPanes, zoom_stays_within_the_clip) {
    press(Key{U'f'});
    EXPECT_EQ(view_.from, 0.0);
    EXPECT_EQ(view_.to, 20.0);
    press(Key{U'f'});
    EXPECT_NEAR(view_.to - view_.from, 10.0, 1e-9);
    for (int i = 0; i < 20; ++i) {
        press(Key::page_up);
    }
    EXPECT_NEAR(view_.to - view_.from, 2.0, 1e-9);
    for (int i = 0; i < 20; ++i) {
        press(Key::page_down);
    }
    EXPECT_EQ(view_.to - view_.from, 20.0);
}

TEST_F(GridPanes, stills_are_the_row_of_eight_beats_with_the_moment_and_their_half_beats) {
    const GridBeats& beats = session_.beats.now();
    const auto first = grid_stills(beats, 4.6);
    ASSERT_EQ(first.size(), layout().stills.size());
    EXPECT_EQ(first[0]->beat, 0U);
    EXPECT_EQ(first[7]->time, 4.5);
    EXPECT_EQ(first[8]->time, 1.25);
    EXPECT_TRUE(first[8]->is_half);
    const auto second = grid_stills(beats, 5.0);
    EXPECT_EQ(second[0]->beat, 8U);
    EXPECT_EQ(second[3]->beat, 11U);
    EXPECT_FALSE(second[4]);
    EXPECT_FALSE(second[11]) << "nothing follows the last beat";
    EXPECT_FALSE(grid_stills({}, 1.0)[0]);
}

TEST_F(GridPanes, a_press_on_a_still_goes_to_its_beat) {
    click(layout().stills[2]);
    EXPECT_EQ(session_.chosen, 2U);
    EXPECT_EQ(view_.now, 2.0);
    click(layout().stills[kGridStills + 2]);
    EXPECT_FALSE(session_.chosen);
    EXPECT_EQ(view_.now, 2.25);
}

TEST_F(GridPanes, parts_lie_in_the_window_and_not_over_one_another) {
    TakeMusic song;
    view_.song = &song;
    for (const bool has_song : {false, true}) {
        const GridLayout places = grid_layout({0.0F, 0.0F, 1280.0F, 720.0F}, has_song);
        EXPECT_LE(places.keys.bottom(), 720.0F);
        EXPECT_GT(places.figure.height, 150.0F);
        EXPECT_LE(places.figure.bottom(), places.lanes.y);
        EXPECT_LE(places.stills.back().right(), 1280.0F);
        EXPECT_LE(places.overview.bottom(), places.status.y);
        EXPECT_LE(has_song ? places.take_song.right() : places.even.right(), places.undo.x);
    }
    frames({});
}

}  // namespace
}  // namespace raks::apps::grid_pane_test
