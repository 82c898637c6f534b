#include "motion/dance/baking/flight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "base/smooth_steps.hpp"
#include "motion/dance/baking/banded_system.hpp"
#include "motion/dance/body/curves.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kMostSlowed = 0.4;  // longest delay, as a share of the flight or contact
constexpr double kOneReach = 0.5;    // weight of the reach profile for a foot that halts altogether
// Of the peak speed: slower than this is no movement of its own
constexpr double kHaltedBelow = 0.15;
constexpr double kShortestPath = 0.05;  // metres; a shorter flight is not retimed
constexpr float kFootLength = 0.2F;     // metres; radius by which turning counts as path

/// Samples of one flight: from the last one of a contact to the first one of the next.
struct Flight {
    std::ptrdiff_t left = 0;
    std::ptrdiff_t length = 0;
};

// The flight that ends with contact `c`; the contacts are a closed row.
Flight flight_before(const std::vector<PlannedContact>& contacts, std::size_t c, std::size_t size) {
    const ContactWindow& before = contacts[(c + contacts.size() - 1) % contacts.size()].window;
    const auto left = static_cast<std::ptrdiff_t>(before.first + before.length) - 1;
    const auto first = static_cast<std::ptrdiff_t>(contacts[c].window.first);
    return {left, static_cast<std::ptrdiff_t>(wrap(first - left, size))};
}

// The foot at a fractional sample of the closed curve.
FootTarget place_at(const std::vector<FootTarget>& feet, double sample) {
    const auto from = static_cast<std::ptrdiff_t>(std::floor(sample));
    const FootTarget& a = feet[wrap(from, feet.size())];
    const FootTarget& b = feet[wrap(from + 1, feet.size())];
    const auto share = static_cast<float>(sample - static_cast<double>(from));
    return {glm::mix(a.ankle, b.ankle, share), glm::slerp(a.rotation, b.rotation, share)};
}

// Distance from one target to the next, metres: that of the ankles plus about the arc of the turn,
// so that a foot that only pivots has a path, too.
double between(const FootTarget& a, const FootTarget& b) {
    const float turn = 1.0F - std::abs(glm::dot(a.rotation, b.rotation));
    return static_cast<double>(glm::distance(a.ankle, b.ankle)) +
           static_cast<double>(kFootLength * std::sqrt(std::max(0.0F, 2.0F * turn)));
}

/// Delays steps that come down too soon, by changing the time at which each sample reads the curve.
/// Late steps are left: hurried, they would be faster than people's.
void wait(const std::vector<PlannedContact>& contacts, std::vector<double>& times) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Flight flight = flight_before(contacts, c, times.size());
        const auto first = static_cast<std::ptrdiff_t>(contacts[c].window.first);
        const auto rest = static_cast<std::ptrdiff_t>(contacts[c].window.length);
        if (!contacts[c].arrival || flight.length < 2) {
            continue;
        }
        const auto shorter = static_cast<double>(std::min(flight.length, rest));
        // Negative: samples around the contact's start read an earlier moment. The shift grows over
        // the flight and fades over the contact, so that time stays monotonic (kMostSlowed).
        const double apart = std::clamp(
            *contacts[c].arrival - static_cast<double>(first), -kMostSlowed * shorter, 0.0);
        for (std::ptrdiff_t k = -flight.length; k <= rest; ++k) {
            const auto whole = static_cast<float>(k < 0 ? flight.length : rest);
            const float near = 1.0F - static_cast<float>(std::abs(k)) / whole;
            times[wrap(first + k, times.size())] += apart * static_cast<double>(smootherstep(near));
        }
    }
}

/// How much a flight halts on its way, from 0 (its speed rises and falls once) to 1 (it stops in
/// between). `path`: way covered by sample. At each sample the speed is compared with the smaller
/// of the highest speed before and the highest after.
double halt_of(const std::vector<double>& path) {
    const std::size_t steps = path.size() - 1;
    std::vector<double> after(steps);  // highest speed from here on
    double fastest = 0.0;
    for (std::size_t k = steps; k-- > 0;) {
        fastest = std::max(fastest, path[k + 1] - path[k]);
        after[k] = fastest;
    }
    double before = 0.0;
    double halt = 0.0;
    for (std::size_t k = 0; k < steps; ++k) {
        const double speed = path[k + 1] - path[k];
        before = std::max(before, speed);
        const double around = std::min(before, after[k]);
        halt = std::max(halt, around > kHaltedBelow * fastest ? 1.0 - speed / around : 0.0);
    }
    return halt;
}

/// Length of the foot's path by sample of a flight, 0 where it left; metres.
std::vector<double> path_of(const std::vector<FootTarget>& feet, const Flight& flight) {
    std::vector<double> path = {0.0};
    for (std::ptrdiff_t k = 1; k <= flight.length; ++k) {
        path.push_back(path.back() + between(feet[wrap(flight.left + k - 1, feet.size())],
                                             feet[wrap(flight.left + k, feet.size())]));
    }
    return path;
}

/// Dances the flight at another speed: `wanted` is how far along `path` the foot is by sample. Each
/// wanted length is looked up in `path`, so the places stay on the same curve.
void fly_as(const std::vector<FootTarget>& feet,
            const Flight& flight,
            const std::vector<double>& path,
            const std::vector<double>& wanted,
            std::vector<FootTarget>& result) {
    std::size_t at = 0;
    for (std::ptrdiff_t k = 1; k < flight.length; ++k) {
        const double way = wanted[static_cast<std::size_t>(k)];
        while (path[at + 1] < way && at + 2 < path.size()) {
            ++at;
        }
        const double step = std::max(path[at + 1] - path[at], 1e-9);
        result[wrap(flight.left + k, feet.size())] =
            place_at(feet,
                     static_cast<double>(flight.left) + static_cast<double>(at) +
                         std::clamp((way - path[at]) / step, 0.0, 1.0));
    }
}

/// Blends a flight's speed profile with that of one reach (minimum jerk), the more the more it
/// halts, but by `least` at least.
void reach(const std::vector<FootTarget>& feet,
           const Flight& flight,
           double least,
           std::vector<FootTarget>& result) {
    const std::vector<double> path = path_of(feet, flight);
    if (path.back() < kShortestPath) {
        return;
    }
    const double share = std::max(least, kOneReach * halt_of(path));
    std::vector<double> wanted;
    for (std::size_t k = 0; k < path.size(); ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(flight.length);
        wanted.push_back(
            std::lerp(path[k], path.back() * static_cast<double>(smootherstep(t)), share));
    }
    fly_as(feet, flight, path, wanted, result);
}

/// Speeds with a single peak over the same total way: the mean of the unimodal upper and lower
/// envelopes, scaled. The envelopes are running maxima towards the peak and running minima away
/// from it.
std::vector<double> with_one_peak(const std::vector<double>& speeds) {
    const auto largest = [](double a, double b) { return std::max(a, b); };
    const auto least = [](double a, double b) { return std::min(a, b); };
    const auto peak = std::max_element(speeds.begin(), speeds.end()) - speeds.begin();
    std::vector<double> above(speeds.size());
    std::vector<double> below(speeds.size());
    std::partial_sum(speeds.begin(), speeds.begin() + peak + 1, above.begin(), largest);
    std::partial_sum(speeds.rbegin(), speeds.rend() - peak, above.rbegin(), largest);
    std::partial_sum(speeds.rend() - peak - 1, speeds.rend(), below.rend() - peak - 1, least);
    std::partial_sum(speeds.begin() + peak, speeds.end(), below.begin() + peak, least);
    std::vector<double> result;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        result.push_back(above[k] + below[k]);
    }
    const double scale = std::accumulate(speeds.begin(), speeds.end(), 0.0) /
                         std::accumulate(result.begin(), result.end(), 0.0);
    for (double& speed : result) {
        speed *= scale;
    }
    return result;
}

/// Replaces one flight's speeds by such with a single peak.
void rise_once(const std::vector<FootTarget>& feet,
               const Flight& flight,
               std::vector<FootTarget>& result) {
    const std::vector<double> path = path_of(feet, flight);
    if (path.back() < kShortestPath) {
        return;
    }
    std::vector<double> speeds(path.size());
    // The first element of adjacent_difference is the value itself, no speed: it is skipped.
    std::adjacent_difference(path.begin(), path.end(), speeds.begin());
    const std::vector<double> even = with_one_peak({speeds.begin() + 1, speeds.end()});
    std::vector<double> wanted = {0.0};
    for (const double speed : even) {
        wanted.push_back(wanted.back() + speed);
    }
    fly_as(feet, flight, path, wanted, result);
}

}  // namespace

std::vector<FootTarget> in_time(const std::vector<PlannedContact>& contacts,
                                const std::vector<FootTarget>& feet) {
    std::vector<double> times(feet.size());
    std::iota(times.begin(), times.end(), 0.0);
    wait(contacts, times);
    std::vector<FootTarget> waiting;
    waiting.reserve(feet.size());
    for (const double time : times) {
        waiting.push_back(place_at(feet, time));
    }
    // Each flight is read from the delayed curve and written to a copy of it.
    std::vector<FootTarget> result = waiting;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Flight flight = flight_before(contacts, c, feet.size());
        if (contacts[c].is_mean && flight.length >= 2) {
            reach(waiting, flight, contacts[c].reach, result);
        }
    }
    return result;
}

std::vector<FootTarget> rising_once(const std::vector<PlannedContact>& contacts,
                                    const std::vector<FootTarget>& feet) {
    std::vector<FootTarget> result = feet;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Flight flight = flight_before(contacts, c, feet.size());
        if (contacts[c].is_mean && flight.length >= 2) {
            rise_once(feet, flight, result);
        }
    }
    return result;
}

namespace {

constexpr std::size_t kOrder = 3;  // of the difference whose square is minimised: jerk
// Coefficients of the third difference.
constexpr std::array<double, kOrder + 1> kThird = {-1.0, 3.0, -3.0, 1.0};

/// Smooths one coordinate of samples first .. first + length - 1: minimises the squared distance to
/// them plus `stiffness` times the squared third differences.
void smooth(std::ptrdiff_t first,
            std::size_t length,
            double stiffness,
            glm::vec3::length_type axis,
            std::vector<glm::vec3>& path) {
    const auto at = [&](std::ptrdiff_t i) -> float& { return path[wrap(i, path.size())][axis]; };
    BandedSystem<kOrder> system(length);
    const auto count = static_cast<std::ptrdiff_t>(length);
    for (std::ptrdiff_t i = 0; i < count; ++i) {
        system.add(i, {1.0}, 1.0, static_cast<double>(at(first + i)));
    }
    // Differences that reach into the rests on either side, whose samples are fixed, are included:
    // they make speed and acceleration continuous there.
    for (std::ptrdiff_t i = -static_cast<std::ptrdiff_t>(kOrder); i < count; ++i) {
        double known = 0.0;  // what the fixed samples contribute to this difference
        for (std::size_t k = 0; k < kThird.size(); ++k) {
            const std::ptrdiff_t sample = i + static_cast<std::ptrdiff_t>(k);
            if (sample < 0 || sample >= count) {
                known += kThird[k] * static_cast<double>(at(first + sample));
            }
        }
        system.add(i, kThird, stiffness, -known);
    }
    const std::vector<double> smooth = system.solve();
    for (std::size_t i = 0; i < length; ++i) {
        at(first + static_cast<std::ptrdiff_t>(i)) = static_cast<float>(smooth[i]);
    }
}

}  // namespace

void fly(const std::vector<bool>& rests, double bandwidth, std::vector<glm::vec3>& path) {
    const std::size_t size = path.size();
    // The third difference multiplies a wave of angular frequency w by (2 sin(w / 2))^3 in
    // amplitude. With this stiffness both terms weigh the same at `bandwidth`, so half of the wave
    // remains.
    const double stiffness = std::pow(2.0 * std::sin(M_PI * bandwidth), -2.0 * kOrder);
    const auto rests_at = [&](std::size_t i) { return static_cast<bool>(rests[i % size]); };
    for (std::size_t i = 0; i < size; ++i) {
        // A flight begins at the last resting sample before it.
        if (!rests_at(i) || rests_at(i + 1)) {
            continue;
        }
        std::size_t length = 0;
        while (!rests_at(i + 1 + length)) {
            ++length;
        }
        for (glm::vec3::length_type axis = 0; axis < 3; ++axis) {
            smooth(static_cast<std::ptrdiff_t>(i) + 1, length, stiffness, axis, path);
        }
    }
}

}  // namespace raks::motion
