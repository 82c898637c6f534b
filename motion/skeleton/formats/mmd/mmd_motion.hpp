// MMD motion: the keys of a dance of MikuMikuDance, whatever file they come from.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "motion/skeleton/formats/mmd/mmd_body.hpp"
#include "motion/skeleton/formats/mmd/mmd_bones.hpp"

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace raks::motion {

/// Frames a second of every motion of MikuMikuDance.
inline constexpr double kMmdRate = 30.0;

/// The curve of one channel from the key before: two handles between (0, 0) and (127, 127).
struct MmdCurve {
    std::uint8_t x1 = 20;
    std::uint8_t y1 = 20;
    std::uint8_t x2 = 107;
    std::uint8_t y2 = 107;

    friend bool operator==(const MmdCurve&, const MmdCurve&) = default;
};
/// How far a channel has come, 0 to 1, when `share` (0 to 1) of the time has passed.
[[nodiscard]] double mmd_progress(const MmdCurve& curve, double share);

/// A key of a bone, in our axes and in metres.
struct MmdBoneKey {
    std::uint32_t frame = 0;
    glm::vec3 place{0.0F};                   ///< from rest
    glm::quat turn{1.0F, 0.0F, 0.0F, 0.0F};  ///< unit
    std::array<MmdCurve, 4> curves{};        ///< of x, y, z and the turn; towards this key
};

/// A key of a morph.
struct MmdMorphKey {
    std::uint32_t frame = 0;
    float weight = 0.0F;  ///< usually 0 to 1
};

/// From a frame on, whether a bone's inverse kinematics is on.
struct MmdSwitchKey {
    std::uint32_t frame = 0;
    bool is_on = true;
};

/// The morphs that MikuMikuDance's bodies share: mmd_morphs.hpp.
inline constexpr std::size_t kMmdMorphs = 27;

/// All keys that move a body, each list sorted by frame, no frame twice.
struct MmdMotion {
    std::array<std::vector<MmdBoneKey>, kMmdBones> bones;
    std::array<std::vector<MmdMorphKey>, kMmdMorphs> morphs;
    std::array<std::vector<MmdSwitchKey>, 2> leg_ik;  ///< by Side
    std::array<std::vector<MmdSwitchKey>, 2> toe_ik;  ///< by Side
    /// What was left out or mended; one line each, without the file's name.
    std::vector<std::string> warnings;

    /// Whether any bone has a key.
    [[nodiscard]] bool has_body() const;
    /// The largest frame of a key of a bone or a morph; 0 without any.
    [[nodiscard]] std::uint32_t last_frame() const;
};

/// Reads the keys frame by frame. The motion must outlive it. Threads: one. Real-time: no.
class MmdSampler {
 public:
    explicit MmdSampler(const MmdMotion& motion) : motion_(&motion) {}

    /// What the keys say at a frame, not smaller than the one before: between two keys each channel
    /// by its curve, before the first and behind the last held; a bone without keys rests.
    [[nodiscard]] MmdPose pose_at(std::uint32_t frame);
    /// The weights of the morphs at a frame, likewise; between two keys in a straight line.
    [[nodiscard]] std::array<float, kMmdMorphs> morphs_at(std::uint32_t frame);

 private:
    const MmdMotion* motion_;
    std::array<std::size_t, kMmdBones> bone_keys_{};    // the last key at or before the frame
    std::array<std::size_t, kMmdMorphs> morph_keys_{};  // likewise
};

/// Sorts keys by frame; of two of one frame the later one is kept.
template <typename Key>
void sort_keys(std::vector<Key>& keys) {
    std::stable_sort(
        keys.begin(), keys.end(), [](const Key& a, const Key& b) { return a.frame < b.frame; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool is_same = kept > 0 && keys[kept - 1].frame == keys[i].frame;
        keys[is_same ? kept - 1 : kept++] = keys[i];
    }
    keys.resize(kept);
}

}  // namespace raks::motion
