#include "motion/skeleton/body/bone_vocabulary.hpp"

#include <algorithm>
#include <array>
#include <unordered_map>

namespace raks::motion {
namespace {

struct Replacement {
    std::string_view from;
    std::string_view to;
};

// Longer ones first where one holds another.
constexpr std::array kForeignWords = std::to_array<Replacement>({
    {"キャンセル", " cancel "},
    {"センター", " hips "},
    {"骨盤", " hips "},
    {"腰", " hips "},
    {"下半身", " lowerbody "},
    {"上半身", " spine "},
    {"背骨", " spine "},
    {"脊椎", " spine "},
    {"胸", " chest "},
    {"手首", " hand "},
    {"足首", " foot "},
    {"つま先", " toes "},
    {"親指", " thumb "},
    {"人差指", " index "},
    {"人指", " index "},
    {"中指", " middle "},
    {"薬指", " ring "},
    {"小指", " little "},
    {"左", " left "},
    {"右", " right "},
    {"首", " neck "},
    {"頭", " head "},
    {"鎖骨", " clavicle "},
    {"肩", " shoulder "},
    {"上腕", " upperarm "},
    {"前腕", " forearm "},
    {"腕", " arm "},
    {"ひじ", " elbow "},
    {"肘", " elbow "},
    {"手", " hand "},
    {"太もも", " thigh "},
    {"大腿", " thigh "},
    {"下腿", " shin "},
    {"ひざ", " knee "},
    {"膝", " knee "},
    {"足", " leg "},
    {"脚", " leg "},
    {"目", " eye "},
    {"捩", " twist "},
    {"先", " end "},
    {"ＩＫ", " ik "},
    {"０", "0"},
    {"１", "1"},
    {"２", "2"},
    {"３", "3"},
    {"４", "4"},
    {"５", "5"},
    {"６", "6"},
    {"７", "7"},
    {"８", "8"},
    {"９", "9"},
    {"é", "e"},
    {"è", "e"},
    {"ê", "e"},
    {"É", "E"},
    {"ç", "c"},
    {"á", "a"},
    {"í", "i"},
    {"ó", "o"},
    {"ú", "u"},
    {"ñ", "n"},
    {"ä", "ae"},
    {"ö", "oe"},
    {"ü", "ue"},
    {"Ä", "Ae"},
    {"Ö", "Oe"},
    {"Ü", "Ue"},
    {"ß", "ss"},
});

// What is said in words that are joined: "upper", "arm". English from suits (Xsens MVN, Rokoko,
// Perception Neuron, OptiTrack, Vicon, Captury, DeepMotion, Kinect), research sets (SMPL, CMU's
// ASF, HDM05, Human3.6M, COCO, OpenSim), engines and programs (VRM, Unity, Unreal, Source, Mixamo,
// HumanIK, Biped, Rigify, Reallusion, MakeHuman, MikuMikuDance, VRChat, KayKit, Quaternius, Kenney,
// Khronos, Collada's astro boy, Daz); then German, Spanish and French.
constexpr std::array kPartNames = std::to_array<PartName>({
    {"root", BodyPart::root},
    {"hips", BodyPart::hips},
    {"hip", BodyPart::hips},
    {"pelvis", BodyPart::hips},
    {"midhip", BodyPart::hips},
    {"bassin", BodyPart::hips},
    {"becken", BodyPart::hips},
    {"huefte", BodyPart::hips},
    {"caderas", BodyPart::hips},
    {"cadera", BodyPart::hips},
    {"spinebase", BodyPart::hips},
    {"sacrum", BodyPart::hips},
    {"spine", BodyPart::spine},
    {"waist", BodyPart::spine},
    {"abdomen", BodyPart::spine},
    {"abdomenlower", BodyPart::spine},
    {"abdomenupper", BodyPart::spine},
    {"ab", BodyPart::spine},
    {"lowerback", BodyPart::spine},
    {"upperback", BodyPart::spine},
    {"back", BodyPart::spine},
    {"tummy", BodyPart::spine},
    {"torso", BodyPart::spine},
    {"torse", BodyPart::spine},
    {"spinemid", BodyPart::spine},
    {"spinenaval", BodyPart::spine},
    {"spinenavel", BodyPart::spine},
    {"lumbar", BodyPart::spine},
    {"wirbelsaeule", BodyPart::spine},
    {"ruecken", BodyPart::spine},
    {"bauch", BodyPart::spine},
    {"taille", BodyPart::spine},
    {"columna", BodyPart::spine},
    {"espina", BodyPart::spine},
    {"espalda", BodyPart::spine},
    {"abdomenalto", BodyPart::spine},
    {"colonne", BodyPart::spine},
    {"colonnevertebrale", BodyPart::spine},
    {"dos", BodyPart::spine},
    {"chest", BodyPart::chest},
    {"chestlower", BodyPart::chest},
    {"thorax", BodyPart::chest},
    {"brust", BodyPart::chest},
    {"brustkorb", BodyPart::chest},
    {"pecho", BodyPart::chest},
    {"torax", BodyPart::chest},
    {"poitrine", BodyPart::chest},
    {"spinechest", BodyPart::chest},
    {"ribcage", BodyPart::chest},
    {"sternum", BodyPart::chest},
    {"upperchest", BodyPart::upper_chest},
    {"chestupper", BodyPart::upper_chest},
    {"spineshoulder", BodyPart::upper_chest},
    {"neck", BodyPart::neck},
    {"necklower", BodyPart::neck},
    {"lowerneck", BodyPart::neck},
    {"cou", BodyPart::neck},
    {"hals", BodyPart::neck},
    {"nacken", BodyPart::neck},
    {"cuello", BodyPart::neck},
    {"neckupper", BodyPart::neck, 5},
    {"upperneck", BodyPart::neck, 5},
    {"head", BodyPart::head},
    {"tete", BodyPart::head},
    {"kopf", BodyPart::head},
    {"cabeza", BodyPart::head},
    {"skull", BodyPart::head},
    {"eye", BodyPart::eye},
    {"jaw", BodyPart::jaw},
    {"shoulder", BodyPart::shoulder},
    {"clavicle", BodyPart::collar_bone},
    {"collar", BodyPart::collar_bone},
    {"collarbone", BodyPart::collar_bone},
    {"scapula", BodyPart::collar_bone},
    {"epaule", BodyPart::shoulder},
    {"clavicule", BodyPart::collar_bone},
    {"schulter", BodyPart::shoulder},
    {"schluesselbein", BodyPart::collar_bone},
    {"hombro", BodyPart::shoulder},
    {"clavicula", BodyPart::collar_bone},
    {"arm", BodyPart::arm},
    {"bras", BodyPart::arm},
    {"brazo", BodyPart::arm},
    {"upperarm", BodyPart::upper_arm},
    {"uparm", BodyPart::upper_arm},
    {"uarm", BodyPart::upper_arm},
    {"humerus", BodyPart::upper_arm},
    {"shldr", BodyPart::upper_arm},
    {"oberarm", BodyPart::upper_arm},
    {"brazosuperior", BodyPart::upper_arm},
    {"brassuperieur", BodyPart::upper_arm},
    {"lowerarm", BodyPart::lower_arm},
    {"forearm", BodyPart::lower_arm},
    {"farm", BodyPart::lower_arm},
    {"lowarm", BodyPart::lower_arm},
    {"elbow", BodyPart::lower_arm},
    {"ulna", BodyPart::lower_arm},
    {"radius", BodyPart::lower_arm},
    {"avantbras", BodyPart::lower_arm},
    {"coude", BodyPart::lower_arm},
    {"unterarm", BodyPart::lower_arm},
    {"ellbogen", BodyPart::lower_arm},
    {"ellenbogen", BodyPart::lower_arm},
    {"antebrazo", BodyPart::lower_arm},
    {"codo", BodyPart::lower_arm},
    {"hand", BodyPart::hand},
    {"wrist", BodyPart::hand},
    {"main", BodyPart::hand},
    {"poignet", BodyPart::hand},
    {"handgelenk", BodyPart::hand},
    {"mano", BodyPart::hand},
    {"muneca", BodyPart::hand},
    {"palm", BodyPart::hand, 5},
    {"leg", BodyPart::leg},
    {"jambe", BodyPart::leg},
    {"pierna", BodyPart::leg},
    {"bein", BodyPart::leg},
    {"upperleg", BodyPart::upper_leg},
    {"upleg", BodyPart::upper_leg},
    {"thigh", BodyPart::upper_leg},
    {"femur", BodyPart::upper_leg},
    {"cuisse", BodyPart::upper_leg},
    {"hanche", BodyPart::upper_leg},
    {"oberschenkel", BodyPart::upper_leg},
    {"muslo", BodyPart::upper_leg},
    {"lowerleg", BodyPart::lower_leg},
    {"lowleg", BodyPart::lower_leg},
    {"downleg", BodyPart::lower_leg},
    {"shin", BodyPart::lower_leg},
    {"calf", BodyPart::lower_leg},
    {"knee", BodyPart::lower_leg},
    {"tibia", BodyPart::lower_leg},
    {"shank", BodyPart::lower_leg},
    {"genou", BodyPart::lower_leg},
    {"mollet", BodyPart::lower_leg},
    {"unterschenkel", BodyPart::lower_leg},
    {"knie", BodyPart::lower_leg},
    {"wade", BodyPart::lower_leg},
    {"rodilla", BodyPart::lower_leg},
    {"pantorrilla", BodyPart::lower_leg},
    {"espinilla", BodyPart::lower_leg},
    {"foot", BodyPart::foot},
    {"ankle", BodyPart::foot},
    {"pied", BodyPart::foot},
    {"cheville", BodyPart::foot},
    {"fuss", BodyPart::foot},
    {"knoechel", BodyPart::foot},
    {"fussgelenk", BodyPart::foot},
    {"sprunggelenk", BodyPart::foot},
    {"pie", BodyPart::foot},
    {"tobillo", BodyPart::foot},
    {"talus", BodyPart::foot},
    {"calcn", BodyPart::foot, 12},
    {"heel", BodyPart::foot, 12},
    {"toe", BodyPart::toes},
    {"toes", BodyPart::toes},
    {"toebase", BodyPart::toes},
    {"ball", BodyPart::toes},
    {"zehe", BodyPart::toes},
    {"zehen", BodyPart::toes},
    {"orteil", BodyPart::toes},
    {"orteils", BodyPart::toes},
    {"dedopie", BodyPart::toes},
    {"dedosdelpie", BodyPart::toes},
    {"footindex", BodyPart::toes, 5},
    {"bigtoe", BodyPart::toes, 5},
    {"thumb", BodyPart::thumb},
    {"daumen", BodyPart::thumb},
    {"pulgar", BodyPart::thumb},
    {"pouce", BodyPart::thumb},
    {"index", BodyPart::index},
    {"zeigefinger", BodyPart::index},
    {"indice", BodyPart::index},
    {"middle", BodyPart::middle},
    {"mid", BodyPart::middle},
    {"mittelfinger", BodyPart::middle},
    {"majeur", BodyPart::middle},
    {"ring", BodyPart::ring},
    {"ringfinger", BodyPart::ring},
    {"anulaire", BodyPart::ring},
    {"annulaire", BodyPart::ring},
    {"anular", BodyPart::ring},
    {"little", BodyPart::little},
    {"pinky", BodyPart::little},
    {"pinkie", BodyPart::little},
    {"kleinerfinger", BodyPart::little},
    {"menique", BodyPart::little},
    {"auriculaire", BodyPart::little},
    {"finger", BodyPart::finger},
    {"fingers", BodyPart::finger},
});

// Words that say nothing of the part.
constexpr std::array kNoise = std::to_array<std::string_view>(
    {"def",      "bip",   "base",  "cc",   "character", "skeleton",  "joint", "jnt",
     "bone",     "rig",   "null",  "j",    "c",         "b",         "bind",  "center",
     "armature", "biped", "valve", "bend", "humanoid",  "mixamorig", "avg",   "skel"});

// Longer ones first where one begins another.
constexpr std::array kLeft = std::to_array<std::string_view>({"left",
                                                              "lft",
                                                              "lt",
                                                              "l",
                                                              "gauche",
                                                              "links",
                                                              "linker",
                                                              "linkes",
                                                              "linke",
                                                              "izquierda",
                                                              "izquierdo",
                                                              "izq"});
constexpr std::array kRight = std::to_array<std::string_view>({"right",
                                                               "rgt",
                                                               "rt",
                                                               "r",
                                                               "droite",
                                                               "droit",
                                                               "rechts",
                                                               "rechter",
                                                               "rechtes",
                                                               "rechte",
                                                               "derecha",
                                                               "derecho",
                                                               "der"});

template <typename Words>
bool is_among(const Words& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

}  // namespace

const PartName* part_named(std::string_view name) {
    static const std::unordered_map<std::string_view, const PartName*> names = [] {
        std::unordered_map<std::string_view, const PartName*> all;
        for (const PartName& part : kPartNames) {
            all.emplace(part.name, &part);
        }
        return all;
    }();
    const auto found = names.find(name);
    return found != names.end() ? found->second : nullptr;
}

bool is_empty_word(std::string_view word) { return is_among(kNoise, word); }

std::span<const std::string_view> words_of_side(Side side) {
    return side == Side::left ? std::span<const std::string_view>(kLeft)
                              : std::span<const std::string_view>(kRight);
}

std::optional<Side> side_of_word(std::string_view word) {
    for (const Side side : kSides) {
        if (is_among(words_of_side(side), word)) {
            return side;
        }
    }
    return std::nullopt;
}

std::string in_english(std::string_view name) {
    std::string text(name);
    for (const Replacement& word : kForeignWords) {
        for (std::size_t at = text.find(word.from); at != std::string::npos;
             at = text.find(word.from, at + word.to.size())) {
            text.replace(at, word.from.size(), word.to);
        }
    }
    return text;
}

}  // namespace raks::motion
