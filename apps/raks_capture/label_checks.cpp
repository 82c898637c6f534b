#include "apps/raks_capture/label_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "base/printable.hpp"
#include "base/suggest.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using capture::MarkerLabel;

std::string words_of(const MarkerLabel& label) {
    return fmt::format("\"{}\" in picture {} of \"{}\"",
                       printable(label.marker, 40),
                       label.picture,
                       printable(label.camera, 40));
}

Expected<void> check_names(const MarkerLabel& label, const LabelledCapture& capture) {
    std::vector<std::string_view> cameras;
    for (const PlannedCamera& camera : capture.plan.cameras) {
        cameras.push_back(camera.name);
    }
    std::vector<std::string_view> markers;
    for (const capture::Marker& marker : capture.markers.markers) {
        markers.push_back(marker.name);
    }
    if (std::find(cameras.begin(), cameras.end(), label.camera) == cameras.end()) {
        return fail(unknown_name("camera", printable(label.camera, 40), cameras));
    }
    if (std::find(markers.begin(), markers.end(), label.marker) == markers.end()) {
        return fail(unknown_name("marker", printable(label.marker, 40), markers));
    }
    return {};
}

const capture::SeenFilm* film_of(const MarkerLabel& label, const LabelledCapture& capture) {
    if (capture.seen == nullptr) {
        return nullptr;
    }
    const auto& films = capture.seen->films;
    const auto film = std::find_if(films.begin(), films.end(), [&label](const auto& one) {
        return one.camera == label.camera;
    });
    return film != films.end() ? &*film : nullptr;
}

Expected<void> check_place(const MarkerLabel& label, const LabelledCapture& capture) {
    const auto camera = capture.rig != nullptr ? capture.rig->index_of(label.camera) : std::nullopt;
    if (camera) {
        const capture::Lens& lens = capture.rig->cameras[*camera].lens;
        if (!capture::is_in_picture(lens, label.pixel)) {
            return fail(
                fmt::format("{}: ({:.1f}, {:.1f}) lies outside of the picture, which has "
                            "{} x {}",
                            words_of(label),
                            label.pixel.x,
                            label.pixel.y,
                            lens.width,
                            lens.height));
        }
    }
    const capture::SeenFilm* const film = film_of(label, capture);
    if (film != nullptr && label.picture >= film->pictures.size()) {
        return fail(
            fmt::format("{}: the film has {} pictures", words_of(label), film->pictures.size()));
    }
    return {};
}

// The capture's time of a label, where film and clock are known.
std::optional<double> moment_of(const MarkerLabel& label, const LabelledCapture& capture) {
    const capture::SeenFilm* const film = film_of(label, capture);
    const auto clock = std::find_if(
        capture.clocks.begin(), capture.clocks.end(), [&label](const capture::Clock& one) {
            return one.camera == label.camera;
        });
    if (film == nullptr || clock == capture.clocks.end()) {
        return std::nullopt;
    }
    return clock->capture_time(film->pictures[label.picture].time);
}

// Whether two labels of a marker say where it is: by other cameras, at one moment as far as known.
bool are_of_one_moment(const MarkerLabel& one,
                       const MarkerLabel& other,
                       const LabelledCapture& capture) {
    if (one.camera == other.camera) {
        return false;
    }
    const auto first = moment_of(one, capture);
    const auto second = moment_of(other, capture);
    return !first || !second || std::abs(*first - *second) <= kOneMoment;
}

// How well a marker is labelled.
enum class Labelling { none, one_camera, other_moments, placed };

Labelling labelling_of(const std::string& marker,
                       const std::vector<MarkerLabel>& labels,
                       const LabelledCapture& capture) {
    std::vector<const MarkerLabel*> own;
    for (const MarkerLabel& label : labels) {
        if (label.marker == marker) {
            own.push_back(&label);
        }
    }
    if (own.empty()) {
        return Labelling::none;
    }
    Labelling found = Labelling::one_camera;
    for (const MarkerLabel* const one : own) {
        for (const MarkerLabel* const other : own) {
            if (are_of_one_moment(*one, *other, capture)) {
                return Labelling::placed;
            }
            found = one->camera != other->camera ? Labelling::other_moments : found;
        }
    }
    return found;
}

// One line for all markers of a kind of labelling; none: nothing to say.
void add_doubt(const std::vector<std::string>& markers,
               const char* what,
               std::vector<std::string>& doubts) {
    if (!markers.empty()) {
        doubts.push_back(fmt::format("{}: {}", fmt::join(markers, ", "), what));
    }
}

// A label that lies on a spot of another colour, while none of its own is near.
std::optional<std::string> colour_doubt(const MarkerLabel& label, const LabelledCapture& capture) {
    constexpr double kNear = 8.0;  // pixels
    const capture::SeenFilm* const film = film_of(label, capture);
    if (film == nullptr) {
        return std::nullopt;
    }
    const std::string& colour =
        capture.markers.markers[*capture.markers.index_of(label.marker)].colour;
    double own = std::numeric_limits<double>::infinity();
    double nearest = own;
    std::string other;
    for (const capture::Detection& spot : film->pictures[label.picture].detections) {
        const double distance = glm::distance(spot.pixel, label.pixel);
        const std::string& name = capture.seen->colours[spot.colour];
        if (name == colour) {
            own = std::min(own, distance);
        } else if (distance < nearest) {
            nearest = distance;
            other = name;
        }
    }
    if (own <= kNear || nearest > kNear) {
        return std::nullopt;
    }
    return fmt::format("{} is {}, but lies on a spot of {}",
                       words_of(label),
                       printable(colour, 40),
                       printable(other, 40));
}

}  // namespace

Expected<void> check_label_places(const std::vector<MarkerLabel>& labels,
                                  const LabelledCapture& capture) {
    for (const MarkerLabel& label : labels) {
        auto checked = check_names(label, capture);
        if (checked) {
            checked = check_place(label, capture);
        }
        if (!checked) {
            return checked;
        }
    }
    return {};
}

Expected<std::vector<std::string>> check_labels(const std::vector<MarkerLabel>& labels,
                                                const LabelledCapture& capture) {
    if (auto checked = check_label_places(labels, capture); !checked) {
        return fail(std::move(checked.error()));
    }
    std::vector<std::string> missing;
    std::vector<std::string> alone;
    std::vector<std::string> apart;
    for (const capture::Marker& marker : capture.markers.markers) {
        const Labelling labelling = labelling_of(marker.name, labels, capture);
        if (labelling == Labelling::none) {
            missing.push_back(marker.name);
        } else if (labelling == Labelling::one_camera) {
            alone.push_back(marker.name);
        } else if (labelling == Labelling::other_moments) {
            apart.push_back(marker.name);
        }
    }
    if (missing.size() + alone.size() + apart.size() == capture.markers.markers.size()) {
        return fail("no marker is labelled in two cameras at one moment, which gives its place");
    }
    std::vector<std::string> doubts;
    add_doubt(missing, "not labelled, so that they are found by colour alone, if at all", doubts);
    add_doubt(alone, "labelled in one camera alone; label them in a second one", doubts);
    add_doubt(
        apart,
        "labelled in two cameras, but at different moments; label them in pictures of one moment",
        doubts);
    for (const MarkerLabel& label : labels) {
        if (auto doubt = colour_doubt(label, capture)) {
            doubts.push_back(std::move(*doubt));
        }
    }
    return doubts;
}

}  // namespace raks::apps
