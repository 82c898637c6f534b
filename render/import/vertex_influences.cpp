#include "render/import/vertex_influences.hpp"

#include <algorithm>
#include <cmath>

namespace raks::render {
namespace {

constexpr float kUneven = 1e-3F;
constexpr float kSumSlack = 0.05F;

struct Influence {
    std::uint32_t joint = 0;
    float weight = 0.0F;
};

/// The influences of one vertex: no negative weights, none twice that weighs.
class VertexInfluences {
 public:
    void add(std::uint32_t joint, float weight, InfluenceFaults& faults) {
        if (weight < 0.0F) {
            faults.has_negative = true;
            weight = 0.0F;
        }
        if (weight == 0.0F) {
            faults.unused = std::max(faults.unused, static_cast<int>(joint));
            return;
        }
        faults.used = std::max(faults.used, static_cast<int>(joint));
        sum_ += weight;
        if (count_ < all_.size()) {
            all_[count_++] = {joint, weight};
        }
    }

    [[nodiscard]] float sum() const noexcept { return sum_; }
    [[nodiscard]] std::size_t count() const noexcept { return count_; }

    /// The four largest.
    std::array<Influence, 4> largest() {
        const auto middle = all_.begin() + 4;
        std::stable_sort(
            all_.begin(),
            all_.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(count_, 4)),
            [](const Influence& a, const Influence& b) { return a.weight > b.weight; });
        std::array<Influence, 4> four;
        std::copy(all_.begin(), middle, four.begin());
        return four;
    }

 private:
    std::array<Influence, 16> all_{};
    std::size_t count_ = 0;
    float sum_ = 0.0F;
};

}  // namespace

InfluenceFaults merge_influences(const RawInfluences& raw,
                                 std::vector<std::array<std::uint16_t, 4>>& joints,
                                 std::vector<std::array<float, 4>>& weights) {
    InfluenceFaults faults;
    joints.resize(raw.vertices);
    weights.resize(raw.vertices);
    for (std::size_t v = 0; v < raw.vertices; ++v) {
        VertexInfluences influences;
        for (std::size_t set = 0; set < raw.joints.size(); ++set) {
            for (std::size_t i = 4 * v; i < 4 * v + 4; ++i) {
                influences.add(raw.joints[set][i], raw.weights[set][i], faults);
            }
        }
        faults.uneven += std::abs(influences.sum() - 1.0F) > kUneven ? 1U : 0U;
        if (influences.count() == 0) {
            faults.has_none = true;
            influences.add(raw.joints.front()[4 * v], 1.0F, faults);
        }
        faults.has_other_sum =
            faults.has_other_sum || std::abs(influences.sum() - 1.0F) > kSumSlack;
        faults.has_more = faults.has_more || influences.count() > 4;
        const auto four = influences.largest();
        const float sum = four[0].weight + four[1].weight + four[2].weight + four[3].weight;
        for (std::size_t i = 0; i < 4; ++i) {
            joints[v][i] = static_cast<std::uint16_t>(four[i].joint);
            weights[v][i] = four[i].weight / sum;
        }
    }
    return faults;
}

}  // namespace raks::render
