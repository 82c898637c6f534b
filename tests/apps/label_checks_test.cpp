#include "apps/raks_capture/label_checks.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "motion/capture/studio/point_studio.hpp"

namespace raks::apps {
namespace {

using capture::MarkerLabel;

/// Six cameras of the studio, films of two pictures, clocks that agree; all markers labelled in two
/// cameras.
class LabelChecks : public ::testing::Test {
 protected:
    LabelChecks() {
        seen_.colours = {"green", "blue"};
        for (const capture::Camera& camera : rig_.cameras) {
            plan_.cameras.push_back({camera.name, {}, {}, 0.0});
            seen_.films.push_back({camera.name, {{0.0, {}}, {1.0, {}}}});
            clocks_.push_back({camera.name, 0.0, 0.0, 1.0});
        }
        for (const capture::Marker& marker : markers_.markers) {
            labels_.push_back({"cam1", 0, marker.name, {100.0, 50.0}});
            labels_.push_back({"cam2", 0, marker.name, {200.0, 60.0}});
        }
    }

    [[nodiscard]] LabelledCapture known() const {
        return {plan_, markers_, &rig_, &seen_, clocks_};
    }
    [[nodiscard]] std::string fault() const {
        const auto checked = check_labels(labels_, known());
        return checked ? "" : checked.error().message;
    }
    [[nodiscard]] std::vector<std::string> doubts() const {
        return check_labels(labels_, known()).value();
    }

    capture::Rig rig_ = capture::studio_rig(6);
    capture::MarkerSet markers_ = capture::default_markers();
    CapturePlan plan_;
    capture::Observations seen_;
    std::vector<capture::Clock> clocks_;
    std::vector<MarkerLabel> labels_;
};

TEST_F(LabelChecks, have_no_doubt_where_all_markers_are_in_two_cameras_at_one_moment) {
    EXPECT_TRUE(doubts().empty());
}

TEST_F(LabelChecks, name_what_the_capture_has_not) {
    labels_[3].camera = "cam11";
    EXPECT_EQ(fault(), "camera \"cam11\" is unknown; did you mean \"cam1\"?");
    labels_[3].camera = "cam1";
    labels_[3].marker = "left_sholder";
    EXPECT_EQ(fault(), "marker \"left_sholder\" is unknown; did you mean \"left_shoulder\"?");
}

TEST_F(LabelChecks, refuse_places_outside_of_the_picture_and_the_film) {
    labels_[0].pixel.x = 5000.0;
    EXPECT_NE(fault().find("\"head\" in picture 0 of \"cam1\": (5000.0, 50.0) lies outside"),
              std::string::npos)
        << fault();
    labels_[0].pixel.x = 100.0;
    labels_[0].picture = 2;
    EXPECT_EQ(fault(), "\"head\" in picture 2 of \"cam1\": the film has 2 pictures");
}

TEST_F(LabelChecks, need_one_marker_whose_place_they_give) {
    for (MarkerLabel& label : labels_) {
        label.picture = label.camera == "cam2" ? 1 : 0;
    }
    EXPECT_NE(fault().find("no marker is labelled in two cameras at one moment"),
              std::string::npos);
    // By a clock that is a second ahead the two pictures are of one moment.
    clocks_[1].offset = -1.0;
    EXPECT_EQ(fault(), "");
}

TEST_F(LabelChecks, say_which_markers_lack_a_label) {
    labels_.erase(labels_.begin(), labels_.begin() + 3);  // head, and c7 in cam1
    labels_.back().picture = 1;                           // the last marker in cam2
    const auto said = doubts();
    ASSERT_EQ(said.size(), 3U);
    EXPECT_EQ(said[0], "head: not labelled, so that they are found by colour alone, if at all");
    EXPECT_EQ(said[1], "c7: labelled in one camera alone; label them in a second one");
    EXPECT_EQ(said[2],
              "right_toe: labelled in two cameras, but at different moments; label them in "
              "pictures of one moment");
}

TEST_F(LabelChecks, doubt_a_label_on_a_spot_of_another_colour) {
    // The head is green; a blue spot lies under its label, and no green one near.
    seen_.films[0].pictures[0].detections = {{{102.0, 50.0}, 1, 0.0}, {{300.0, 50.0}, 0, 0.0}};
    labels_.resize(2);
    const auto said = doubts();
    EXPECT_EQ(said.back(),
              "\"head\" in picture 0 of \"cam1\" is green, but lies on a spot of blue");
    seen_.films[0].pictures[0].detections.push_back({{104.0, 50.0}, 0, 0.0});
    EXPECT_EQ(doubts().size(), said.size() - 1);
}

TEST_F(LabelChecks, do_with_what_is_known_before_films_are_searched) {
    const auto checked = check_labels(labels_, {plan_, markers_, nullptr, nullptr, {}});
    ASSERT_TRUE(checked);
    EXPECT_TRUE(checked->empty());
}

}  // namespace
}  // namespace raks::apps
