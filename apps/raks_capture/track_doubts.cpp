#include "apps/raks_capture/track_doubts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

// Markers that are lost most of the time, in one line; empty: none.
std::string lost_markers(const capture::Tracks& tracks) {
    std::vector<std::string> names;
    for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
        std::size_t lost = 0;
        for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
            lost += tracks.at(frame, marker).source == capture::PlaceSource::lost ? 1U : 0U;
        }
        if (2 * lost > tracks.frame_count) {
            names.push_back(tracks.markers[marker]);
        }
    }
    return names.empty()
               ? std::string()
               : fmt::format(
                     "lost most of the time: {}: are they labelled in two cameras at one moment, "
                     "and do their colours show?",
                     fmt::join(names, ", "));
}

// How upright the dancer is: the cosine of the angle from the feet to the head against up, in the
// middle of all frames that show both; none: no frame does.
std::optional<double> uprightness(const capture::Tracks& tracks,
                                  const capture::MarkerSet& markers) {
    std::vector<double> cosines;
    for (std::size_t frame = 0; frame < tracks.frame_count; ++frame) {
        glm::dvec3 head(0.0);
        glm::dvec3 feet(0.0);
        double heads = 0.0;
        double toes = 0.0;
        for (std::size_t marker = 0; marker < tracks.markers.size(); ++marker) {
            const capture::MarkerPlace& place = tracks.at(frame, marker);
            const auto index = markers.index_of(tracks.markers[marker]);
            if (place.source == capture::PlaceSource::lost || !index) {
                continue;
            }
            const motion::Bone bone = markers.markers[*index].bone;
            if (bone == motion::Bone::head) {
                head += place.place;
                heads += 1.0;
            } else if (bone == motion::Bone::left_foot || bone == motion::Bone::right_foot ||
                       bone == motion::Bone::left_toes || bone == motion::Bone::right_toes) {
                feet += place.place;
                toes += 1.0;
            }
        }
        if (heads > 0.0 && toes > 0.0) {
            cosines.push_back(glm::normalize(head / heads - feet / toes).y);
        }
    }
    if (cosines.empty()) {
        return std::nullopt;
    }
    const auto middle = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 2);
    std::nth_element(cosines.begin(), middle, cosines.end());
    return *middle;
}

// A world whose floor is not under the dancer's feet.
std::string floor_doubt(const capture::Tracks& tracks, const capture::MarkerSet& markers) {
    const double upright = uprightness(tracks, markers).value_or(1.0);
    constexpr double kLying = 0.5;  // the cosine of 60 degrees
    if (upright > kLying) {
        return {};
    }
    return fmt::format(
        "the dancer {}: the floor is not where the board says; lay it down printed side up, in "
        "view of three cameras, and calibrate again with --floor",
        upright < -kLying ? "stands on the head" : "lies all the time");
}

}  // namespace

std::string colour_doubt(const capture::MarkerSet& markers) {
    const std::size_t colours = markers.colours().size();
    constexpr std::size_t kEnough = 3;
    if (colours >= kEnough) {
        return {};
    }
    return fmt::format(
        "{} markers of {}: where spots are missed or false a limb is taken for another and the "
        "body is lost at times; give neighbours, left and right, different colours (five are "
        "enough)",
        markers.markers.size(),
        colours == 1 ? "one colour" : "two colours");
}

std::vector<std::string> track_doubts(const capture::Tracks& tracks,
                                      const capture::MarkerSet& markers) {
    std::vector<std::string> doubts = {lost_markers(tracks), floor_doubt(tracks, markers)};
    std::erase(doubts, std::string());
    return doubts;
}

}  // namespace raks::apps
