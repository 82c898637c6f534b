#include "motion/skeleton/points/guessed_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

constexpr std::size_t kMostDistances = 40'000'000;
constexpr std::size_t kMostFramesTried = 400;
constexpr std::size_t kFewestFramesTried = 40;
constexpr double kOutside = 0.05;       // share of the frames on each side of the range
constexpr double kLeastTogether = 0.1;  // share of the frames looked at
// Of a pair's distance: how much of it counts against the pair, so that of equally rigid ones the
// nearest are joined; and how much it may vary.
constexpr double kForDistance = 0.1;
constexpr double kMostVariation = 0.2;
constexpr double kNever = std::numeric_limits<double>::infinity();

// The frames looked at: evenly over the clip, fewer where there are many pairs.
std::vector<std::size_t> frames_looked_at(const PointClip& clip) {
    const std::size_t points = clip.names.size();
    const std::size_t pairs = std::max<std::size_t>(1, points * (points - 1) / 2);
    const std::size_t affordable =
        std::clamp(kMostDistances / pairs, kFewestFramesTried, kMostFramesTried);
    const std::size_t count = std::min(affordable, clip.frame_count);
    std::vector<std::size_t> frames;
    for (std::size_t i = 0; i < count; ++i) {
        frames.push_back(count == 1 ? 0 : i * (clip.frame_count - 1) / (count - 1));
    }
    return frames;
}

// What joining a pair costs.
class PairCost {
 public:
    explicit PairCost(const PointClip& clip)
        : clip_(clip),
          frames_(frames_looked_at(clip)),
          least_together_(std::max<std::size_t>(
              1, static_cast<std::size_t>(kLeastTogether * static_cast<double>(frames_.size())))) {}

    // kNever: they do not keep their distance, or are hardly seen together.
    double of(std::size_t one, std::size_t other) {
        distances_.clear();
        for (const std::size_t frame : frames_) {
            const double distance =
                glm::distance(clip_.position(frame, one), clip_.position(frame, other));
            if (!std::isnan(distance)) {
                distances_.push_back(distance);
            }
        }
        if (distances_.size() < least_together_) {
            return kNever;
        }
        const auto outside =
            static_cast<std::size_t>(kOutside * static_cast<double>(distances_.size()));
        const double low = at_rank(outside);
        const double high = at_rank(distances_.size() - 1 - outside);
        const double middle = at_rank(distances_.size() / 2);
        const double variation = 0.5 * (high - low);
        return variation > kMostVariation * middle ? kNever : variation + kForDistance * middle;
    }

 private:
    double at_rank(std::size_t rank) {
        const auto at = distances_.begin() + static_cast<std::ptrdiff_t>(rank);
        std::nth_element(distances_.begin(), at, distances_.end());
        return *at;
    }

    const PointClip& clip_;
    std::vector<std::size_t> frames_;
    std::size_t least_together_;
    std::vector<double> distances_;  // of the pair looked at
};

}  // namespace

// Prim's way: the tree grows by its cheapest pair, so that each pair is looked at once and none is
// kept. Where nothing more can be joined, another tree begins.
std::vector<PointEdge> guess_edges(const PointClip& clip) {
    const std::size_t count = clip.names.size();
    if (count < 2 || clip.frame_count == 0) {
        return {};
    }
    PairCost cost(clip);
    std::vector<double> cheapest(count, kNever);  // to the trees so far
    std::vector<std::size_t> partner(count, 0);
    std::vector<bool> is_in_tree(count, false);
    std::vector<PointEdge> edges;
    for (std::size_t round = 0; round < count; ++round) {
        std::size_t next = count;
        for (std::size_t point = 0; point < count; ++point) {
            const bool is_cheaper = next == count || cheapest[point] < cheapest[next];
            next = !is_in_tree[point] && is_cheaper ? point : next;
        }
        is_in_tree[next] = true;
        if (cheapest[next] < kNever) {
            edges.push_back({std::min(next, partner[next]), std::max(next, partner[next])});
        }
        for (std::size_t point = 0; point < count; ++point) {
            if (is_in_tree[point]) {
                continue;
            }
            if (const double joined = cost.of(next, point); joined < cheapest[point]) {
                cheapest[point] = joined;
                partner[point] = next;
            }
        }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
}

}  // namespace raks::motion
