#include "render/mannequin/cloth_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace raks::render {
namespace {

constexpr glm::vec3 kWaistMiddle{0.0F, 0.0F, -0.013F};
constexpr float kTurn = glm::radians(360.0F);
// Of a ring, in steps between chains: so that one hangs before and one behind each thigh, which
// then lifts it and does not part two.
constexpr float kFirstChain = 0.5F;

// Over the knee.
constexpr std::array kSkirtRows = {
    1.005F, 0.960F, 0.915F, 0.870F, 0.820F, 0.765F, 0.705F, 0.650F, 0.612F, 0.612F, 0.595F};
constexpr std::array kSkirtJoints = {0.935F, 0.840F, 0.715F, 0.595F};
constexpr std::array kSkirt = {ClothCut{
    .rows = kSkirtRows, .first_hem_row = 9, .joint_heights = kSkirtJoints, .shank_radius = 0.070F}};

// To the ankle; flat in front, where the partner stands, and wide behind.
constexpr std::array kGownRows = {1.005F,
                                  0.960F,
                                  0.915F,
                                  0.870F,
                                  0.810F,
                                  0.740F,
                                  0.660F,
                                  0.570F,
                                  0.480F,
                                  0.390F,
                                  0.300F,
                                  0.210F,
                                  0.125F,
                                  0.125F,
                                  0.105F};
constexpr std::array kGownJoints = {0.935F, 0.800F, 0.660F, 0.520F, 0.400F, 0.260F, 0.105F};
constexpr std::array kGown = {ClothCut{.rows = kGownRows,
                                       .first_hem_row = 13,
                                       .joint_heights = kGownJoints,
                                       .flare = {0.46F, 0.26F, 0.52F},
                                       .folds = 0.10F,
                                       .thigh_radius = 0.112F,
                                       .shank_radius = 0.095F,
                                       .stiffness = 1.1F}};

// Two tails behind, from the waist to the knees.
constexpr std::array kTailRows = {
    1.000F, 0.960F, 0.915F, 0.870F, 0.820F, 0.765F, 0.705F, 0.650F, 0.600F, 0.560F, 0.520F};
constexpr std::array kTailJoints = {0.935F, 0.810F, 0.670F, 0.520F};
constexpr ClothCut kCoatTail{.rows = kTailRows,
                             .first_hem_row = kTailRows.size(),
                             .joint_heights = kTailJoints,
                             .half = {0.176F, 0.120F, 0.128F},
                             .flare = {0.10F, 0.0F, 0.12F},
                             .folds = 0.0F,
                             .is_ring = false,
                             .chains = 3,
                             .columns = 9};
constexpr ClothCut tail(float from, float to) {
    ClothCut cut = kCoatTail;
    cut.from = glm::radians(from);
    cut.to = glm::radians(to);
    return cut;
}
constexpr std::array kCoatTails = {tail(112.0F, 178.0F), tail(182.0F, 248.0F)};

// A scarf that is tied over one hip.
constexpr std::array kScarfRows = {
    0.972F, 0.945F, 0.915F, 0.885F, 0.858F, 0.832F, 0.832F, 0.815F, 0.800F};
constexpr std::array kScarfJoints = {0.950F, 0.870F, 0.800F};
constexpr std::array kScarf = {ClothCut{.rows = kScarfRows,
                                        .first_hem_row = 6,
                                        .joint_heights = kScarfJoints,
                                        .hip_line = 0.890F,
                                        .half = {0.206F, 0.152F, 0.160F},
                                        .flare = {0.22F, 0.22F, 0.22F},
                                        .folds = 0.20F,
                                        .ease = 0.014F,
                                        .hip_ease = 0.026F,
                                        .longer = 0.75F,
                                        .longest_at = glm::radians(55.0F),
                                        .thigh_radius = 0.120F,
                                        .cloth = Paint::stripe}};

/// From the waist down.
float waist_of(const ClothCut& cut) noexcept { return cut.rows.front(); }

/// Angle of a chain.
float azimuth_of(const ClothCut& cut, std::size_t chain) noexcept {
    const auto number = static_cast<float>(chain);
    if (cut.is_ring) {
        return kTurn * (number + kFirstChain) / static_cast<float>(cut.chains);
    }
    return cut.from + (cut.to - cut.from) * number / static_cast<float>(cut.chains - 1);
}

/// Where between two chains an angle lies.
struct BesideChains {
    std::size_t first;
    std::size_t second;
    float share;  // of the second
};
BesideChains beside(const ClothCut& cut, float azimuth) noexcept {
    const auto chains = static_cast<float>(cut.chains);
    if (cut.is_ring) {
        const float turn = azimuth / kTurn * chains - kFirstChain + chains;
        const std::size_t chain = static_cast<std::size_t>(turn) % cut.chains;
        return {chain, (chain + 1) % cut.chains, turn - std::floor(turn)};
    }
    const float at = (azimuth - cut.from) / (cut.to - cut.from) * (chains - 1.0F);
    const auto chain = std::min(static_cast<std::size_t>(std::max(at, 0.0F)), cut.chains - 2);
    return {chain, chain + 1, std::clamp(at - static_cast<float>(chain), 0.0F, 1.0F)};
}

/// Height at an angle of what is `y` high where the cloth is shortest.
float lowered(const ClothCut& cut, float azimuth, float y) noexcept {
    const float near = std::max(0.0F, std::cos(azimuth - cut.longest_at));
    return y - cut.longer * near * near * std::max(waist_of(cut) - y, 0.0F);
}

glm::vec3 hanging(const ClothCut& cut, float azimuth, float y) noexcept {
    const float fall = std::max(cut.hip_line - y, 0.0F);
    const glm::vec3 half = cut.half + fall * cut.flare;
    const float depth = std::cos(azimuth) > 0.0F ? half.y : half.z;
    const float fold = 1.0F + cut.folds * fall * std::cos(10.0F * azimuth);
    return kWaistMiddle +
           glm::vec3{half.x * fold * std::sin(azimuth), y, depth * fold * std::cos(azimuth)};
}

/// On the hips, where it lies on the skin.
float skin_radius(const BodyField& field, float azimuth, float y) noexcept {
    const glm::vec3 direction{std::abs(std::sin(azimuth)), 0.0F, std::cos(azimuth)};
    float away = 0.26F;
    for (int i = 0; i < 24; ++i) {
        const glm::vec3 at = kWaistMiddle + glm::vec3{0.0F, y, 0.0F} + away * direction;
        away -= 0.8F * std::min(field.core(at), field.leg(at));
    }
    return away;
}

/// Number of the row's height among the joints, with its fraction.
float place_on_chain(const ClothCut& cut, float y) noexcept {
    const std::span<const float> heights = cut.joint_heights;
    for (std::size_t i = 0; i + 1 < heights.size(); ++i) {
        if (y >= heights[i + 1]) {
            const float span = heights[i] - heights[i + 1];
            return static_cast<float>(i) + std::clamp((heights[i] - y) / span, 0.0F, 1.0F);
        }
    }
    return static_cast<float>(heights.size() - 1);
}

class Cloth {
 public:
    Cloth(const ClothCut& cut,
          const BodyField& field,
          std::uint16_t hips,
          std::span<const std::uint16_t> joints)
        : cut_(cut), field_(field), hips_(hips), joints_(joints) {}

    [[nodiscard]] PaintedPoint point(std::uint32_t row, std::uint32_t column) const noexcept {
        const float y = cut_.rows[row];
        const float down = (waist_of(cut_) - y) / (waist_of(cut_) - cut_.rows.back());
        const float azimuth = azimuth_at(column);
        PaintedPoint made{.paint = row >= cut_.first_hem_row ? cut_.hem : cut_.cloth};
        made.position = place(azimuth, y);
        constexpr float kStep = 0.01F;
        const glm::vec3 around = place(azimuth + kStep, y) - place(azimuth - kStep, y);
        const glm::vec3 along = place(azimuth, y - kStep) - place(azimuth, y + kStep);
        made.normal = glm::normalize(glm::cross(along, around));
        made.open = 0.9F + 0.1F * std::cos(10.0F * azimuth) * down;
        set_weights(azimuth, y, made);
        return made;
    }

 private:
    [[nodiscard]] float azimuth_at(std::uint32_t column) const noexcept {
        const auto number = static_cast<float>(column);
        const auto columns = static_cast<float>(cut_.columns);
        return cut_.is_ring ? kTurn * number / columns
                            : cut_.from + (cut_.to - cut_.from) * number / (columns - 1.0F);
    }

    [[nodiscard]] glm::vec3 place(float azimuth, float row) const noexcept {
        const float y = lowered(cut_, azimuth, row);
        const glm::vec3 free = hanging(cut_, azimuth, y);
        if (y < cut_.hip_line - 0.03F) {
            return free;
        }
        const float ease = cut_.hip_ease + (cut_.ease - cut_.hip_ease) *
                                               smoothstep(cut_.hip_line + 0.04F, waist_of(cut_), y);
        const float away = skin_radius(field_, azimuth, y) + ease;
        const glm::vec3 on_skin =
            kWaistMiddle + glm::vec3{away * std::sin(azimuth), y, away * std::cos(azimuth)};
        const float share = smoothstep(cut_.hip_line - 0.03F, cut_.hip_line + 0.03F, y);
        return free + share * (on_skin - free);
    }

    /// Two chains beside the point, and on each the joint above it; the waist follows the hips.
    void set_weights(float azimuth, float y, PaintedPoint& made) const noexcept {
        const BesideChains chains = beside(cut_, azimuth);
        const float at = place_on_chain(cut_, y);
        const auto joint = std::min(static_cast<std::size_t>(at), cut_.joint_heights.size() - 2);
        const std::uint16_t first = joints_[chains.first * cut_.joint_heights.size() + joint];
        const std::uint16_t second = joints_[chains.second * cut_.joint_heights.size() + joint];
        made.joints = {first, second, hips_, 0};
        const float root = cut_.joint_heights[0];
        const float free =
            1.0F -
            std::clamp((y - (root - 0.02F)) / (waist_of(cut_) - 0.03F - root + 0.02F), 0.0F, 1.0F);
        made.weights = {free * (1.0F - chains.share), free * chains.share, 1.0F - free, 0.0F};
    }

    const ClothCut& cut_;
    const BodyField& field_;
    std::uint16_t hips_;
    std::span<const std::uint16_t> joints_;
};

}  // namespace

std::span<const ClothCut> cloth_of(MannequinStyle style) noexcept {
    const bool is_lead = style.build == MannequinBuild::lead;
    switch (style.costume) {
        case Costume::unitard:
            return is_lead ? std::span<const ClothCut>() : kSkirt;
        case Costume::street:
            return {};
        case Costume::oriental:
            return kScarf;
        case Costume::ballroom:
            return is_lead ? std::span<const ClothCut>(kCoatTails) : kGown;
    }
    return {};
}

std::vector<glm::vec3> cloth_chain(const ClothCut& cut, std::size_t chain) {
    const float azimuth = azimuth_of(cut, chain);
    std::vector<glm::vec3> places;
    for (const float height : cut.joint_heights) {
        places.push_back(hanging(cut, azimuth, lowered(cut, azimuth, height)));
    }
    return places;
}

void add_cloth(const ClothCut& cut,
               const BodyField& field,
               std::uint16_t hips,
               std::span<const std::uint16_t> joints,
               PaintedMesh& mesh) {
    const Cloth cloth(cut, field, hips, joints);
    const std::uint32_t first = mesh.size();
    const auto rows = static_cast<std::uint32_t>(cut.rows.size());
    for (std::uint32_t row = 0; row < rows; ++row) {
        for (std::uint32_t column = 0; column < cut.columns; ++column) {
            mesh.add(cloth.point(row, column));
        }
    }
    mesh.connect({.first = first, .rows = rows, .columns = cut.columns, .is_ring = cut.is_ring});
}

}  // namespace raks::render
