// What names of joints and nodes say: words, sides, languages.
#include "motion/skeleton/body/bone_words.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace raks::motion {
namespace {

TEST(BoneWords, names_are_split_as_they_are_read) {
    using Words = std::vector<std::string>;
    EXPECT_EQ(words_of_name("mixamorig:LeftForeArm"), (Words{"left", "fore", "arm"}));
    EXPECT_EQ(words_of_name("LThumb"), (Words{"l", "thumb"}));
    EXPECT_EQ(words_of_name("f_index03L"), (Words{"f", "index", "03", "l"}));
    EXPECT_EQ(words_of_name("bras gauche.001"), (Words{"bras", "gauche", "001"}));
    EXPECT_EQ(words_of_name("左足首"), (Words{"left", "foot"}));
    EXPECT_EQ(words_of_name(""), Words{});
    EXPECT_EQ(words_of_name("\xff\x80:"), Words{});
}

TEST(BoneWords, what_is_no_bone_is_nothing) {
    for (const char* const name : {"LeftHandBag",
                                   "Hair_Front_1",
                                   "PoleTarget.L",
                                   "IK_Hand_L",
                                   "LeftHandThumb4_end",
                                   "HeadTop_End",
                                   "socket_hand_L",
                                   "Cube"}) {
        EXPECT_EQ(read_bone_words(words_of_name(name), {}).part, BodyPart::none) << name;
    }
}

struct Said {
    const char* name;
    BodyPart part;
    std::optional<Side> side;
};

TEST(BoneWords, of_four_languages_say_part_and_side) {
    const Said table[] = {
        {"LeftForeArm", BodyPart::lower_arm, Side::left},
        {"L_clavicle_bind_JNT", BodyPart::collar_bone, Side::left},
        {"L_armUpper0001_bind_JNT", BodyPart::upper_arm, Side::left},
        {"R_legLower0001_bind_JNT", BodyPart::lower_leg, Side::right},
        {"lfemur", BodyPart::upper_leg, Side::left},
        {"rhumerus", BodyPart::upper_arm, Side::right},
        {"righthand", BodyPart::hand, Side::right},
        {"thigh_l", BodyPart::upper_leg, Side::left},
        {"LUArm", BodyPart::upper_arm, Side::left},
        {"RFArm", BodyPart::lower_arm, Side::right},
        {"ElbowLeft", BodyPart::lower_arm, Side::left},
        {"left_hip", BodyPart::upper_leg, Side::left},
        {"SpineBase", BodyPart::hips, std::nullopt},
        {"SPINE_CHEST", BodyPart::chest, std::nullopt},
        {"L5", BodyPart::spine, std::nullopt},
        {"T8", BodyPart::spine, std::nullopt},
        {"Oberschenkel_L", BodyPart::upper_leg, Side::left},
        {"Unterarm_rechts", BodyPart::lower_arm, Side::right},
        {"linkes Knie", BodyPart::lower_leg, Side::left},
        {"H\xC3\xBC"
         "fte",
         BodyPart::hips,
         std::nullopt},
        {"Fu\xC3\x9F.R", BodyPart::foot, Side::right},
        {"muslo_izq", BodyPart::upper_leg, Side::left},
        {"antebrazo derecho", BodyPart::lower_arm, Side::right},
        {"mu\xC3\xB1"
         "eca_izquierda",
         BodyPart::hand,
         Side::left},
        {"cuisse gauche", BodyPart::upper_leg, Side::left},
        {"avant-bras droit", BodyPart::lower_arm, Side::right},
        {"\xE5\xB7\xA6\xE3\x81\xB2\xE3\x81\x98", BodyPart::lower_arm, Side::left},
        {"\xE5\x8F\xB3\xE5\xA4\xA7\xE8\x85\xBF", BodyPart::upper_leg, Side::right},
    };
    for (const Said& said : table) {
        const BoneWords read = read_bone_words(words_of_name(said.name), {});
        EXPECT_EQ(read.part, said.part) << said.name;
        EXPECT_EQ(read.side, said.side) << said.name;
    }
}

}  // namespace
}  // namespace raks::motion
