#include "apps/raks_capture/label_spots.hpp"

#include <algorithm>
#include <span>

#include "motion/capture/pictures/marker_finder.hpp"

namespace raks::apps {
namespace {

constexpr double kSmallest = 0.15;  // of the smallest region that was learnt from
constexpr double kLargest = 6.0;    // of the largest
constexpr double kLeastSpot = 6.0;  // pixels

// One colour from the examples that show it alike; none: no example shows a colour.
std::optional<capture::ColourModel> learnt_from(const capture::PictureView& picture,
                                                const std::vector<ColourExample>& examples,
                                                std::size_t colour) {
    std::vector<capture::ColourPoint> points;
    for (const ColourExample& example : examples) {
        const capture::ColourPoint point{0, example.pixel};
        if (example.colour == colour &&
            capture::learn_colour(std::span(&picture, 1), std::span(&point, 1))) {
            points.push_back(point);
        }
    }
    const auto model = capture::learn_colour(std::span(&picture, 1), points);
    return model ? std::optional(*model) : std::nullopt;
}

}  // namespace

std::vector<capture::Detection> LabelSpots::find(const capture::PictureView& picture,
                                                 const std::vector<ColourExample>& examples) {
    std::vector<capture::ColourModel> models;
    std::vector<std::size_t> colours;
    for (std::size_t colour = 0; colour < models_.size(); ++colour) {
        if (auto model = learnt_from(picture, examples, colour)) {
            models_[colour] = *model;
        }
        if (models_[colour]) {
            models.push_back(*models_[colour]);
            colours.push_back(colour);
        }
    }
    if (models.empty()) {
        return {};
    }
    const auto [least, most] = std::minmax_element(
        models.begin(), models.end(), [](const auto& a, const auto& b) { return a.area < b.area; });
    auto finder =
        capture::MarkerFinder::create(models,
                                      {.least_area = std::max(kLeastSpot, kSmallest * least->area),
                                       .greatest_area = std::max(kLargest * most->area, 100.0)});
    std::vector<capture::Detection> found;
    if (finder) {
        for (const capture::Spot& spot : finder->find(picture)) {
            found.push_back(spot.detection);
            found.back().colour = colours[spot.detection.colour];
        }
    }
    return found;
}

}  // namespace raks::apps
