#include "motion/evaluate/place_series.hpp"

#include <algorithm>
#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::motion {

Places smoothed(const Places& places) {
    // Binomial coefficients, which sum to 1.
    constexpr std::array<double, 5> kTaps = {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16};
    const auto last = static_cast<std::ptrdiff_t>(places.size()) - 1;
    Places result(places.size(), glm::dvec3(0.0));
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        for (std::ptrdiff_t k = 0; k < 5; ++k) {
            const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(i + k - 2, 0, last);
            result[static_cast<std::size_t>(i)] +=
                kTaps[static_cast<std::size_t>(k)] * places[static_cast<std::size_t>(at)];
        }
    }
    return result;
}

std::vector<double> speeds(const Places& places, double frames_per_second) {
    std::vector<double> result(places.size(), 0.0);
    for (std::size_t i = 0; places.size() > 1 && i < places.size(); ++i) {
        const std::size_t before = i > 0 ? i - 1 : 0;
        const std::size_t after = std::min(i + 1, places.size() - 1);
        result[i] = glm::length(places[after] - places[before]) * frames_per_second /
                    static_cast<double>(after - before);
    }
    return result;
}

Places joint_places(const BodyTrack& track, std::size_t joint) {
    Places places(track.frames());
    for (std::size_t f = 0; f < track.frames(); ++f) {
        places[f] = track.joints[f][joint];
    }
    return places;
}

Places toe_places(const BodyTrack& track, Side side) {
    Places places(track.frames());
    for (std::size_t f = 0; f < track.frames(); ++f) {
        places[f] = track.feet[f][static_cast<std::size_t>(side)].toe_tip;
    }
    return places;
}

Places foot_places(const BodyTrack& track, Side side, double from_ankle) {
    Places places = toe_places(track, side);
    for (std::size_t f = 0; f < track.frames(); ++f) {
        const glm::dvec3& ankle = track.feet[f][static_cast<std::size_t>(side)].ankle;
        const double length = glm::distance(ankle, places[f]);
        // A foot shorter than that ends at its tip.
        if (length > from_ankle) {
            places[f] = glm::mix(ankle, places[f], from_ankle / length);
        }
    }
    return places;
}

}  // namespace raks::motion
