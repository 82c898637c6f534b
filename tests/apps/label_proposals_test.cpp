#include "apps/raks_capture/label_proposals.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "motion/capture/studio/point_studio.hpp"

namespace raks::apps {
namespace {

/// A body of points in a T-pose of the marker set, seen by the studio's ring.
class LabelProposals : public ::testing::Test {
 protected:
    LabelProposals() {
        for (std::size_t i = 0; i < markers_.markers.size(); ++i) {
            const double angle = 0.7 * static_cast<double>(i);
            places_.emplace_back(0.6 * std::cos(angle),
                                 0.15 + 0.08 * static_cast<double>(i),
                                 0.3 * std::sin(2.0 * angle));
        }
    }

    [[nodiscard]] glm::dvec2 pixel(std::size_t camera, std::size_t marker) const {
        return *capture::project(rig_.cameras[camera], places_[marker]);
    }
    /// All markers as spots in a camera.
    [[nodiscard]] std::vector<capture::Detection> spots(std::size_t camera) const {
        const auto classes = markers_.classes();
        std::vector<capture::Detection> all;
        for (std::size_t marker = 0; marker < classes.size(); ++marker) {
            all.push_back({pixel(camera, marker), classes[marker], 30.0});
        }
        return all;
    }
    [[nodiscard]] std::vector<OtherLabel> labelled_in(std::vector<std::size_t> cameras) const {
        std::vector<OtherLabel> labels;
        for (const std::size_t camera : cameras) {
            for (std::size_t marker = 0; marker < places_.size(); ++marker) {
                labels.push_back({camera, marker, pixel(camera, marker)});
            }
        }
        return labels;
    }
    /// How many of the proposals are named, all of them rightly.
    [[nodiscard]] std::size_t named(const std::vector<LabelProposal>& proposals) const {
        std::size_t count = 0;
        for (const LabelProposal& proposal : proposals) {
            if (proposal.marker) {
                EXPECT_LT(glm::distance(proposal.pixel, pixel(2, *proposal.marker)), 1e-9);
                ++count;
            }
        }
        return count;
    }
    [[nodiscard]] std::vector<LabelProposal> propose(const std::vector<OtherLabel>& others,
                                                     const capture::Rig* rig) const {
        const auto seen = spots(2);
        return propose_labels({markers_,
                               seen,
                               std::vector<std::optional<glm::dvec2>>(places_.size()),
                               rig,
                               2,
                               others});
    }

    capture::Rig rig_ = capture::studio_rig(6);
    capture::MarkerSet markers_ = capture::default_markers();
    std::vector<glm::dvec3> places_;
};

TEST_F(LabelProposals, two_labelled_cameras_name_every_marker_of_a_third) {
    EXPECT_EQ(named(propose(labelled_in({0, 1}), &rig_)), places_.size());
}

TEST_F(LabelProposals, one_labelled_camera_names_those_whose_line_meets_one_spot) {
    const std::size_t count = named(propose(labelled_in({0}), &rig_));
    EXPECT_GE(count, places_.size() / 2);
}

TEST_F(LabelProposals, without_other_cameras_spots_have_colours_alone) {
    const auto proposals = propose({}, &rig_);
    EXPECT_EQ(proposals.size(), places_.size());
    EXPECT_EQ(named(proposals), 0U);
    EXPECT_EQ(named(propose(labelled_in({0, 1}), nullptr)), 0U) << "no rig, no lines";
}

TEST_F(LabelProposals, the_last_of_a_colour_is_named_by_it_alone) {
    const auto classes = markers_.classes();
    std::vector<std::optional<glm::dvec2>> labelled(places_.size());
    std::optional<std::size_t> last;
    for (std::size_t marker = 0; marker < places_.size(); ++marker) {
        if (classes[marker] == 0 && last) {
            labelled[marker] = pixel(2, marker);
        } else if (classes[marker] == 0) {
            last = marker;
        }
    }
    const auto seen = spots(2);
    const auto proposals = propose_labels({markers_, seen, labelled, nullptr, 0, {}});
    EXPECT_EQ(named(proposals), 1U);
    for (const LabelProposal& proposal : proposals) {
        EXPECT_NE(proposal.colour == 0, !proposal.marker) << "labelled spots are proposed no more";
    }
}

TEST_F(LabelProposals, spots_that_could_be_either_are_not_named) {
    auto seen = spots(2);
    seen.push_back(seen.front());
    seen.back().pixel += glm::dvec2(0.5, 0.5);
    const auto others = labelled_in({0, 1});
    const auto proposals = propose_labels(
        {markers_, seen, std::vector<std::optional<glm::dvec2>>(places_.size()), &rig_, 2, others});
    EXPECT_EQ(named(proposals), places_.size() - 1);
    EXPECT_FALSE(proposals.front().marker);
}

}  // namespace
}  // namespace raks::apps
