#include "motion/capture/markerless/side_exchange.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>

#include "motion/capture/markerless/keypoint_markers.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kMostJointly = 6;  // cameras
constexpr double kSureSide = 0.3;        // less sure joints say nothing
constexpr double kMostMiss = 16.0;       // of a squared distance, in errors
constexpr double kUsualStep = 2.0;       // of a joint from frame to frame, errors
// Of a change from one frame to the next: single frames in which limbs cover one another are none.
constexpr double kChangeCost = 4.0;
// Of an exchanged frame: networks exchange the sides of less than one in a hundred, and feet that
// stand at one height lie on one epipolar line, so that both ways fit alike.
constexpr double kExchangeCost = 3.0;

constexpr std::array<BodyPoint, 5> kLeftArm = {BodyPoint::left_shoulder,
                                               BodyPoint::left_elbow,
                                               BodyPoint::left_wrist,
                                               BodyPoint::left_pinky,
                                               BodyPoint::left_index};
constexpr std::array<BodyPoint, 5> kLeftLeg = {BodyPoint::left_hip,
                                               BodyPoint::left_knee,
                                               BodyPoint::left_ankle,
                                               BodyPoint::left_heel,
                                               BodyPoint::left_foot_index};

std::span<const BodyPoint> left_of(ExchangedLimbs limbs) {
    return limbs == ExchangedLimbs::arms ? kLeftArm : kLeftLeg;
}

// Costs of two ways to name the sides: alike in both places that are compared, or crosswise.
struct TwoWays {
    double alike = 0.0;
    double crosswise = 0.0;
};

double bounded(double distance, double usual) {
    const double miss = distance / usual;
    return 0.5 * std::min(miss * miss, kMostMiss);
}

class SideSearch {
 public:
    SideSearch(const Rig& rig,
               const std::vector<double>& errors,
               const KeypointTake& take,
               ExchangedLimbs limbs)
        : rig_(rig),
          errors_(errors),
          take_(take),
          left_(left_of(limbs)),
          cameras_(std::min(kMostJointly, take.cameras)),
          states_(std::size_t{1} << cameras_) {}

    // By frame: a bit a camera whose sides are exchanged.
    std::vector<std::size_t> search() {
        std::vector<double> costs = seen_costs(0);
        std::vector<std::vector<std::size_t>> from(take_.frame_count);
        for (std::size_t frame = 1; frame < take_.frame_count; ++frame) {
            const std::vector<double> seen = seen_costs(frame);
            const std::vector<TwoWays> steps = step_costs(frame);
            std::vector<double> next(states_, std::numeric_limits<double>::infinity());
            from[frame].resize(states_);
            for (std::size_t to = 0; to < states_; ++to) {
                for (std::size_t before = 0; before < states_; ++before) {
                    const double cost = costs[before] + step_cost(steps, before ^ to);
                    if (cost < next[to]) {
                        next[to] = cost;
                        from[frame][to] = before;
                    }
                }
                next[to] += seen[to];
            }
            costs = std::move(next);
        }
        std::vector<std::size_t> path(take_.frame_count);
        path.back() =
            static_cast<std::size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
        for (std::size_t frame = take_.frame_count - 1; frame > 0; --frame) {
            path[frame - 1] = from[frame][path[frame]];
        }
        return path;
    }

 private:
    [[nodiscard]] const Keypoint* sure(std::size_t frame,
                                       std::size_t camera,
                                       BodyPoint point) const {
        const Keypoint& seen = take_.point(frame, camera, point);
        return seen.visibility >= kSureSide ? &seen : nullptr;
    }

    // Distances of the joints of two sights, each a frame and a camera, by both ways.
    template <typename Distance>
    TwoWays compare(std::pair<std::size_t, std::size_t> one,
                    std::pair<std::size_t, std::size_t> other,
                    const Distance& distance) const {
        TwoWays ways;
        for (const BodyPoint left : left_) {
            const std::array<const Keypoint*, 4> seen = {
                sure(one.first, one.second, left),
                sure(one.first, one.second, other_side(left)),
                sure(other.first, other.second, left),
                sure(other.first, other.second, other_side(left))};
            if (std::find(seen.begin(), seen.end(), nullptr) == seen.end()) {
                ways.alike += distance(*seen[0], *seen[2]) + distance(*seen[1], *seen[3]);
                ways.crosswise += distance(*seen[0], *seen[3]) + distance(*seen[1], *seen[2]);
            }
        }
        return ways;
    }

    [[nodiscard]] std::vector<double> seen_costs(std::size_t frame) const {
        std::vector<double> costs(states_);
        for (std::size_t i = 0; i < cameras_; ++i) {
            for (std::size_t state = 0; state < states_; ++state) {
                costs[state] += (state >> i & 1U) != 0 ? kExchangeCost : 0.0;
            }
            for (std::size_t j = i + 1; j < cameras_; ++j) {
                const Camera& one = rig_.cameras[i];
                const Camera& other = rig_.cameras[j];
                const TwoWays ways =
                    compare({frame, i}, {frame, j}, [&](const Keypoint& a, const Keypoint& b) {
                        return bounded(epipolar_distance(one,
                                                         direction_of(one.lens, a.pixel),
                                                         other,
                                                         direction_of(other.lens, b.pixel)),
                                       errors_[j]);
                    });
                for (std::size_t state = 0; state < states_; ++state) {
                    const bool is_alike = (state >> i & 1U) == (state >> j & 1U);
                    costs[state] += is_alike ? ways.alike : ways.crosswise;
                }
            }
        }
        return costs;
    }

    [[nodiscard]] std::vector<TwoWays> step_costs(std::size_t frame) const {
        std::vector<TwoWays> costs;
        for (std::size_t i = 0; i < cameras_; ++i) {
            costs.push_back(
                compare({frame - 1, i}, {frame, i}, [&](const Keypoint& a, const Keypoint& b) {
                    return bounded(glm::distance(a.pixel, b.pixel), kUsualStep * errors_[i]);
                }));
        }
        return costs;
    }

    [[nodiscard]] double step_cost(const std::vector<TwoWays>& steps, std::size_t changed) const {
        double cost = 0.0;
        for (std::size_t i = 0; i < cameras_; ++i) {
            cost += (changed >> i & 1U) != 0 ? steps[i].crosswise + kChangeCost : steps[i].alike;
        }
        return cost;
    }

    const Rig& rig_;
    const std::vector<double>& errors_;
    const KeypointTake& take_;
    std::span<const BodyPoint> left_;
    std::size_t cameras_;
    std::size_t states_;
};

std::vector<SideExchange> stretches_of(const std::vector<std::size_t>& path,
                                       std::size_t cameras,
                                       ExchangedLimbs limbs) {
    std::vector<SideExchange> stretches;
    for (std::size_t camera = 0; camera < cameras; ++camera) {
        for (std::size_t frame = 0; frame < path.size(); ++frame) {
            if ((path[frame] >> camera & 1U) == 0) {
                continue;
            }
            const bool goes_on = frame > 0 && (path[frame - 1] >> camera & 1U) != 0;
            if (goes_on) {
                stretches.back().last = frame;
            } else {
                stretches.push_back({camera, limbs, frame, frame});
            }
        }
    }
    return stretches;
}

}  // namespace

void exchange_sides(const SideExchange& stretch, KeypointTake& take) {
    for (std::size_t frame = stretch.first; frame <= stretch.last; ++frame) {
        auto& points = take.at(frame, stretch.camera);
        for (const BodyPoint left : left_of(stretch.limbs)) {
            std::swap(points[static_cast<std::size_t>(left)],
                      points[static_cast<std::size_t>(other_side(left))]);
        }
    }
}

std::vector<SideExchange> put_sides_right(const Rig& rig,
                                          const std::vector<double>& errors,
                                          KeypointTake& take) {
    std::vector<SideExchange> all;
    for (const ExchangedLimbs limbs : {ExchangedLimbs::arms, ExchangedLimbs::legs}) {
        const auto path = SideSearch(rig, errors, take, limbs).search();
        for (const SideExchange& stretch :
             stretches_of(path, std::min(kMostJointly, take.cameras), limbs)) {
            exchange_sides(stretch, take);
            all.push_back(stretch);
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const SideExchange& a, const SideExchange& b) {
        return a.first < b.first;
    });
    return all;
}

void add_flags(const std::vector<SideExchange>& exchanges,
               const std::vector<std::string>& names,
               Tracks& tracks) {
    for (const SideExchange& stretch : exchanges) {
        const BodyPoint end =
            stretch.limbs == ExchangedLimbs::arms ? BodyPoint::left_wrist : BodyPoint::left_ankle;
        for (const BodyPoint point : {end, other_side(end)}) {
            const auto found =
                std::find(tracks.markers.begin(), tracks.markers.end(), name_of(point));
            if (found != tracks.markers.end() && stretch.last < tracks.frame_count) {
                tracks.flags.push_back({Doubt::exchanged,
                                        static_cast<std::size_t>(found - tracks.markers.begin()),
                                        stretch.first,
                                        stretch.last,
                                        names[stretch.camera]});
            }
        }
    }
    sort_flags(tracks);
}

std::vector<std::string> words_of(const std::vector<SideExchange>& exchanges,
                                  const std::vector<std::string>& names,
                                  const Tracks& tracks) {
    std::vector<std::string> lines;
    for (std::size_t camera = 0; camera < names.size(); ++camera) {
        std::array<std::size_t, 2> frames{};
        std::size_t stretches = 0;
        for (const SideExchange& stretch : exchanges) {
            if (stretch.camera == camera) {
                frames[static_cast<std::size_t>(stretch.limbs)] += stretch.last - stretch.first + 1;
                ++stretches;
            }
        }
        if (stretches > 0) {
            const auto share = [&](std::size_t count) {
                return 100.0 * static_cast<double>(count) / static_cast<double>(tracks.frame_count);
            };
            lines.push_back(fmt::format(
                "{}: left and right were exchanged in {} stretches (arms {:.1f} %, legs {:.1f} % "
                "of the time) and put right",
                names[camera],
                stretches,
                share(frames[0]),
                share(frames[1])));
        }
    }
    return lines;
}

}  // namespace raks::capture
