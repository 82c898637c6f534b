#include "render/mannequin/skirt_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "base/smooth_steps.hpp"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>

namespace raks::render {
namespace {

// All lengths in metres, in the T-pose.
constexpr float kWaist = 1.005F;
constexpr float kHem = 0.595F;
constexpr float kHipLine = 0.905F;  // from here down it hangs free
constexpr std::array kJointHeights = {0.935F, 0.840F, 0.715F, kHem};
constexpr glm::vec3 kSkirtMiddle{0.0F, 0.0F, -0.013F};
constexpr std::uint32_t kSkirtColumns = 40;
// Heights of the rows; two at one place where the hem's colour begins.
constexpr std::array kRowHeights = {
    1.005F, 0.960F, 0.915F, 0.870F, 0.820F, 0.765F, 0.705F, 0.650F, 0.612F, 0.612F, kHem};
constexpr std::size_t kFirstHemRow = 9;
// Of a step between chains: so that one hangs before and one behind each thigh, which then lifts
// it and does not part two.
constexpr float kFirstChain = 0.5F;
constexpr float kSkirtTurn = glm::radians(360.0F);
// Off the skin: at the waist, and on the hips, which bulge when a thigh turns.
constexpr float kEase = 0.006F;
constexpr float kHipEase = 0.016F;

/// Half axes of the hanging part: it widens downward.
glm::vec2 half_axes(float y) noexcept {
    const float fall = std::max(kHipLine - y, 0.0F);
    return {0.180F + 0.30F * fall, 0.132F + 0.35F * fall};
}

glm::vec3 hanging(float azimuth, float y) noexcept {
    const glm::vec2 half = half_axes(y);
    const float fall = std::max(kHipLine - y, 0.0F);
    // Folds grow downward; five waves to each side.
    const float fold = 1.0F + 0.16F * fall * std::cos(10.0F * azimuth);
    return kSkirtMiddle +
           glm::vec3{half.x * fold * std::sin(azimuth), y, half.y * fold * std::cos(azimuth)};
}

/// On the hips, where it lies on the skin.
float skin_radius(const BodyField& field, float azimuth, float y) noexcept {
    const glm::vec3 direction{std::abs(std::sin(azimuth)), 0.0F, std::cos(azimuth)};
    float away = 0.26F;
    for (int i = 0; i < 24; ++i) {
        const glm::vec3 at = kSkirtMiddle + glm::vec3{0.0F, y, 0.0F} + away * direction;
        away -= 0.8F * std::min(field.core(at), field.leg(at));
    }
    return away;
}

/// Number of the row's height among the joints, with its fraction.
float place_on_chain(float y) noexcept {
    for (std::size_t i = 0; i + 1 < kJointHeights.size(); ++i) {
        if (y >= kJointHeights[i + 1]) {
            const float span = kJointHeights[i] - kJointHeights[i + 1];
            return static_cast<float>(i) + std::clamp((kJointHeights[i] - y) / span, 0.0F, 1.0F);
        }
    }
    return static_cast<float>(kJointHeights.size() - 1);
}

class Skirt {
 public:
    Skirt(const BodyField& field, std::uint16_t hips, std::span<const std::uint16_t> joints)
        : field_(field), hips_(hips), joints_(joints) {}

    [[nodiscard]] PaintedPoint point(std::uint32_t row, std::uint32_t column) const noexcept {
        const float y = kRowHeights[row];
        const float down = (kWaist - y) / (kWaist - kHem);
        const float azimuth = kSkirtTurn * static_cast<float>(column) / kSkirtColumns;
        PaintedPoint made{.paint = row >= kFirstHemRow ? Paint::trim : Paint::suit};
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
    [[nodiscard]] glm::vec3 place(float azimuth, float y) const noexcept {
        const glm::vec3 free = hanging(azimuth, y);
        if (y < kHipLine - 0.03F) {
            return free;
        }
        const float ease = kHipEase + (kEase - kHipEase) * smoothstep(0.945F, kWaist, y);
        const float away = skin_radius(field_, azimuth, y) + ease;
        const glm::vec3 on_skin =
            kSkirtMiddle + glm::vec3{away * std::sin(azimuth), y, away * std::cos(azimuth)};
        const float share = smoothstep(kHipLine - 0.03F, kHipLine + 0.03F, y);
        return free + share * (on_skin - free);
    }

    /// Two chains beside the point, and on each the joint above it; the waist follows the hips.
    void set_weights(float azimuth, float y, PaintedPoint& made) const noexcept {
        const auto chains = static_cast<float>(kSkirtChains);
        const float turn = azimuth / kSkirtTurn * chains - kFirstChain + chains;
        const auto chain = static_cast<std::size_t>(turn) % kSkirtChains;
        const std::size_t beside = (chain + 1) % kSkirtChains;
        const float share = turn - std::floor(turn);
        const float at = place_on_chain(y);
        const auto joint = std::min(static_cast<std::size_t>(at), kSkirtJoints - 2);
        const std::uint16_t first = joints_[chain * kSkirtJoints + joint];
        const std::uint16_t second = joints_[beside * kSkirtJoints + joint];
        made.joints = {first, second, hips_, 0};
        const float free = 1.0F - std::clamp((y - (kJointHeights[0] - 0.02F)) /
                                                 (kWaist - 0.03F - kJointHeights[0] + 0.02F),
                                             0.0F,
                                             1.0F);
        made.weights = {free * (1.0F - share), free * share, 1.0F - free, 0.0F};
    }

    const BodyField& field_;
    std::uint16_t hips_;
    std::span<const std::uint16_t> joints_;
};

}  // namespace

std::array<glm::vec3, kSkirtJoints> skirt_chain(std::size_t chain) noexcept {
    const float azimuth =
        kSkirtTurn * (static_cast<float>(chain) + kFirstChain) / static_cast<float>(kSkirtChains);
    std::array<glm::vec3, kSkirtJoints> places{};
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i] = hanging(azimuth, kJointHeights[i]);
    }
    return places;
}

void add_skirt(const BodyField& field,
               std::uint16_t hips,
               std::span<const std::uint16_t> joints,
               PaintedMesh& mesh) {
    const Skirt skirt(field, hips, joints);
    const std::uint32_t first = mesh.size();
    for (std::uint32_t row = 0; row < kRowHeights.size(); ++row) {
        for (std::uint32_t column = 0; column < kSkirtColumns; ++column) {
            mesh.add(skirt.point(row, column));
        }
    }
    mesh.connect(
        {.first = first, .rows = kRowHeights.size(), .columns = kSkirtColumns, .is_ring = true});
}

}  // namespace raks::render
