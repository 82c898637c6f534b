#include "motion/capture/solving/planted_soles.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Side;

constexpr double kLeastTime = 0.08;   // seconds: what stands for less, does not
constexpr double kSpeedReach = 0.03;  // seconds on both sides over which speed is taken

/// 1 up to `whole`, 0 from `none` on, a line between.
double eased(double value, double whole, double none) {
    return std::clamp((none - value) / (none - whole), 0.0, 1.0);
}

/// Takes out stretches shorter than `least` frames.
void drop_short(std::size_t least, std::vector<double>& planted) {
    std::size_t first = 0;
    while (first < planted.size()) {
        std::size_t last = first;
        while (last < planted.size() && planted[last] > 0.0) {
            ++last;
        }
        if (last - first < least) {
            std::fill(planted.begin() + static_cast<std::ptrdiff_t>(first),
                      planted.begin() + static_cast<std::ptrdiff_t>(last),
                      0.0);
        }
        first = last + 1;
    }
}

std::vector<double> planted_of(const std::vector<glm::dvec3>& places,
                               double rate,
                               const StandingSole& standing) {
    const auto reach = static_cast<std::ptrdiff_t>(std::max(1.0, std::round(kSpeedReach * rate)));
    const auto last = static_cast<std::ptrdiff_t>(places.size()) - 1;
    std::vector<double> planted(places.size());
    for (std::ptrdiff_t i = 0; i <= last; ++i) {
        const std::ptrdiff_t from = std::max<std::ptrdiff_t>(0, i - reach);
        const std::ptrdiff_t to = std::min(last, i + reach);
        const double seconds = static_cast<double>(std::max<std::ptrdiff_t>(1, to - from)) / rate;
        const double speed = glm::distance(places[static_cast<std::size_t>(from)],
                                           places[static_cast<std::size_t>(to)]) /
                             seconds;
        planted[static_cast<std::size_t>(i)] =
            eased(speed, standing.still, standing.moving) *
            eased(places[static_cast<std::size_t>(i)].y, standing.low, standing.lifted);
    }
    drop_short(static_cast<std::size_t>(std::ceil(kLeastTime * rate)), planted);
    return planted;
}

}  // namespace

void find_planted(const BodyModel& model,
                  const BodyShape& shape,
                  const std::vector<BodyState>& states,
                  double frames_per_second,
                  const StandingSole& standing,
                  std::vector<FrameSight>& sights) {
    std::array<std::array<std::vector<glm::dvec3>, kSolePoints>, 2> places;
    for (const BodyState& state : states) {
        const PlacedBody body = model.place(shape, state);
        for (const Side side : motion::kSides) {
            for (std::size_t i = 0; i < kSolePoints; ++i) {
                const auto which = static_cast<SolePoint>(i);
                places[static_cast<std::size_t>(side)][i].push_back(
                    body.point(sole_bone(side, which), shape.sole_point(side, which)));
            }
        }
    }
    for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < kSolePoints; ++i) {
            if (!standing.are_heels_held && static_cast<SolePoint>(i) == SolePoint::heel) {
                continue;
            }
            const std::vector<double> planted =
                planted_of(places[side][i], frames_per_second, standing);
            for (std::size_t frame = 0; frame < sights.size(); ++frame) {
                sights[frame].planted[side][i] = planted[frame];
            }
        }
    }
}

}  // namespace raks::capture
