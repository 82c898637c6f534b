#include "apps/raks_capture/correct_session.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "motion/capture/studio/point_studio.hpp"

namespace raks::apps {
namespace {

using capture::Doubt;
using capture::Edit;
using capture::EditKind;
using capture::PlaceSource;

/// A hundred frames of the shipped markers, 50 a second, all seen with 5 mm.
class CorrectSessions : public ::testing::Test {
 protected:
    CorrectSessions() {
        session_.cameras = {"left", "right"};
        for (const capture::Marker& marker : capture::default_markers().markers) {
            session_.tracks.markers.push_back(marker.name);
        }
        session_.tracks.frames_per_second = 50.0;
        session_.tracks.frame_count = 100;
        session_.tracks.places.resize(100 * session_.tracks.markers.size(),
                                      {glm::dvec3(0.0), 0.005, 3, PlaceSource::seen});
        session_.tracks.flags = {
            {Doubt::lost, 4, 0, 2}, {Doubt::exchanged, 1, 30, 34}, {Doubt::filled, 2, 30, 44}};
    }

    void act(const CorrectAction& action) { apply(action, session_); }
    [[nodiscard]] const std::vector<Edit>& edits() const { return session_.edits.now(); }
    [[nodiscard]] std::string text() const { return capture::edits_text(edits()); }
    void drag(std::size_t camera, glm::dvec2 to) {
        act(HoldMarker{{camera, {1.0, 2.0}, {1.0, 2.0}, false}});
        act(HoldMarker{{camera, {1.0, 2.0}, to, true}});
        act(LetGoOfMarker{});
    }

    CorrectSession session_;
};

TEST_F(CorrectSessions, a_drag_sets_the_marker_in_that_camera_at_this_frame) {
    act(ShowFrame{12});
    drag(1, {310.504, 92.0});
    EXPECT_EQ(text(),
              R"({"camera":"right","edit":"set","frame":12,"marker":"head","u":310.5,"v":92.0})"
              "\n");
    drag(1, {320.0, 92.0});
    EXPECT_EQ(edits().size(), 1U) << "the same again replaces it";
    drag(0, {320.0, 92.0});
    EXPECT_EQ(edits().size(), 2U);
    act(UndoEdit{});
    act(UndoEdit{});
    EXPECT_EQ(edits().front().pixel, glm::dvec2(310.5, 92.0));
}

TEST_F(CorrectSessions, a_press_that_does_not_move_sets_nothing) {
    act(HoldMarker{{0, {1.0, 2.0}, {1.0, 2.0}, false}});
    act(LetGoOfMarker{});
    EXPECT_TRUE(edits().empty());
    EXPECT_FALSE(session_.held);
}

TEST_F(CorrectSessions, two_markers_are_swapped_from_this_frame_on) {
    act(ChooseMarker{3});
    act(ShowFrame{40});
    act(BeginSwap{});
    act(ChooseMarker{7});
    ASSERT_EQ(edits().size(), 1U);
    EXPECT_EQ(edits().front().kind, EditKind::swap);
    EXPECT_EQ(edits().front().marker, session_.tracks.markers[3]);
    EXPECT_EQ(edits().front().other, session_.tracks.markers[7]);
    EXPECT_EQ(edits().front().first, 40U);
    EXPECT_EQ(session_.marker, 3U);
    act(BeginSwap{});
    act(ChooseMarker{3});
    EXPECT_EQ(edits().size(), 1U) << "none is swapped with itself";
    act(BeginSwap{});
    act(ForgetStretch{});
    act(ChooseMarker{7});
    EXPECT_EQ(session_.marker, 7U);
}

TEST_F(CorrectSessions, hide_and_fill_are_about_the_stretch_the_flag_or_the_frame) {
    act(ChooseMarker{1});
    act(ShowFrame{20});
    EXPECT_EQ(session_.meant(), (FrameStretch{20, 20}));
    act(ShowFrame{33});
    EXPECT_EQ(session_.meant(), (FrameStretch{30, 34}));
    act(SetStretch{.is_first = false});
    act(ShowFrame{28});
    act(SetStretch{.is_first = true});
    EXPECT_EQ(session_.meant(), (FrameStretch{28, 33}));
    act(HideMarker{});
    act(FillMarker{});
    ASSERT_EQ(edits().size(), 2U);
    EXPECT_EQ(edits()[0].kind, EditKind::hide);
    EXPECT_EQ((FrameStretch{edits()[0].first, edits()[0].last}), (FrameStretch{28, 33}));
    EXPECT_EQ(edits()[1].kind, EditKind::fill);
    EXPECT_EQ((FrameStretch{edits()[1].first, edits()[1].last}), (FrameStretch{28, 28}));
}

TEST_F(CorrectSessions, a_stretch_begins_before_it_ends) {
    act(ShowFrame{50});
    act(SetStretch{.is_first = true});
    act(ShowFrame{40});
    act(SetStretch{.is_first = false});
    EXPECT_EQ(session_.stretch, (FrameStretch{40, 40}));
}

TEST_F(CorrectSessions, every_flag_is_visited_both_ways) {
    const auto here = [&] { return std::pair(session_.frame, session_.marker); };
    const std::pair<std::size_t, std::size_t> flags[] = {{0, 4}, {30, 1}, {30, 2}};
    for (const auto& flag : flags) {
        act(ShowFlag{.is_next = true});
        EXPECT_EQ(here(), flag);
    }
    act(ShowFlag{.is_next = true});
    EXPECT_EQ(here(), flags[2]) << "the last stays";
    act(ShowFlag{.is_next = false});
    EXPECT_EQ(here(), flags[1]);
    act(ShowFlag{.is_next = false});
    EXPECT_EQ(here(), flags[0]);
}

TEST_F(CorrectSessions, worst_frames_are_lost_ones_then_those_with_the_largest_error) {
    session_.tracks.at(60, 0).deviation = 0.09;
    session_.tracks.at(61, 0).deviation = 0.08;
    session_.tracks.at(10, 0).source = PlaceSource::lost;
    act(ShowWorst{});
    EXPECT_EQ(session_.frame, 10U);
    act(ShowWorst{});
    EXPECT_EQ(session_.frame, 60U);
    act(ShowWorst{});
    EXPECT_GE(session_.frame > 60 ? session_.frame - 60 : 60 - session_.frame, 25U);
}

TEST_F(CorrectSessions, frames_end_with_the_tracks) {
    act(ShowFrame{1000});
    EXPECT_EQ(session_.frame, 99U);
    act(TogglePlay{});
    EXPECT_EQ(session_.frame, 0U) << "at the end it plays from the start";
}

/// The same of a take without markers.
class CorrectJoints : public CorrectSessions {
 protected:
    CorrectJoints() {
        session_.is_of_joints = true;
        session_.tracks.markers = {"nose", "left_wrist", "right_ankle"};
        session_.tracks.places.resize(300);
        session_.tracks.flags = {{Doubt::jumped, 1, 30, 34, "right"},
                                 {Doubt::lost, 2, 50, 60},
                                 {Doubt::person, 0, 70, 79, "left"}};
    }
};

TEST_F(CorrectJoints, a_flag_leads_to_its_camera_and_its_frames_are_edited) {
    act(ShowFlag{.is_next = true});
    act(HideMarker{});
    EXPECT_EQ(text(),
              R"({"camera":"right","edit":"hide","first":30,"last":34,"marker":"left_wrist"})"
              "\n");
    act(ShowFlag{.is_next = true});
    act(ShowFlag{.is_next = true});
    EXPECT_EQ(session_.camera, 0U);
    act(HideView{});
    EXPECT_EQ(edits().back(),
              (Edit{.kind = EditKind::hide, .camera = "left", .first = 70, .last = 79}));
    act(UndoEdit{});
    EXPECT_EQ(edits().size(), 1U);
}

TEST_F(CorrectJoints, sides_are_exchanged_in_the_view_that_was_chosen) {
    act(ChooseView{1});
    act(ShowFrame{40});
    act(SetStretch{.is_first = true});
    act(ShowFrame{44});
    act(SetStretch{.is_first = false});
    act(ExchangeSides{});
    const Edit all{.kind = EditKind::exchange, .camera = "right", .first = 40, .last = 44};
    EXPECT_EQ(edits().back(), all);
    for (const auto& [marker, limbs] : {std::pair(1U, "arms"), {2U, "legs"}, {0U, ""}}) {
        act(ChooseMarker{marker});
        act(ExchangeSides{.is_of_limb = true});
        EXPECT_EQ(edits().back().limbs, limbs);
        EXPECT_EQ(edits().back().first, 44U) << "this frame alone, without a stretch";
    }
}

TEST_F(CorrectJoints, frames_that_another_view_or_none_is_doubted_in_are_not_meant) {
    act(ShowFrame{32});
    act(ChooseView{0});
    act(HideView{});
    EXPECT_EQ(edits().back().last, 32U) << "jumped in the right view alone";
    act(ShowFrame{55});
    act(ChooseMarker{2});
    act(ExchangeSides{});
    EXPECT_EQ(edits().back().last, 55U) << "lost is no reason to exchange anything";
}

TEST(EditChecks, name_what_there_is_not) {
    const capture::MarkerSet markers = capture::default_markers();
    const capture::Rig rig = capture::studio_rig(6);
    const auto fault = [&](const char* line) {
        const auto edits = capture::read_edits(line, "edits.jsonl");
        EXPECT_TRUE(edits) << line;
        const auto checked = check_edits(*edits, markers, rig);
        return checked ? std::string() : checked.error().message;
    };
    EXPECT_EQ(fault(R"({"edit": "hide", "marker": "head", "first": 1, "last": 2})"), "");
    EXPECT_EQ(fault(R"({"edit": "hide", "marker": "haed", "first": 1, "last": 2})"),
              "edit 1: marker \"haed\" is unknown; did you mean \"head\"?");
    EXPECT_EQ(fault(R"({"edit": "swap", "marker": "head", "other": "c77", "frame": 2})"),
              "edit 1: marker \"c77\" is unknown; did you mean \"c7\"?");
    EXPECT_EQ(
        fault(
            R"({"edit": "set", "marker": "head", "camera": "cam11", "frame": 2, "u": 1, "v": 1})"),
        "edit 1: camera \"cam11\" is unknown; did you mean \"cam1\"?");
    EXPECT_NE(
        fault(
            R"({"edit": "set", "marker": "head", "camera": "cam1", "frame": 2, "u": 9999, "v": 1})")
            .find("lies outside of the picture"),
        std::string::npos);
}

}  // namespace
}  // namespace raks::apps
