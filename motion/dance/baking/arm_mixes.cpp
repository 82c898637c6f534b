#include "motion/dance/baking/arm_mixes.hpp"

#include "base/assert.hpp"

namespace raks::motion {
namespace {

constexpr double kStep = 0.125;  // beats between samples
// Cosine of half of 120 degrees, the dot product of two quaternions
constexpr float kNearest = 0.5F;

// The dot product is signed: with signs made to agree a negative one is the longer way round.
bool can_mix(const FigurePassage& a, const FigurePassage& b, int beats) {
    for (double beat = -FigurePassage::kMargin; beat <= beats + FigurePassage::kMargin;
         beat += kStep) {
        Pose one;
        Pose other;
        a.arms_at(beat, one);
        b.arms_at(beat, other);
        for (std::size_t i = FigurePassage::kBones.size() - FigurePassage::kArmBones;
             i < FigurePassage::kBones.size();
             ++i) {
            const Bone bone = FigurePassage::kBones[i];
            if (glm::dot(one.rotation(bone), other.rotation(bone)) < kNearest) {
                return false;
            }
        }
    }
    return true;
}

}  // namespace

ArmMixes arm_mixes(std::span<const FigurePassage> passages, int beats) {
    RAKS_ASSERT(passages.size() <= kWays);
    ArmMixes mixes;
    for (std::size_t a = 0; a < passages.size(); ++a) {
        for (std::size_t b = 0; b < a; ++b) {
            mixes[a][b] = mixes[b][a] = can_mix(passages[a], passages[b], beats);
        }
    }
    return mixes;
}

}  // namespace raks::motion
