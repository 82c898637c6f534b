#include "apps/raks_capture/label_proposals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "motion/capture/triangulation/triangulation.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kOnLabel = 5.0;     // pixels: a spot so near a label is that marker
constexpr double kFromTwo = 12.0;    // pixels
constexpr double kFromLine = 4.0;    // pixels
constexpr double kLabelSigma = 2.0;  // pixels: how well people click
constexpr double kMuchBetter = 2.0;  // the second best must be so many times farther

/// How far each spot is from where a marker is expected; none: nothing is expected.
class ExpectedView {
 public:
    ExpectedView(const ProposalInput& input, std::size_t marker) : input_(input) {
        if (input.rig == nullptr) {
            return;
        }
        for (const OtherLabel& other : input.others) {
            if (other.marker == marker && other.camera != input.camera) {
                views_.push_back(
                    {other.camera,
                     capture::direction_of(input.rig->cameras[other.camera].lens, other.pixel)});
            }
        }
        if (views_.size() >= 2) {
            if (const auto point = capture::triangulate(*input.rig, views_, kLabelSigma)) {
                pixel_ = capture::project(input.rig->cameras[input.camera], point->place);
            }
        }
    }

    // Pixels, of those that are allowed; infinite where it is not the marker.
    [[nodiscard]] double distance(const glm::dvec2& spot) const {
        if (pixel_) {
            const double off = glm::distance(*pixel_, spot);
            return off <= kFromTwo ? off / kFromTwo : kNever;
        }
        if (views_.size() != 1) {
            return kNever;
        }
        const capture::Camera& here = input_.rig->cameras[input_.camera];
        const double off = capture::epipolar_distance(input_.rig->cameras[views_.front().camera],
                                                      views_.front().direction,
                                                      here,
                                                      capture::direction_of(here.lens, spot));
        return off <= kFromLine ? off / kFromLine : kNever;
    }
    [[nodiscard]] bool is_known() const { return pixel_ || views_.size() == 1; }

 private:
    const ProposalInput& input_;
    std::vector<capture::PointView> views_;
    std::optional<glm::dvec2> pixel_;
};

std::vector<LabelProposal> free_spots(const ProposalInput& input) {
    std::vector<LabelProposal> free;
    for (const capture::Detection& spot : input.spots) {
        const bool is_taken =
            std::any_of(input.labelled.begin(), input.labelled.end(), [&spot](const auto& label) {
                return label && glm::distance(*label, spot.pixel) < kOnLabel;
            });
        if (!is_taken) {
            free.push_back({spot.pixel, spot.colour, std::nullopt});
        }
    }
    return free;
}

// The best of some distances, where it is much better than the second.
std::optional<std::size_t> clear_best(const std::vector<double>& distances) {
    constexpr double kAsGoodAsZero = 0.15;  // share of the allowed
    const auto best = std::min_element(distances.begin(), distances.end());
    if (best == distances.end() || !std::isfinite(*best)) {
        return std::nullopt;
    }
    for (auto other = distances.begin(); other != distances.end(); ++other) {
        if (other != best && *other < kMuchBetter * std::max(*best, kAsGoodAsZero)) {
            return std::nullopt;
        }
    }
    return static_cast<std::size_t>(best - distances.begin());
}

// Names the free spots of one colour by where other cameras have its markers.
void name_by_cameras(const ProposalInput& input,
                     const std::vector<std::size_t>& markers,
                     const std::vector<std::size_t>& spots,
                     std::vector<LabelProposal>& proposals) {
    std::vector<std::vector<double>> by_marker;
    for (const std::size_t marker : markers) {
        const ExpectedView expected(input, marker);
        std::vector<double>& distances = by_marker.emplace_back();
        for (const std::size_t spot : spots) {
            distances.push_back(expected.distance(proposals[spot].pixel));
        }
    }
    for (std::size_t i = 0; i < markers.size(); ++i) {
        const auto spot = clear_best(by_marker[i]);
        if (!spot) {
            continue;
        }
        std::vector<double> of_spot;
        of_spot.reserve(by_marker.size());
        for (const auto& distances : by_marker) {
            of_spot.push_back(distances[*spot]);
        }
        if (clear_best(of_spot) == i) {
            proposals[spots[*spot]].marker = markers[i];
        }
    }
}

}  // namespace

std::vector<LabelProposal> propose_labels(const ProposalInput& input) {
    std::vector<LabelProposal> proposals = free_spots(input);
    const std::vector<std::size_t> classes = input.markers.classes();
    for (std::size_t colour = 0; colour < input.markers.colours().size(); ++colour) {
        std::vector<std::size_t> markers;
        for (std::size_t marker = 0; marker < classes.size(); ++marker) {
            if (classes[marker] == colour && !input.labelled[marker]) {
                markers.push_back(marker);
            }
        }
        std::vector<std::size_t> spots;
        for (std::size_t spot = 0; spot < proposals.size(); ++spot) {
            if (proposals[spot].colour == colour) {
                spots.push_back(spot);
            }
        }
        name_by_cameras(input, markers, spots, proposals);
        // The last pair, unless other cameras have the marker elsewhere.
        if (markers.size() == 1 && spots.size() == 1 &&
            !ExpectedView(input, markers.front()).is_known()) {
            proposals[spots.front()].marker = markers.front();
        }
    }
    return proposals;
}

}  // namespace raks::apps
