#include "training/cells/grid_cues.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/statistics.hpp"
#include "motion/choreography/splines.hpp"
#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/foot_events.hpp"
#include "motion/figures/motion_features.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {
namespace {

using Signal = std::vector<double>;
using Places = std::vector<glm::dvec3>;

// Weights of the cues, from a prototype on the dances of a professional: the feet tell most.
constexpr double kLandWeight = 3.0;
constexpr double kUpWeight = 1.0;
constexpr double kSideWeight = 0.5;
constexpr double kTrunkWeight = 0.5;
constexpr double kHandsWeight = 0.5;

constexpr double kFootPass = 8.0;    // Hz
constexpr double kHipsPass = 6.0;    // Hz: accelerations are noisier
constexpr double kNearFloor = 0.12;  // metres over its lowest: a foot that brakes there lands
constexpr double kPeak = 0.97;       // share of rows below which a cue is cut: leaps do not decide
constexpr double kLocalMean = 60.0;  // rows: deviation of the window of a cue's local mean
constexpr double kBlur = 2.0;        // rows: beats are met to some 30 ms

// The step that ends in a landing: smaller ones than those that figures are judged by count, too.
constexpr FootRules kLandingRules{.landing_speed = 0.25, .step_speed = 0.50};

// Values between rows of another rate.
template <typename Value>
Value value_between(const std::vector<Value>& values, double at) {
    const double last = static_cast<double>(values.size() - 1);
    const double place = std::clamp(at, 0.0, last);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, values.size() - 1);
    const double t = place - static_cast<double>(below);
    return (1.0 - t) * values[below] + t * values[above];
}

Places low_passed(const Places& places, double hz) {
    const std::vector<double> taps = low_pass_taps(hz, kCueRate);
    Places result(places.size());
    Signal axis(places.size());
    for (int i = 0; i < 3; ++i) {
        std::transform(places.begin(), places.end(), axis.begin(), [i](const glm::dvec3& place) {
            return place[i];
        });
        const Signal smooth = filtered(axis, taps);
        for (std::size_t row = 0; row < smooth.size(); ++row) {
            result[row][i] = smooth[row];
        }
    }
    return result;
}

// Central differences a second, one-sided at the ends.
template <typename Value>
std::vector<Value> rate_of_change(const std::vector<Value>& values) {
    std::vector<Value> rates(values.size());
    for (std::size_t row = 0; row < values.size() && values.size() > 1; ++row) {
        const std::size_t before = row > 0 ? row - 1 : 0;
        const std::size_t after = std::min(row + 1, values.size() - 1);
        rates[row] =
            (values[after] - values[before]) * (kCueRate / static_cast<double>(after - before));
    }
    return rates;
}

Signal speed_of_places(const Places& places) {
    const Places velocity = rate_of_change(places);
    Signal speed(velocity.size());
    std::transform(velocity.begin(), velocity.end(), speed.begin(), [](const glm::dvec3& v) {
        return glm::length(v);
    });
    return speed;
}

// How strongly something brakes.
Signal braking_of(const Places& places) {
    Signal change = rate_of_change(speed_of_places(places));
    for (double& value : change) {
        value = std::max(0.0, -value);
    }
    return change;
}

// A cue of the scale of all others: cut, about its local mean, as large as its deviation.
void add_cue(Signal cue, double weight, Signal& to) {
    const double most = lower_percentile(cue, kPeak);
    for (double& value : cue) {
        value = std::min(value, most);
    }
    const Signal mean = blurred(cue, kLocalMean);
    double squares = 0.0;
    for (std::size_t row = 0; row < cue.size(); ++row) {
        cue[row] -= mean[row];
        squares += cue[row] * cue[row];
    }
    const double deviation = std::sqrt(squares / static_cast<double>(cue.size()));
    if (!(deviation > 1e-9)) {
        return;
    }
    const Signal smooth = blurred(cue, kBlur);
    for (std::size_t row = 0; row < cue.size(); ++row) {
        to[row] += weight * smooth[row] / deviation;
    }
}

// Places of what is looked at, by row.
struct CuePlaces {
    Places hips;
    Places neck;
    std::array<Places, 2> ankles;
    std::array<Places, 2> hands;  // from the chest
};

CuePlaces cue_places(const std::vector<Pose>& poses,
                     const std::vector<std::array<SourceFoot, 2>>& feet,
                     const Skeleton& body,
                     double frames_per_row,
                     std::size_t rows) {
    CuePlaces by_frame;
    for (std::size_t frame = 0; frame < poses.size(); ++frame) {
        const WorldPose world = world_pose(body, poses[frame]);
        by_frame.hips.emplace_back(world.position(Bone::hips));
        by_frame.neck.emplace_back(world.position(Bone::neck));
        const glm::dvec3 chest(world.position(Bone::chest));
        by_frame.hands[0].push_back(glm::dvec3(world.position(Bone::left_hand)) - chest);
        by_frame.hands[1].push_back(glm::dvec3(world.position(Bone::right_hand)) - chest);
        for (std::size_t side = 0; side < 2; ++side) {
            by_frame.ankles[side].push_back(feet[frame][side].ankle);
        }
    }
    const auto at_rate = [&](const Places& places) {
        Places result(rows);
        for (std::size_t row = 0; row < rows; ++row) {
            result[row] = value_between(places, static_cast<double>(row) * frames_per_row);
        }
        return result;
    };
    CuePlaces result;
    result.hips = at_rate(by_frame.hips);
    result.neck = at_rate(by_frame.neck);
    for (std::size_t side = 0; side < 2; ++side) {
        result.ankles[side] = at_rate(by_frame.ankles[side]);
        result.hands[side] = at_rate(by_frame.hands[side]);
    }
    return result;
}

Signal landing_cue(const CuePlaces& places) {
    Signal cue(places.hips.size(), 0.0);
    for (const Places& raw : places.ankles) {
        const Places ankle = low_passed(raw, kFootPass);
        Signal heights(ankle.size());
        std::transform(ankle.begin(), ankle.end(), heights.begin(), [](const glm::dvec3& place) {
            return place.y;
        });
        const double lowest = lower_percentile(heights, 0.05);
        const Signal braking = braking_of(ankle);
        for (std::size_t row = 0; row < cue.size(); ++row) {
            cue[row] += heights[row] - lowest < kNearFloor ? braking[row] : 0.0;
        }
    }
    return cue;
}

// All cues, weighed.
Signal impulse_of(const CuePlaces& places) {
    const std::size_t rows = places.hips.size();
    Signal impulse(rows, 0.0);
    add_cue(landing_cue(places), kLandWeight, impulse);
    const Places pushed = rate_of_change(rate_of_change(low_passed(places.hips, kHipsPass)));
    Signal up(rows);
    Signal side(rows);
    for (std::size_t row = 0; row < rows; ++row) {
        up[row] = std::max(0.0, pushed[row].y);
        side[row] = std::hypot(pushed[row].x, pushed[row].z);
    }
    add_cue(std::move(up), kUpWeight, impulse);
    add_cue(std::move(side), kSideWeight, impulse);
    add_cue(braking_of(low_passed(places.neck, kFootPass)), kTrunkWeight, impulse);
    Signal hands(rows, 0.0);
    for (const Places& hand : places.hands) {
        const Signal braking = braking_of(low_passed(hand, kFootPass));
        std::transform(hands.begin(), hands.end(), braking.begin(), hands.begin(), std::plus<>());
    }
    add_cue(std::move(hands), kHandsWeight, impulse);
    return impulse;
}

// The mean of the body's speed over a second, by row.
Signal body_speed_of(const std::vector<TakeMoment>& moments) {
    const auto reach = static_cast<std::size_t>(kCueRate / 2.0);
    std::vector<double> sums{0.0};
    for (const TakeMoment& moment : moments) {
        sums.push_back(sums.back() + moment.speed());
    }
    Signal means(moments.size());
    for (std::size_t row = 0; row < means.size(); ++row) {
        const std::size_t first = row > reach ? row - reach : 0;
        const std::size_t last = std::min(row + reach, means.size());
        means[row] = (sums[last] - sums[first]) / static_cast<double>(last - first);
    }
    return means;
}

std::vector<CueLanding> cue_landings(const std::vector<std::array<SourceFoot, 2>>& feet,
                                     double frames_per_second) {
    std::vector<CueLanding> result;
    for (const Side side : kSides) {
        for (const double frame : landings(feet, side, frames_per_second, kLandingRules)) {
            result.push_back({frame / frames_per_second, side});
        }
    }
    std::sort(result.begin(), result.end(), [](const CueLanding& a, const CueLanding& b) {
        return a.time < b.time;
    });
    return result;
}

}  // namespace

std::size_t GridCues::row_at(double time) const noexcept {
    const double row = std::clamp(time * kCueRate, 0.0, static_cast<double>(rows() - 1));
    return static_cast<std::size_t>(std::lround(row));
}

GridCues grid_cues(const TrainingClip& clip) {
    std::vector<Pose> poses = clip.poses;
    bridge_faults(poses, clip.faults);
    poses = filtered(poses, low_pass_taps(kFootPass, clip.frames_per_second));
    std::vector<std::array<SourceFoot, 2>> feet = clip.feet;
    bridge_faults(feet, clip.faults);
    FigureModel size;
    size.source_hips_height = clip.hips_height;
    const Skeleton body = source_body(size);

    const double frames_per_row = clip.frames_per_second / kCueRate;
    const auto rows = static_cast<std::size_t>(
        1.0 + std::floor(static_cast<double>(poses.size() - 1) / frames_per_row));
    std::array<std::vector<bool>, 2> planted;
    for (const Side side : kSides) {
        planted[static_cast<std::size_t>(side)] = toe_contacts(feet, side, clip.frames_per_second);
    }
    GridCues cues;
    const std::vector<TakeMoment> by_frame =
        moments_of(poses, clip.frames_per_second, body, planted);
    for (std::size_t row = 0; row < rows; ++row) {
        const auto frame =
            static_cast<std::size_t>(std::lround(static_cast<double>(row) * frames_per_row));
        cues.moments.push_back(by_frame[std::min(frame, by_frame.size() - 1)]);
    }
    const CuePlaces places = cue_places(poses, feet, body, frames_per_row, rows);
    cues.impulse = impulse_of(places);
    cues.hips_speed = speed_of_places(low_passed(places.hips, kFootPass));
    const Signal left = speed_of_places(low_passed(places.ankles[0], kFootPass));
    const Signal right = speed_of_places(low_passed(places.ankles[1], kFootPass));
    for (std::size_t row = 0; row < rows; ++row) {
        cues.hips_height.push_back(places.hips[row].y);
        cues.feet_speed.push_back(std::max(left[row], right[row]));
    }
    cues.body_speed = body_speed_of(cues.moments);
    cues.landings = cue_landings(feet, clip.frames_per_second);
    return cues;
}

std::vector<ActiveRows> active_rows(const GridCues& cues) {
    constexpr auto kPause = static_cast<std::size_t>(kCueRate);
    constexpr auto kShortest = static_cast<std::size_t>(2.0 * kCueRate);
    std::vector<ActiveRows> stretches;
    for (std::size_t row = 0; row < cues.rows(); ++row) {
        if (cues.body_speed[row] < kIdleBodySpeed) {
            continue;
        }
        if (stretches.empty() || row - stretches.back().last >= kPause) {
            stretches.push_back({row, row});
        }
        stretches.back().last = row + 1;
    }
    std::erase_if(stretches,
                  [](const ActiveRows& rows) { return rows.last - rows.first < kShortest; });
    return stretches;
}

}  // namespace raks::motion
