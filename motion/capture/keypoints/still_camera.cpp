#include "motion/capture/keypoints/still_camera.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kFewestPlaces = 8;
constexpr std::size_t kMostPlaces = 240;  // more are taken together
// Shares of the picture's longer side. Backgrounds of still cameras, filmed and compressed, wander
// by up to 0.0002.
constexpr double kLeastCameraStep = 0.003;
constexpr double kLeastCameraWander = 0.0025;
constexpr double kLeastCameraZoom = 0.03;  // a lens that finds its focus changes sizes by 1 %

/// The background at one moment.
struct SeenBackground {
    double time = 0.0;
    BackgroundPlace place;
};

using Places = std::span<const SeenBackground>;

template <typename Number>
double middle_of(Places places, const Number& number) {
    std::vector<double> numbers;
    numbers.reserve(places.size());
    for (const SeenBackground& seen : places) {
        numbers.push_back(number(seen));
    }
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::nth_element(numbers.begin(), middle, numbers.end());
    return *middle;
}

glm::dvec2 middle_place(Places places) {
    return {middle_of(places, [](const SeenBackground& seen) { return seen.place.move.x; }),
            middle_of(places, [](const SeenBackground& seen) { return seen.place.move.y; })};
}

double middle_size(Places places) {
    return middle_of(places, [](const SeenBackground& seen) { return seen.place.size; });
}

// The mean distance from a place.
double wander_about(Places places, const glm::dvec2& middle) {
    double sum = 0.0;
    for (const SeenBackground& seen : places) {
        sum += glm::distance(seen.place.move, middle);
    }
    return sum / static_cast<double>(places.size());
}

// Each by itself and its neighbours: a single one that is wrong goes.
std::vector<SeenBackground> without_single(Places places) {
    std::vector<SeenBackground> steady(places.begin(), places.end());
    for (std::size_t i = 0; places.size() >= 3 && i < places.size(); ++i) {
        const std::size_t first = std::clamp<std::size_t>(i, 1, places.size() - 2) - 1;
        const Places three = places.subspan(first, 3);
        steady[i].place = {middle_place(three), middle_size(three)};
    }
    return steady;
}

std::vector<SeenBackground> backgrounds_of(const KeypointFilm& film) {
    std::vector<SeenBackground> all;
    for (const KeypointPicture& picture : film.pictures) {
        if (picture.background) {
            all.push_back({picture.time, *picture.background});
        }
    }
    return all;
}

std::vector<SeenBackground> places_of(const KeypointFilm& film) {
    std::vector<SeenBackground> all = without_single(backgrounds_of(film));
    if (all.size() <= kMostPlaces) {
        return all;
    }
    std::vector<SeenBackground> few;
    for (std::size_t i = 0; i < kMostPlaces; ++i) {
        const std::size_t first = i * all.size() / kMostPlaces;
        const std::size_t end = (i + 1) * all.size() / kMostPlaces;
        const Places some = Places(all).subspan(first, end - first);
        few.push_back({some[some.size() / 2].time, {middle_place(some), middle_size(some)}});
    }
    return few;
}

/// How long the background is not seen.
struct Unseen {
    double since = 0.0;        // the film's time
    double at_end = 0.0;       // seconds
    double longest_gap = 0.0;  // seconds, before that
};

// Precondition: it is seen once.
Unseen unseen_of(const KeypointFilm& film, Places seen) {
    Unseen unseen{seen.back().time, film.pictures.back().time - seen.back().time, 0.0};
    double last = film.pictures.front().time;
    for (const SeenBackground& one : seen) {
        unseen.longest_gap = std::max(unseen.longest_gap, one.time - last);
        last = one.time;
    }
    return unseen;
}

// Turned so far at once that the background cannot be followed. A person who walks up to the camera
// to end the film, or sits down before it for a while, covers it for less long.
std::optional<double> moment_of_loss(const KeypointFilm& film) {
    constexpr double kLost = 8.0;     // seconds
    constexpr double kClearly = 4.0;  // times as long as ever before
    const std::vector<SeenBackground> seen = backgrounds_of(film);
    if (seen.size() < kFewestPlaces) {
        return std::nullopt;
    }
    const Unseen unseen = unseen_of(film, seen);
    return unseen.at_end >= std::max(kLost, kClearly * unseen.longest_gap)
               ? std::optional(unseen.since)
               : std::nullopt;
}

/// A moment after which the background is elsewhere.
struct CameraStep {
    double time = 0.0;
    double distance = 0.0;  // pixels
    double wander = 0.0;    // on its two sides
};

// The moment that leaves the least wandering on its two sides.
CameraStep clearest_step(Places places) {
    constexpr std::size_t kFewestASide = 3;
    CameraStep best{0.0, 0.0, 1e9};
    for (std::size_t cut = kFewestASide; cut + kFewestASide <= places.size(); ++cut) {
        const Places before = places.first(cut);
        const Places after = places.subspan(cut);
        const glm::dvec2 one = middle_place(before);
        const glm::dvec2 other = middle_place(after);
        const double share = static_cast<double>(cut) / static_cast<double>(places.size());
        const double wander =
            share * wander_about(before, one) + (1.0 - share) * wander_about(after, other);
        if (wander < best.wander) {
            best = {
                0.5 * (before.back().time + after.front().time), glm::distance(one, other), wander};
        }
    }
    return best;
}

}  // namespace

std::string why_not_still(const KeypointFilm& film) {
    if (const auto lost = moment_of_loss(film)) {
        return fmt::format(
            "was turned, or is covered, at {:.1f} s of its film: nothing of its background is seen "
            "from there on; use the films before it alone, or film again",
            *lost);
    }
    const std::vector<SeenBackground> seen = places_of(film);
    if (seen.size() < kFewestPlaces) {
        return {};
    }
    const Places places(seen);
    const std::size_t third = seen.size() / 3;
    const double growth = middle_size(places.last(third)) / middle_size(places.first(third));
    if (std::abs(growth - 1.0) >= kLeastCameraZoom) {
        return fmt::format(
            "zooms: its background is {:.0f} % {} in the end; switch zoom and stabilising off, and "
            "film again",
            100.0 * std::abs(growth - 1.0),
            growth > 1.0 ? "larger" : "smaller");
    }
    const double side = std::max(film.width, film.height);
    const CameraStep step = clearest_step(places);
    constexpr double kClearly = 6.0;  // times what it wanders on its sides; of a slow turn it is 4
    if (step.distance >= kLeastCameraStep * side && step.distance >= kClearly * step.wander) {
        return fmt::format(
            "was moved at {:.1f} s of its film: its background is {:.0f} pixels elsewhere from "
            "there on; use the films before or after it alone, or film again",
            step.time,
            step.distance);
    }
    const double wander = wander_about(places, middle_place(places));
    if (wander >= kLeastCameraWander * side) {
        return fmt::format(
            "does not stand still: its background wanders by {:.0f} pixels; fix the phone, and "
            "switch off what stabilises the picture",
            wander);
    }
    return {};
}

bool surely_stood_still(const KeypointFilm& film) {
    constexpr double kLongestGap = 3.0;  // seconds
    const std::vector<SeenBackground> seen = backgrounds_of(film);
    if (seen.size() < kFewestPlaces || !why_not_still(film).empty()) {
        return false;
    }
    const Unseen unseen = unseen_of(film, seen);
    return std::max(unseen.longest_gap, unseen.at_end) <= kLongestGap;
}

}  // namespace raks::capture
