#include "motion/figures/phrase_signals.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "motion/figures/clip_conditioning.hpp"
#include "motion/figures/motion_features.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {
namespace {

using Values = std::vector<double>;
using Places = std::vector<glm::dvec3>;

constexpr double kRate = 60.0;        // rows a second
constexpr double kPass = 8.0;         // Hz
constexpr double kNearFloor = 0.12;   // metres over its lowest: a foot that brakes there lands
constexpr double kSlowSeconds = 4.0;  // what changes more slowly is travel, no beat
constexpr double kStep = 0.5;         // m/s: a foot that was so fast has stepped
constexpr double kLanded = 0.25;      // m/s
constexpr double kLeastShare = 3e-3;  // of a variance: less is as good as nothing
constexpr double kUsual = 118.0;      // BPM, the middle of what people dance to
constexpr double kWindowSeconds = 8.0;
constexpr double kLikenessRate = 30.0;  // rows a second
constexpr double kShortestLag = 1.4;    // seconds: four beats of 171 BPM
constexpr double kLongestLag = 3.7;
constexpr double kMovesEnough = 0.5;  // of the distance of random moments in all of it

// Oscillations in beats that features() looks at.
constexpr std::array<double, 4> kCycles = {0.25, 0.5, 1.0, 2.0};

Places places_of(std::span<const Pose> poses,
                 const Skeleton& body,
                 double frames_per_row,
                 glm::vec3 (*place)(const Skeleton&, const WorldPose&, Side),
                 Side side) {
    const auto rows = static_cast<std::size_t>(static_cast<double>(poses.size()) / frames_per_row);
    Places places(std::max<std::size_t>(rows, 1));
    for (std::size_t row = 0; row < places.size(); ++row) {
        const Pose pose = pose_between(poses, static_cast<double>(row) * frames_per_row);
        places[row] = glm::dvec3(place(body, world_body(body, pose), side));
    }
    return places;
}

glm::vec3 ankle_place(const Skeleton& /*body*/, const WorldPose& world, Side side) {
    return world.position(side == Side::left ? Bone::left_foot : Bone::right_foot);
}
glm::vec3 hand_place(const Skeleton& /*body*/, const WorldPose& world, Side side) {
    const Bone hand = side == Side::left ? Bone::left_hand : Bone::right_hand;
    return world.position(hand) - world.position(Bone::chest);
}
glm::vec3 neck_place(const Skeleton& /*body*/, const WorldPose& world, Side /*side*/) {
    return world.position(Bone::neck);
}
glm::vec3 hips_place(const Skeleton& /*body*/, const WorldPose& world, Side /*side*/) {
    return world.position(Bone::hips);
}
glm::vec3 hips_left(const Skeleton& /*body*/, const WorldPose& world, Side /*side*/) {
    return world.rotation(Bone::hips) * glm::vec3(1.0F, 0.0F, 0.0F);
}

Places low_passed(const Places& places) {
    const std::vector<double> taps = low_pass_taps(kPass, kRate);
    Places result(places.size());
    Values axis(places.size());
    for (int i = 0; i < 3; ++i) {
        std::transform(places.begin(), places.end(), axis.begin(), [i](const glm::dvec3& place) {
            return place[i];
        });
        const Values smooth = filtered(axis, taps);
        for (std::size_t row = 0; row < smooth.size(); ++row) {
            result[row][i] = smooth[row];
        }
    }
    return result;
}

Values speeds_of(const Places& places) {
    const Places smooth = low_passed(places);
    Values speeds(smooth.size(), 0.0);
    for (std::size_t row = 0; row + 1 < smooth.size(); ++row) {
        speeds[row] = glm::length(smooth[row + 1] - smooth[row]) * kRate;
    }
    if (speeds.size() > 1) {
        speeds.back() = speeds[speeds.size() - 2];
    }
    return speeds;
}

// How strongly something brakes.
Values braking_of(const Values& speeds) {
    Values braking(speeds.size(), 0.0);
    for (std::size_t row = 0; row + 1 < speeds.size(); ++row) {
        braking[row] = std::max(0.0, speeds[row] - speeds[row + 1]);
    }
    return braking;
}

void add_to(Values& sum, const Values& part) {
    sum.resize(std::max(sum.size(), part.size()), 0.0);
    for (std::size_t row = 0; row < part.size(); ++row) {
        sum[row] += part[row];
    }
}

// Without what changes slowly.
Values without_travel(const Values& values) {
    const auto reach = static_cast<std::ptrdiff_t>(kSlowSeconds * kRate / 2.0);
    Values sums(1, 0.0);
    for (const double value : values) {
        sums.push_back(sums.back() + value);
    }
    Values result(values.size());
    const auto rows = static_cast<std::ptrdiff_t>(values.size());
    for (std::ptrdiff_t row = 0; row < rows; ++row) {
        // As far to both sides, so that a steady drift is taken away at the ends, too.
        const std::ptrdiff_t near = std::min({reach, row, rows - 1 - row});
        const auto first = static_cast<std::size_t>(row - near);
        const auto last = static_cast<std::size_t>(row + near + 1);
        const auto at = static_cast<std::size_t>(row);
        result[at] = values[at] - (sums[last] - sums[first]) / static_cast<double>(last - first);
    }
    return result;
}

// Mean 0 and variance 1; empty where it hardly changes.
Values standardized(Values values, double unmoved) {
    double mean = 0.0;
    for (const double value : values) {
        mean += value / static_cast<double>(values.size());
    }
    double square = 0.0;
    for (double& value : values) {
        value -= mean;
        square += value * value / static_cast<double>(values.size());
    }
    if (!(square > unmoved * unmoved)) {
        return {};
    }
    for (double& value : values) {
        value /= std::sqrt(square);
    }
    return values;
}

// A cue of which a few strong moments do not decide.
Values impulses(Values cue) {
    std::vector<double> sorted = cue;
    std::sort(sorted.begin(), sorted.end());
    const double most =
        sorted[static_cast<std::size_t>(0.98 * static_cast<double>(sorted.size() - 1))];
    for (double& value : cue) {
        value = std::min(value, most);
    }
    return cue;
}

// Moments at which something that was fast comes to rest, in seconds.
void add_landings(const Values& speeds, std::vector<double>& landings) {
    bool is_stepping = false;
    for (std::size_t row = 0; row < speeds.size(); ++row) {
        if (is_stepping && speeds[row] < kLanded) {
            landings.push_back(static_cast<double>(row) / kRate);
        }
        is_stepping = speeds[row] > kStep || (is_stepping && speeds[row] >= kLanded);
    }
}

double mean_of(const Values& values) {
    double sum = 0.0;
    for (const double value : values) {
        sum += value;
    }
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

// Rising, of both feet; two that land together count once.
void order_steps(std::vector<double>& steps) {
    constexpr double kTogether = 0.08;  // seconds
    std::sort(steps.begin(), steps.end());
    std::vector<double> kept;
    for (const double step : steps) {
        if (kept.empty() || step - kept.back() > kTogether) {
            kept.push_back(step);
        }
    }
    steps = std::move(kept);
}

// The body about the hips, heading as they do.
constexpr std::array<Bone, 9> kPostureBones = {Bone::neck,
                                               Bone::left_lower_arm,
                                               Bone::right_lower_arm,
                                               Bone::left_hand,
                                               Bone::right_hand,
                                               Bone::left_lower_leg,
                                               Bone::right_lower_leg,
                                               Bone::left_foot,
                                               Bone::right_foot};
using Posture = std::array<glm::vec3, kPostureBones.size()>;

std::vector<Posture> postures_of(std::span<const Pose> poses,
                                 double frames_per_posture,
                                 const Skeleton& body) {
    std::vector<Posture> postures;
    for (double at = 0.0; at < static_cast<double>(poses.size()); at += frames_per_posture) {
        const Pose pose = pose_between(poses, at);
        const WorldPose world = world_body(body, pose);
        const auto heading = static_cast<float>(heading_of(glm::dquat(pose.rotation(Bone::hips))));
        const glm::quat back = glm::angleAxis(-heading, glm::vec3(0.0F, 1.0F, 0.0F));
        Posture& posture = postures.emplace_back();
        for (std::size_t i = 0; i < posture.size(); ++i) {
            posture[i] = back * (world.position(kPostureBones[i]) - world.position(Bone::hips));
        }
    }
    return postures;
}

double apart(const Posture& a, const Posture& b) {
    float square = 0.0F;
    for (std::size_t i = 0; i < a.size(); ++i) {
        square += glm::dot(a[i] - b[i], a[i] - b[i]);
    }
    return std::sqrt(static_cast<double>(square));
}

// Distances of two random moments of any stretch, from the spread of its places.
class RandomDistances {
 public:
    explicit RandomDistances(std::span<const Posture> postures) : sums_(1), squares_(1, 0.0) {
        for (const Posture& posture : postures) {
            Posture sum = sums_.back();
            float square = 0.0F;
            for (std::size_t i = 0; i < posture.size(); ++i) {
                sum[i] += posture[i];
                square += glm::dot(posture[i], posture[i]);
            }
            sums_.push_back(sum);
            squares_.push_back(squares_.back() + static_cast<double>(square));
        }
    }
    [[nodiscard]] double in(std::size_t first, std::size_t last) const {
        const auto count = static_cast<double>(last - first);
        double spread = (squares_[last] - squares_[first]) / count;
        for (std::size_t i = 0; i < sums_[0].size(); ++i) {
            const glm::dvec3 mean = glm::dvec3(sums_[last][i] - sums_[first][i]) / count;
            spread -= glm::dot(mean, mean);
        }
        return std::sqrt(2.0 * std::max(spread, 0.0));
    }

 private:
    std::vector<Posture> sums_;
    std::vector<double> squares_;
};

// How far the body is from itself a lag later, over a stretch as long as the lag, for the stretch
// that is most alike: over the distance of random moments nearby. Who hardly moves repeats nothing.
double least_distance(std::span<const Posture> postures,
                      const RandomDistances& random,
                      std::size_t lag) {
    const auto nearby = static_cast<std::size_t>(0.5 * kWindowSeconds * kLikenessRate);
    const double enough = kMovesEnough * random.in(0, postures.size());
    double sum = 0.0;
    double least = 1.0;
    Values distances;
    for (std::size_t i = 0; i + lag < postures.size(); ++i) {
        distances.push_back(apart(postures[i], postures[i + lag]));
        sum += distances.back() - (i >= lag ? distances[i - lag] : 0.0);
        // Where the second of the two begins.
        const std::size_t middle = i + 1;
        if (middle < lag) {
            continue;
        }
        const double usual = random.in(middle > nearby ? middle - nearby : 0,
                                       std::min(middle + nearby, postures.size()));
        if (usual > enough) {
            least = std::min(least, sum / static_cast<double>(lag) / usual);
        }
    }
    return least;
}

// Of the lags that are more alike than those beside them the best.
PhraseRepeat best_repeat(std::span<const Posture> postures) {
    PhraseRepeat best;
    const RandomDistances random(postures);
    const auto shortest = static_cast<std::size_t>(kShortestLag * kLikenessRate);
    const auto longest = std::min<std::size_t>(
        static_cast<std::size_t>(kLongestLag * kLikenessRate), postures.size() / 2);
    Values distances;
    for (std::size_t lag = shortest - 1; lag <= longest; ++lag) {
        distances.push_back(least_distance(postures, random, lag));
    }
    for (std::size_t i = 1; i + 1 < distances.size(); ++i) {
        const bool is_least = distances[i] < distances[i - 1] && distances[i] <= distances[i + 1];
        if (is_least && distances[i] < best.distance) {
            best = {static_cast<double>(shortest - 1 + i) / kLikenessRate, distances[i]};
        }
    }
    return best;
}

constexpr double kBrakes = 1e-4;  // m/s a row: less is stillness
constexpr double kMoves = 2e-3;   // metres, likewise

}  // namespace

PhraseSignals::PhraseSignals(std::span<const Pose> poses,
                             double frames_per_second,
                             const Skeleton& body) {
    if (poses.empty()) {
        return;
    }
    seconds_ = static_cast<double>(poses.size()) / frames_per_second;
    const double frames_per_row = frames_per_second / kRate;
    watch_feet(poses, frames_per_row, body);
    watch_trunk(poses, frames_per_row, body);
    watch_hands(poses, frames_per_row, body);
    repeat_ = best_repeat(postures_of(poses, frames_per_second / kLikenessRate, body));
}

void PhraseSignals::watch_feet(std::span<const Pose> poses,
                               double frames_per_row,
                               const Skeleton& body) {
    Values braking;
    for (const Side side : kSides) {
        const Places ankle = places_of(poses, body, frames_per_row, ankle_place, side);
        const auto lowest = std::min_element(
            ankle.begin(), ankle.end(), [](const auto& a, const auto& b) { return a.y < b.y; });
        const Values speeds = speeds_of(ankle);
        add_landings(speeds, steps_);
        feet_speed_ += 0.5 * mean_of(speeds);
        Values landing = braking_of(speeds);
        for (std::size_t row = 0; row < landing.size(); ++row) {
            landing[row] *= ankle[row].y - lowest->y < kNearFloor ? 1.0 : 0.0;
        }
        add_to(braking, landing);
    }
    order_steps(steps_);
    signals_[kFeet] = standardized(impulses(std::move(braking)), kBrakes);
}

void PhraseSignals::watch_trunk(std::span<const Pose> poses,
                                double frames_per_row,
                                const Skeleton& body) {
    const auto places = [&](auto place, Side side) {
        return places_of(poses, body, frames_per_row, place, side);
    };
    const Places hips = low_passed(places(hips_place, Side::left));
    const Places left = places(hips_left, Side::left);
    const Places one_foot = places(ankle_place, Side::left);
    const Places other_foot = places(ankle_place, Side::right);
    Values height(hips.size());
    Values sway(hips.size());
    for (std::size_t row = 0; row < hips.size(); ++row) {
        const glm::dvec3 middle = 0.5 * (one_foot[row] + other_foot[row]);
        height[row] = hips[row].y;
        sway[row] = glm::dot(hips[row] - middle, left[row]);
    }
    signals_[kHeight] = standardized(without_travel(height), kMoves);
    signals_[kSway] = standardized(without_travel(sway), kMoves);
    signals_[kTrunk] =
        standardized(impulses(braking_of(speeds_of(places(neck_place, Side::left)))), kBrakes);
}

void PhraseSignals::watch_hands(std::span<const Pose> poses,
                                double frames_per_row,
                                const Skeleton& body) {
    Values braking;
    for (const Side side : kSides) {
        const Values moved = speeds_of(places_of(poses, body, frames_per_row, hand_place, side));
        hands_speed_ += 0.5 * mean_of(moved);
        add_to(braking, braking_of(moved));
    }
    signals_[kHands] = standardized(impulses(std::move(braking)), kBrakes);
}

// Of the variance the share that an oscillation of this frequency explains: the mean over windows,
// since people do not keep a phase for long.
double PhraseSignals::share_at(std::size_t signal, double hertz) const {
    const Values& values = signals_[signal];
    if (values.empty() || hertz > 0.4 * kRate) {
        return 0.0;
    }
    const std::complex<double> step = std::polar(1.0, -2.0 * M_PI * hertz / kRate);
    const auto longest = static_cast<std::size_t>(kWindowSeconds * kRate);
    const std::size_t windows = values.size() <= longest ? 1 : 2 * values.size() / longest;
    const std::size_t length = std::min(values.size(), longest);
    double share = 0.0;
    for (std::size_t window = 0; window < windows; ++window) {
        const std::size_t first =
            windows == 1 ? 0 : window * (values.size() - length) / (windows - 1);
        std::complex<double> turn = 1.0;
        std::complex<double> sum = 0.0;
        for (std::size_t row = first; row < first + length; ++row) {
            sum += values[row] * turn;
            turn *= step;
        }
        const auto count = static_cast<double>(length);
        share += 2.0 * std::norm(sum) / (count * count) / static_cast<double>(windows);
    }
    return share;
}

std::array<double, kPhraseFeatures> PhraseSignals::features(double bpm) const {
    std::array<double, kPhraseFeatures> features{};
    std::size_t at = 0;
    for (std::size_t signal = 0; signal < kSignals; ++signal) {
        for (const double cycle : kCycles) {
            features[at++] = std::log(kLeastShare + share_at(signal, cycle * bpm / 60.0));
        }
    }
    const double octaves = std::log2(bpm / kUsual);
    features[at++] = octaves;
    features[at++] = octaves * octaves;
    const double beat = 60.0 / bpm;
    const double steps_a_beat = static_cast<double>(steps_.size()) * beat / seconds_;
    features[at++] = std::max(0.0, std::log2(steps_a_beat + 1e-3));
    // Up to these many beats after the one before; the last: later.
    constexpr std::array<double, 4> kApart = {0.35, 0.7, 1.4, 2.8};
    for (std::size_t i = 1; i < steps_.size(); ++i) {
        const double apart = (steps_[i] - steps_[i - 1]) / beat;
        const auto place = static_cast<std::size_t>(
            std::lower_bound(kApart.begin(), kApart.end(), apart) - kApart.begin());
        features[at + place] += 1.0 / static_cast<double>(steps_.size() - 1);
    }
    at += kApart.size() + 1;
    constexpr double kStillMetres = 0.05;
    for (const double speed : {feet_speed_, hands_speed_}) {
        const double way = std::log2(kStillMetres + speed * beat);
        features[at++] = way;
        features[at++] = way * way;
    }
    return features;
}

}  // namespace raks::motion
