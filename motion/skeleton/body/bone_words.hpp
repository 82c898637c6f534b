// What the name of a node says of the bone it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "motion/skeleton/humanoid.hpp"

namespace raks::motion {

/// The parts of a body that names speak of. `arm` and `leg` may be upper or lower: the rest of the
/// names decides. `finger` has a number instead of a name.
enum class BodyPart : std::uint8_t {
    none,
    root,
    hips,
    spine,
    chest,
    upper_chest,
    neck,
    head,
    eye,
    jaw,
    collar_bone,  ///< never the upper arm, as a `shoulder` may be
    shoulder,
    arm,
    upper_arm,
    lower_arm,
    hand,
    leg,
    upper_leg,
    lower_leg,
    foot,
    toes,
    thumb,
    index,
    middle,
    ring,
    little,
    finger,
};

/// What a name says.
struct BoneWords {
    BodyPart part = BodyPart::none;
    std::optional<Side> side;
    /// 0: the usual word. Above: another would be better ("twist", "palm", a hip on one side).
    int doubt = 0;
    /// `finger`: its number as written (Biped counts from 0, MakeHuman from 1), -1: none.
    int finger = -1;
    bool is_metacarpal = false;  ///< of a finger that VRM does not count
};

/// The words of a name, in lower case: "mixamorig:LeftForeArm" is "left", "fore", "arm". Split at
/// all that is no letter, at capitals and before and behind numbers, which stay words. Japanese
/// (MikuMikuDance) and French words are put into English.
[[nodiscard]] std::vector<std::string> words_of_name(std::string_view name);

/// Words that more than half of the names share and that name no part: "bip", "character".
[[nodiscard]] std::unordered_set<std::string> shared_words(
    const std::vector<std::vector<std::string>>& names);

/// What words say, without those in `noise`. Any other word that is not known makes it nothing:
/// "hand bag" is no hand.
[[nodiscard]] BoneWords read_bone_words(const std::vector<std::string>& words,
                                        const std::unordered_set<std::string>& noise);

}  // namespace raks::motion
