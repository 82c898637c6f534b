// How tools and data sets name the joints of a body.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "motion/skeleton/humanoid.hpp"

namespace raks::motion::body_test {

/// Names of the bones of kSchemeBones; `@` stands for the side. An empty name: the scheme has none.
struct NamingScheme {
    std::string tool;
    std::array<std::string, 2> sides;  ///< by Side
    std::array<std::string, 14> names;
};

/// The bones of a scheme, left for those of a side.
inline constexpr std::array<Bone, 14> kSchemeBones = {Bone::hips,
                                                      Bone::spine,
                                                      Bone::chest,
                                                      Bone::upper_chest,
                                                      Bone::neck,
                                                      Bone::head,
                                                      Bone::left_shoulder,
                                                      Bone::left_upper_arm,
                                                      Bone::left_lower_arm,
                                                      Bone::left_hand,
                                                      Bone::left_upper_leg,
                                                      Bone::left_lower_leg,
                                                      Bone::left_foot,
                                                      Bone::left_toes};

inline std::map<Bone, std::string> names_of(const NamingScheme& scheme) {
    std::map<Bone, std::string> names;
    for (std::size_t i = 0; i < kSchemeBones.size(); ++i) {
        for (const Side side : kSides) {
            std::string name = scheme.names[i];
            if (const std::size_t at = name.find('@'); at != std::string::npos) {
                name.replace(at, 1, scheme.sides[static_cast<std::size_t>(side)]);
            }
            names[on_side(kSchemeBones[i], side)] = name;
        }
    }
    return names;
}

inline const std::vector<NamingScheme>& naming_schemes() {
    // clang-format off
    static const std::vector<NamingScheme> all = {
        {"VRM 1.0", {"left", "right"}, {"hips", "spine", "chest", "upperChest", "neck", "head", "@Shoulder", "@UpperArm", "@LowerArm", "@Hand", "@UpperLeg", "@LowerLeg", "@Foot", "@Toes"}},
        {"VRoid", {"L", "R"}, {"J_Bip_C_Hips", "J_Bip_C_Spine", "J_Bip_C_Chest", "J_Bip_C_UpperChest", "J_Bip_C_Neck", "J_Bip_C_Head", "J_Bip_@_Shoulder", "J_Bip_@_UpperArm", "J_Bip_@_LowerArm", "J_Bip_@_Hand", "J_Bip_@_UpperLeg", "J_Bip_@_LowerLeg", "J_Bip_@_Foot", "J_Bip_@_ToeBase"}},
        {"Mixamo", {"Left", "Right"}, {"mixamorig:Hips", "mixamorig:Spine", "mixamorig:Spine1", "mixamorig:Spine2", "mixamorig:Neck", "mixamorig:Head", "mixamorig:@Shoulder", "mixamorig:@Arm", "mixamorig:@ForeArm", "mixamorig:@Hand", "mixamorig:@UpLeg", "mixamorig:@Leg", "mixamorig:@Foot", "mixamorig:@ToeBase"}},
        {"MotionBuilder, Perception Neuron, LAFAN1", {"Left", "Right"}, {"Hips", "Spine", "Spine1", "Spine2", "Neck", "Head", "@Shoulder", "@Arm", "@ForeArm", "@Hand", "@UpLeg", "@Leg", "@Foot", "@Toe"}},
        {"Maya HumanIK", {"Left", "Right"}, {"Character1_Hips", "Character1_Spine", "Character1_Spine1", "Character1_Spine2", "Character1_Neck", "Character1_Head", "Character1_@Shoulder", "Character1_@Arm", "Character1_@ForeArm", "Character1_@Hand", "Character1_@UpLeg", "Character1_@Leg", "Character1_@Foot", "Character1_@ToeBase"}},
        {"Xsens MVN", {"Left", "Right"}, {"Pelvis", "L5", "L3", "T8", "Neck", "Head", "@Shoulder", "@UpperArm", "@ForeArm", "@Hand", "@UpperLeg", "@LowerLeg", "@Foot", "@Toe"}},
        {"Xsens, 100STYLE (Biovision)", {"Left", "Right"}, {"Hips", "Chest", "Chest2", "Chest4", "Neck", "Head", "@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip", "@Knee", "@Ankle", "@Toe"}},
        {"Rokoko Newton", {"Left", "Right"}, {"Hips", "Spine1", "Spine2", "Spine3", "Neck", "Head", "@Shoulder", "@Arm", "@ForeArm", "@Hand", "@Thigh", "@Shin", "@Foot", "@Toe"}},
        {"OptiTrack Motive", {"L", "R"}, {"Skeleton 001:Hip", "Skeleton 001:Ab", "Skeleton 001:Spine2", "Skeleton 001:Chest", "Skeleton 001:Neck", "Skeleton 001:Head", "Skeleton 001:@Shoulder", "Skeleton 001:@UArm", "Skeleton 001:@FArm", "Skeleton 001:@Hand", "Skeleton 001:@Thigh", "Skeleton 001:@Shin", "Skeleton 001:@Foot", "Skeleton 001:@Toe"}},
        {"Captury", {"Left", "Right"}, {"Hips", "Spine", "Spine2", "Spine4", "Neck", "Head", "@Shoulder", "@Arm", "@ForeArm", "@Hand", "@UpLeg", "@Leg", "@Foot", "@ToeBase"}},
        {"DeepMotion", {"l", "r"}, {"hips_JNT", "spine_JNT", "spine1_JNT", "spine2_JNT", "neck_JNT", "head_JNT", "@_shoulder_JNT", "@_arm_JNT", "@_forearm_JNT", "@_hand_JNT", "@_upleg_JNT", "@_leg_JNT", "@_foot_JNT", "@_toebase_JNT"}},
        {"Kinect", {"Left", "Right"}, {"SpineBase", "SpineMid", "SpineChest", "SpineShoulder", "Neck", "Head", "Clavicle@", "Shoulder@", "Elbow@", "Wrist@", "Hip@", "Knee@", "Ankle@", "Foot@"}},
        {"SMPL", {"left", "right"}, {"pelvis", "spine1", "spine2", "spine3", "neck", "head", "@_collar", "@_shoulder", "@_elbow", "@_wrist", "@_hip", "@_knee", "@_ankle", "@_foot"}},
        {"smpl2bvh", {"L", "R"}, {"Pelvis", "Spine1", "Spine2", "Spine3", "Neck", "Head", "@_Collar", "@_Shoulder", "@_Elbow", "@_Wrist", "@_Hip", "@_Knee", "@_Ankle", "@_Foot"}},
        {"SMPL in Maya", {"L", "R"}, {"f_avg_Pelvis", "f_avg_Spine1", "f_avg_Spine2", "f_avg_Spine3", "f_avg_Neck", "f_avg_Head", "f_avg_@_Collar", "f_avg_@_Shoulder", "f_avg_@_Elbow", "f_avg_@_Wrist", "f_avg_@_Hip", "f_avg_@_Knee", "f_avg_@_Ankle", "f_avg_@_Foot"}},
        {"CMU, HDM05 (ASF)", {"l", "r"}, {"root", "lowerback", "upperback", "thorax", "lowerneck", "head", "@clavicle", "@humerus", "@radius", "@wrist", "@femur", "@tibia", "@foot", "@toes"}},
        {"Bandai Namco", {"L", "R"}, {"Hips", "Spine", "Spine1", "Chest", "Neck", "Head", "Shoulder_@", "UpperArm_@", "LowerArm_@", "Hand_@", "UpperLeg_@", "LowerLeg_@", "Foot_@", "Toes_@"}},
        {"Human3.6M", {"L", "R"}, {"Hip", "Spine", "Spine1", "Thorax", "Neck", "Head", "@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip", "@Knee", "@Ankle", "@Toe"}},
        {"COCO, Body25", {"L", "R"}, {"MidHip", "Spine", "Spine1", "Spine2", "Neck", "Head", "@Collar", "@Shoulder", "@Elbow", "@Wrist", "@Hip", "@Knee", "@Ankle", "@BigToe"}},
        {"OpenSim", {"l", "r"}, {"pelvis", "lumbar", "torso", "thorax", "neck", "head", "clavicle_@", "humerus_@", "ulna_@", "hand_@", "femur_@", "tibia_@", "talus_@", "toes_@"}},
        {"Unreal", {"l", "r"}, {"pelvis", "spine_01", "spine_02", "spine_03", "neck_01", "head", "clavicle_@", "upperarm_@", "lowerarm_@", "hand_@", "thigh_@", "calf_@", "foot_@", "ball_@"}},
        {"Unity", {"Left", "Right"}, {"Hips", "Spine", "Chest", "UpperChest", "Neck", "Head", "@Shoulder", "@UpperArm", "@LowerArm", "@Hand", "@UpperLeg", "@LowerLeg", "@Foot", "@Toes"}},
        {"3ds Max Biped, CryEngine", {"L", "R"}, {"Bip01 Pelvis", "Bip01 Spine", "Bip01 Spine1", "Bip01 Spine2", "Bip01 Neck", "Bip01 Head", "Bip01 @ Clavicle", "Bip01 @ UpperArm", "Bip01 @ Forearm", "Bip01 @ Hand", "Bip01 @ Thigh", "Bip01 @ Calf", "Bip01 @ Foot", "Bip01 @ Toe0"}},
        {"Source", {"L", "R"}, {"ValveBiped.Bip01_Pelvis", "ValveBiped.Bip01_Spine", "ValveBiped.Bip01_Spine1", "ValveBiped.Bip01_Spine4", "ValveBiped.Bip01_Neck1", "ValveBiped.Bip01_Head1", "ValveBiped.Bip01_@_Clavicle", "ValveBiped.Bip01_@_UpperArm", "ValveBiped.Bip01_@_Forearm", "ValveBiped.Bip01_@_Hand", "ValveBiped.Bip01_@_Thigh", "ValveBiped.Bip01_@_Calf", "ValveBiped.Bip01_@_Foot", "ValveBiped.Bip01_@_Toe0"}},
        {"Team Fortress", {"L", "R"}, {"bip_pelvis", "bip_spine_0", "bip_spine_1", "bip_spine_2", "bip_neck", "bip_head", "bip_collar_@", "bip_upperArm_@", "bip_lowerArm_@", "bip_hand_@", "bip_hip_@", "bip_knee_@", "bip_foot_@", "bip_toe_@"}},
        {"Poser, DAZ", {"l", "r"}, {"hip", "abdomen", "abdomen2", "chest", "neck", "head", "@Collar", "@Shldr", "@ForeArm", "@Hand", "@Thigh", "@Shin", "@Foot", "@Toe"}},
        {"DAZ Genesis", {"l", "r"}, {"hip", "abdomenLower", "abdomenUpper", "chestUpper", "neckLower", "head", "@Collar", "@ShldrBend", "@ForearmBend", "@Hand", "@ThighBend", "@Shin", "@Foot", "@Toe"}},
        {"Rigify", {"L", "R"}, {"spine", "spine.001", "spine.002", "spine.003", "spine.004", "spine.006", "shoulder.@", "upper_arm.@", "forearm.@", "hand.@", "thigh.@", "shin.@", "foot.@", "toe.@"}},
        {"Rigify DEF", {"L", "R"}, {"DEF-hips", "DEF-spine.001", "DEF-spine.002", "DEF-spine.003", "DEF-neck", "DEF-head", "DEF-shoulder.@", "DEF-upper_arm.@", "DEF-forearm.@", "DEF-hand.@", "DEF-thigh.@", "DEF-shin.@", "DEF-foot.@", "DEF-toe.@"}},
        {"MakeHuman", {"L", "R"}, {"root", "spine05", "spine03", "spine01", "neck01", "head", "clavicle.@", "upperarm01.@", "lowerarm01.@", "wrist.@", "upperleg01.@", "lowerleg01.@", "foot.@", "toe1-1.@"}},
        {"iClone", {"L", "R"}, {"CC_Base_Hip", "CC_Base_Waist", "CC_Base_Spine01", "CC_Base_Spine02", "CC_Base_NeckTwist01", "CC_Base_Head", "CC_Base_@_Clavicle", "CC_Base_@_Upperarm", "CC_Base_@_Forearm", "CC_Base_@_Hand", "CC_Base_@_Thigh", "CC_Base_@_Calf", "CC_Base_@_Foot", "CC_Base_@_ToeBase"}},
        {"lower case, one word", {"left", "right"}, {"hips", "spine", "spine1", "spine2", "neck", "head", "@shoulder", "@arm", "@forearm", "@hand", "@upleg", "@leg", "@foot", "@toebase"}},
        {"side last", {"Left", "Right"}, {"Hips", "Spine", "Spine1", "Chest", "Neck", "Head", "Shoulder@", "UpperArm@", "LowerArm@", "Hand@", "UpperLeg@", "LowerLeg@", "Foot@", "Toes@"}},
        {"German", {"L", "R"}, {"Becken", "Wirbelsaeule1", "Wirbelsaeule2", "Brust", "Hals", "Kopf", "Schluesselbein_@", "Oberarm_@", "Unterarm_@", "Hand_@", "Oberschenkel_@", "Unterschenkel_@", "Fuss_@", "Zehen_@"}},
        {"German, sides in words", {"links", "rechts"}, {"H\xC3\xBC" "fte", "Bauch", "R\xC3\xBC" "cken", "Brust", "Nacken", "Kopf", "Schulter @", "Oberarm @", "Unterarm @", "Handgelenk @", "Oberschenkel @", "Knie @", "Kn\xC3\xB6" "chel @", "Zehe @"}},
        {"Spanish", {"izq", "der"}, {"caderas", "columna1", "columna2", "pecho", "cuello", "cabeza", "clav\xC3\xAD" "cula_@", "brazo_@", "antebrazo_@", "mano_@", "muslo_@", "pantorrilla_@", "pie_@", "dedo_pie_@"}},
        {"French", {"gauche", "droite"}, {"bassin", "dos", "colonne", "torse", "cou", "t\xC3\xAA" "te", "clavicule @", "bras @", "avant-bras @", "main @", "cuisse @", "jambe @", "pied @", "orteils @"}},
        {"MikuMikuDance", {"\xE5\xB7\xA6", "\xE5\x8F\xB3"}, {"\xE3\x82\xBB\xE3\x83\xB3\xE3\x82\xBF\xE3\x83\xBC", "\xE4\xB8\x8A\xE5\x8D\x8A\xE8\xBA\xAB", "\xE4\xB8\x8A\xE5\x8D\x8A\xE8\xBA\xAB" "2", "\xE4\xB8\x8A\xE5\x8D\x8A\xE8\xBA\xAB" "3", "\xE9\xA6\x96", "\xE9\xA0\xAD", "@\xE8\x82\xA9", "@\xE8\x85\x95", "@\xE3\x81\xB2\xE3\x81\x98", "@\xE6\x89\x8B\xE9\xA6\x96", "@\xE8\xB6\xB3", "@\xE3\x81\xB2\xE3\x81\x96", "@\xE8\xB6\xB3\xE9\xA6\x96", "@\xE3\x81\xA4\xE3\x81\xBE\xE5\x85\x88"}},
    };
    // clang-format on
    return all;
}

}  // namespace raks::motion::body_test
