#include "motion/dance/step_timing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

#include "motion/dance/closed_curve.hpp"
#include "motion/dance/easing.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr double kMostSlowed = 0.4;     // of a flight or a contact
constexpr double kOneReach = 0.5;       // its share where a foot halts altogether
constexpr double kHaltedBelow = 0.15;   // of the highest speed: less is no movement of its own
constexpr double kShortestPath = 0.05;  // metres
constexpr float kFootLength = 0.2F;     // metres, that turning moves it by

/// Samples of one flight: from the last one of a contact to the first one of the next.
struct Flight {
    std::ptrdiff_t left = 0;
    std::ptrdiff_t length = 0;
};

Flight flight_before(const std::vector<PlannedContact>& contacts, std::size_t c, std::size_t size) {
    const ContactWindow& before = contacts[(c + contacts.size() - 1) % contacts.size()].window;
    const auto left = static_cast<std::ptrdiff_t>(before.first + before.length) - 1;
    const auto first = static_cast<std::ptrdiff_t>(contacts[c].window.first);
    return {left, static_cast<std::ptrdiff_t>(wrap(first - left, size))};
}

FootTarget place_at(const std::vector<FootTarget>& feet, double sample) {
    const auto from = static_cast<std::ptrdiff_t>(std::floor(sample));
    const FootTarget& a = feet[wrap(from, feet.size())];
    const FootTarget& b = feet[wrap(from + 1, feet.size())];
    const auto share = static_cast<float>(sample - static_cast<double>(from));
    return {glm::mix(a.ankle, b.ankle, share), glm::slerp(a.rotation, b.rotation, share)};
}

double between(const FootTarget& a, const FootTarget& b) {
    const float turn = 1.0F - std::abs(glm::dot(a.rotation, b.rotation));
    return static_cast<double>(glm::distance(a.ankle, b.ankle)) +
           static_cast<double>(kFootLength * std::sqrt(std::max(0.0F, 2.0F * turn)));
}

/// Slows the steps that come down too soon. (Late ones hurried would be faster than people's.)
void wait(const std::vector<PlannedContact>& contacts, std::vector<double>& times) {
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Flight flight = flight_before(contacts, c, times.size());
        const auto first = static_cast<std::ptrdiff_t>(contacts[c].window.first);
        const auto rest = static_cast<std::ptrdiff_t>(contacts[c].window.length);
        if (!contacts[c].arrival || flight.length < 2) {
            continue;
        }
        const auto shorter = static_cast<double>(std::min(flight.length, rest));
        const double apart = std::clamp(
            *contacts[c].arrival - static_cast<double>(first), -kMostSlowed * shorter, 0.0);
        for (std::ptrdiff_t k = -flight.length; k <= rest; ++k) {
            const auto whole = static_cast<float>(k < 0 ? flight.length : rest);
            const float near = 1.0F - static_cast<float>(std::abs(k)) / whole;
            times[wrap(first + k, times.size())] += apart * static_cast<double>(smootherstep(near));
        }
    }
}

/// How much a flight halts on its way: 0 for one that speeds up and slows down once, 1 for one that
/// stops in between. `path`: way by sample.
double halt_of(const std::vector<double>& path) {
    const std::size_t steps = path.size() - 1;
    std::vector<double> after(steps);  // fastest from here on
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

/// Evens one flight's speed along its path, as far as it halts.
void reach(const std::vector<FootTarget>& feet,
           const Flight& flight,
           double least,
           std::vector<FootTarget>& result) {
    std::vector<double> path = {0.0};
    for (std::ptrdiff_t k = 1; k <= flight.length; ++k) {
        path.push_back(path.back() + between(feet[wrap(flight.left + k - 1, feet.size())],
                                             feet[wrap(flight.left + k, feet.size())]));
    }
    if (path.back() < kShortestPath) {
        return;
    }
    const double share = std::max(least, kOneReach * halt_of(path));
    std::size_t at = 0;
    for (std::ptrdiff_t k = 1; k < flight.length; ++k) {
        const float t = static_cast<float>(k) / static_cast<float>(flight.length);
        const double wanted = std::lerp(path[static_cast<std::size_t>(k)],
                                        path.back() * static_cast<double>(smootherstep(t)),
                                        share);
        while (path[at + 1] < wanted && at + 2 < path.size()) {
            ++at;
        }
        const double step = std::max(path[at + 1] - path[at], 1e-9);
        result[wrap(flight.left + k, feet.size())] =
            place_at(feet,
                     static_cast<double>(flight.left) + static_cast<double>(at) +
                         std::clamp((wanted - path[at]) / step, 0.0, 1.0));
    }
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
    std::vector<FootTarget> result = waiting;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
        const Flight flight = flight_before(contacts, c, feet.size());
        if (contacts[c].is_mean && flight.length >= 2) {
            reach(waiting, flight, contacts[c].reach, result);
        }
    }
    return result;
}

}  // namespace raks::motion
