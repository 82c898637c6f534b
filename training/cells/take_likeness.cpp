#include "training/cells/take_likeness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/random.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {
namespace {

// A body about its hips, by kMomentBones.
using Body = std::array<glm::vec3, kMomentBones.size()>;

constexpr double kNearby = 8.0;  // seconds, of random moments

double apart(const Body& a, const Body& b) {
    float squares = 0.0F;
    for (std::size_t joint = 0; joint < a.size(); ++joint) {
        const glm::vec3 between = a[joint] - b[joint];
        squares += glm::dot(between, between);
    }
    return std::sqrt(static_cast<double>(squares));
}

std::vector<Body> bodies_of(const GridCues& cues) {
    const auto step = static_cast<std::size_t>(kCueRate / kLikenessRate);
    std::vector<Body> bodies;
    for (std::size_t row = 0; row < cues.rows(); row += step) {
        Body& body = bodies.emplace_back();
        for (std::size_t joint = 0; joint < body.size(); ++joint) {
            body[joint] = glm::vec3(cues.moments[row].places[joint]);
        }
    }
    return bodies;
}

// The mean distance of random moments around each row.
std::vector<double> random_distances(const std::vector<Body>& bodies) {
    constexpr std::uint64_t kPairs = 60;
    constexpr std::size_t kEvery = 15;  // rows; between them it hardly changes
    const auto reach = static_cast<std::size_t>(kNearby / 2.0 * kLikenessRate);
    const CounterRandom random(1, 0);
    std::vector<double> bases(bodies.size());
    std::uint64_t drawn = 0;
    for (std::size_t row = 0; row < bodies.size(); ++row) {
        if (row % kEvery != 0) {
            bases[row] = bases[row - 1];
            continue;
        }
        const std::size_t first = row > reach ? row - reach : 0;
        const std::size_t count = std::min(row + reach, bodies.size()) - first;
        double sum = 0.0;
        for (std::uint64_t pair = 0; pair < kPairs; ++pair) {
            const std::size_t one = first + random.below(drawn++, count);
            const std::size_t other = first + random.below(drawn++, count);
            sum += apart(bodies[one], bodies[other]);
        }
        bases[row] = std::max(sum / static_cast<double>(kPairs), 1e-6);
    }
    return bases;
}

}  // namespace

TakeLikeness::TakeLikeness(const GridCues& cues, double longest) {
    const std::vector<Body> bodies = bodies_of(cues);
    bases_ = random_distances(bodies);
    const auto lags =
        std::min(static_cast<std::size_t>(longest * kLikenessRate) + 2, bodies.size());
    for (std::size_t lag = 0; lag < lags; ++lag) {
        std::vector<double>& sums = sums_.emplace_back(1, 0.0);
        for (std::size_t row = 0; row + lag < bodies.size(); ++row) {
            sums.push_back(sums.back() + apart(bodies[row], bodies[row + lag]) / bases_[row]);
        }
    }
}

double TakeLikeness::mean(std::size_t from, std::size_t to, std::size_t lag) const {
    if (lag >= sums_.size()) {
        return 1.0;
    }
    const std::vector<double>& sums = sums_[lag];
    const std::size_t last = std::min(to, sums.size() - 1);
    return from < last ? (sums[last] - sums[from]) / static_cast<double>(last - from) : 1.0;
}

double TakeLikeness::distance(std::size_t from, std::size_t to, double lag_seconds) const {
    const double lag = lag_seconds * kLikenessRate;
    const auto below = static_cast<std::size_t>(lag);
    const double t = lag - static_cast<double>(below);
    return (1.0 - t) * mean(from, to, below) + t * mean(from, to, below + 1);
}

}  // namespace raks::motion
