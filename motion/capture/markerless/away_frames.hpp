// Away frames: where what is followed cannot have got to, so that it is somebody else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

namespace raks::capture {

/// How far a dancer's trunk can get; in the unit of its places.
struct TrunkLimits {
    double trembling = 0.0;     ///< that a place may be off
    double fastest = 0.0;       ///< a second
    double farthest = 0.0;      ///< that is allowed for at most
    double longest_away = 3.0;  ///< seconds until another place is believed
};

/// Which frames are those of somebody else: from where the trunk is farther from the last place
/// than anybody gets, until it is back or believed. The same is told from the last frame to the
/// first; of both the one with fewer such frames is right, since a take may begin, or end, with
/// somebody else. Places: by frame; none: not known.
template <typename Place>
[[nodiscard]] std::vector<bool> away_frames(const std::vector<std::optional<Place>>& places,
                                            double frames_per_second,
                                            const TrunkLimits& limits) {
    const auto told = [&](bool is_backward) {
        std::vector<bool> away(places.size());
        std::optional<Place> last;
        std::size_t when = 0;
        bool is_away = false;
        for (std::size_t i = 0; i < places.size(); ++i) {
            const std::size_t frame = is_backward ? places.size() - 1 - i : i;
            const auto& place = places[frame];
            if (place) {
                const double seconds = static_cast<double>(i - when) / frames_per_second;
                const double allowed =
                    std::min(limits.farthest, limits.trembling + limits.fastest * seconds);
                is_away = last && glm::distance(*last, *place) > allowed &&
                          seconds <= limits.longest_away;
                if (!is_away) {
                    last = place;
                    when = i;
                }
            }
            away[frame] = is_away;
        }
        return away;
    };
    std::vector<bool> forward = told(false);
    std::vector<bool> backward = told(true);
    const auto count = [](const std::vector<bool>& away) {
        return std::count(away.begin(), away.end(), true);
    };
    return count(backward) < count(forward) ? backward : forward;
}

}  // namespace raks::capture
