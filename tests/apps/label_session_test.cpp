#include "apps/raks_capture/label_session.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace raks::apps {
namespace {

using capture::MarkerLabel;

class LabelSessions : public ::testing::Test {
 protected:
    void act(const LabelAction& action) { apply(action, session_); }
    [[nodiscard]] std::size_t marker(const char* name) const {
        return *session_.markers.index_of(name);
    }
    [[nodiscard]] const std::vector<MarkerLabel>& labels() const { return session_.labels.now(); }
    void label(const char* name, glm::dvec2 pixel) {
        act(PickPixel{pixel});
        act(ChooseName{marker(name)});
    }

    LabelSession session_ = label_session({"left", "right"}, capture::default_markers(), {});
};

TEST_F(LabelSessions, a_place_gets_the_name_that_is_chosen_after_it) {
    act(PickPixel{{100.256, 50.0}});
    EXPECT_TRUE(labels().empty());
    act(ChooseName{marker("c7")});
    EXPECT_EQ(labels(), (std::vector<MarkerLabel>{{"left", 0, "c7", {100.26, 50.0}}}));
    EXPECT_FALSE(session_.picked);
}

TEST_F(LabelSessions, a_name_that_is_chosen_first_gets_the_place_and_the_next_name_follows) {
    act(ChooseName{marker("head")});
    act(PickPixel{{10.0, 20.0}});
    EXPECT_EQ(session_.chosen, marker("c7"));
    act(PickPixel{{11.0, 40.0}});
    EXPECT_EQ(labels().size(), 2U);
    EXPECT_EQ(labels()[1].marker, "c7");
    act(ChooseName{*session_.chosen});
    EXPECT_FALSE(session_.chosen) << "the same once more chooses none";
}

TEST_F(LabelSessions, two_labels_exchange_names_that_meet) {
    label("head", {10.0, 20.0});
    label("c7", {10.0, 40.0});
    act(PickPixel{{10.0, 20.0}});
    act(ChooseName{marker("c7")});
    EXPECT_EQ(labels(),
              (std::vector<MarkerLabel>{{"left", 0, "head", {10.0, 40.0}},
                                        {"left", 0, "c7", {10.0, 20.0}}}));
    act(PickPixel{{10.0, 20.0}});
    act(ChooseName{marker("sternum")});
    EXPECT_EQ(labels()[1].marker, "sternum") << "a free name is just taken";
    EXPECT_EQ(labels().size(), 2U);
}

TEST_F(LabelSessions, a_drag_is_one_step_and_a_click_on_a_label_picks_it) {
    label("head", {10.0, 20.0});
    act(MoveLabel{{marker("head"), {10.0, 21.0}, false}});
    act(LetGoOfLabel{});
    EXPECT_EQ(session_.picked, glm::dvec2(10.0, 20.0));
    act(ForgetChoice{});
    for (double x = 11.0; x < 30.0; x += 1.0) {
        act(MoveLabel{{marker("head"), {x, 25.0}, true}});
    }
    EXPECT_EQ(labels().front().pixel, glm::dvec2(10.0, 20.0)) << "until it is let go";
    act(LetGoOfLabel{});
    EXPECT_EQ(labels().front().pixel, glm::dvec2(29.0, 25.0));
    act(UndoLabels{});
    EXPECT_EQ(labels().front().pixel, glm::dvec2(10.0, 20.0));
    act(RedoLabels{});
    EXPECT_EQ(labels().front().pixel, glm::dvec2(29.0, 25.0));
}

TEST_F(LabelSessions, cameras_and_pictures_have_labels_of_their_own) {
    label("head", {10.0, 20.0});
    act(ShowCamera{1});
    label("head", {70.0, 20.0});
    act(ShowPicture{3});
    EXPECT_EQ(session_.label_of(marker("head")), nullptr);
    label("head", {90.0, 20.0});
    EXPECT_EQ(labels().size(), 3U);
    EXPECT_EQ(session_.cameras_of(marker("head")), 2U);
    act(RemoveLabel{marker("head")});
    EXPECT_EQ(labels().size(), 2U);
    act(ShowCamera{0});
    EXPECT_EQ(session_.labelled_in(0), 1U);
    EXPECT_EQ(session_.picture(), 0U);
}

TEST_F(LabelSessions, proposals_with_a_marker_are_taken_in_one_step) {
    act(AcceptProposals{{{{5.0, 6.0}, 0, marker("head")},
                         {{7.0, 8.0}, 1, std::nullopt},
                         {{9.0, 9.0}, 2, marker("sternum")}}});
    EXPECT_EQ(labels().size(), 2U);
    act(UndoLabels{});
    EXPECT_TRUE(labels().empty());
}

TEST_F(LabelSessions, the_order_of_the_work_leaves_no_trace_in_the_file) {
    LabelSession other = session_;
    label("head", {1.0, 2.0});
    label("left_toe", {3.0, 4.0});
    act(ShowCamera{1});
    label("c7", {5.0, 6.0});
    const std::string one = capture::labels_text(labels());
    session_ = other;
    act(ShowCamera{1});
    label("c7", {5.0, 6.0});
    act(ShowCamera{0});
    label("left_toe", {3.0, 4.0});
    label("head", {1.0, 2.0});
    EXPECT_EQ(capture::labels_text(labels()), one);
}

TEST_F(LabelSessions, goes_on_with_the_pictures_that_are_labelled_already) {
    const LabelSession session = label_session(
        {"left", "right"}, capture::default_markers(), {{"right", 7, "head", {1.0, 2.0}}});
    EXPECT_EQ(session.pictures, (std::vector<std::size_t>{0, 7}));
    EXPECT_TRUE(session.labels.is_saved());
}

TEST_F(LabelSessions, begins_with_pictures_of_one_moment_where_nothing_is_labelled) {
    const LabelSession session = label_session(
        {"left", "right"}, capture::default_markers(), {{"right", 7, "head", {1.0, 2.0}}}, {12, 3});
    EXPECT_EQ(session.pictures, (std::vector<std::size_t>{12, 7}));
}

}  // namespace
}  // namespace raks::apps
