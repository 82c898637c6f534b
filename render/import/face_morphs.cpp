#include "render/import/face_morphs.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/model/expression_names.hpp"

namespace raks::render {
namespace {

/// A morph target and how far it goes. Names as morph_word() gives them; one that begins with '*'
/// is the end of the name.
struct MorphPart {
    std::string_view name;
    float weight = 1.0F;
};

/// One way to show an expression.
struct FaceRecipe {
    FaceExpression expression;
    std::vector<MorphPart> parts;
};

/// Of one expression the first of which a figure has a part.
const std::vector<FaceRecipe>& face_recipes() {
    using E = FaceExpression;
    static const std::vector<FaceRecipe> all = {
        {E::happy,
         {{"mouthsmileleft", 0.85F},
          {"mouthsmileright", 0.85F},
          {"mouthsmile", 0.85F},
          {"cheeksquintleft", 0.6F},
          {"cheeksquintright", 0.6F},
          {"eyesquintleft", 0.35F},
          {"eyesquintright", 0.35F},
          {"mouthupperupleft", 0.3F},
          {"mouthupperupright", 0.3F},
          {"browouterupleft", 0.15F},
          {"browouterupright", 0.15F}}},
        {E::happy, {{"*fclalljoy"}}},
        {E::happy, {{"happy"}}},
        {E::happy, {{"joy"}}},
        {E::happy, {{"smile"}}},
        {E::happy, {{"facehappy"}}},
        {E::happy,
         {{"lsmileopenh", 0.8F},
          {"rsmileopenh", 0.8F},
          {"lsquinth", 0.35F},
          {"rsquinth", 0.35F},
          {"lbrowuph", 0.15F},
          {"rbrowuph", 0.15F}}},
        {E::angry,
         {{"browdownleft"},
          {"browdownright"},
          {"eyesquintleft", 0.5F},
          {"eyesquintright", 0.5F},
          {"nosesneerleft", 0.5F},
          {"nosesneerright", 0.5F},
          {"mouthpressleft", 0.4F},
          {"mouthpressright", 0.4F},
          {"mouthfrownleft", 0.2F},
          {"mouthfrownright", 0.2F}}},
        {E::angry, {{"*fclallangry"}}},
        {E::angry, {{"angry"}}},
        {E::angry, {{"faceangry"}}},
        {E::angry,
         {{"lbrowdownh"},
          {"rbrowdownh"},
          {"llbrowdownh", 0.6F},
          {"rrbrowdownh", 0.6F},
          {"lsquinth", 0.5F},
          {"rsquinth", 0.5F},
          {"ldisgusth", 0.3F},
          {"rdisgusth", 0.3F}}},
        {E::sad,
         {{"browinnerup", 0.9F},
          {"mouthfrownleft", 0.5F},
          {"mouthfrownright", 0.5F},
          {"eyeblinkleft", 0.15F},
          {"eyeblinkright", 0.15F},
          {"mouthshrugupper", 0.2F}}},
        {E::sad, {{"*fclallsorrow"}}},
        {E::sad, {{"sad"}}},
        {E::sad, {{"sorrow"}}},
        {E::sad, {{"facesad"}}},
        {E::sad,
         {{"lpityfulh", 0.9F}, {"rpityfulh", 0.9F}, {"lmouthsadh", 0.5F}, {"rmouthsadh", 0.5F}}},
        {E::relaxed,
         {{"mouthsmileleft", 0.4F},
          {"mouthsmileright", 0.4F},
          {"mouthsmile", 0.4F},
          {"eyeblinkleft", 0.28F},
          {"eyeblinkright", 0.28F},
          {"cheeksquintleft", 0.2F},
          {"cheeksquintright", 0.2F}}},
        {E::relaxed, {{"*fclallfun"}}},
        {E::relaxed, {{"relaxed"}}},
        {E::relaxed, {{"fun"}}},
        {E::relaxed, {{"facerelax"}}},
        {E::relaxed,
         {{"lsmilecloseh", 0.5F},
          {"rsmilecloseh", 0.5F},
          {"leyecloseh", 0.25F},
          {"reyecloseh", 0.25F}}},
        {E::surprised,
         {{"browinnerup", 0.8F},
          {"browouterupleft", 0.9F},
          {"browouterupright", 0.9F},
          {"eyewideleft", 0.9F},
          {"eyewideright", 0.9F},
          {"jawopen", 0.25F},
          {"mouthfunnel", 0.2F}}},
        {E::surprised, {{"*fclallsurprised"}}},
        {E::surprised, {{"surprised"}}},
        {E::surprised, {{"surprise"}}},
        {E::surprised, {{"facesurprise"}}},
        {E::surprised,
         {{"lbrowuph"},
          {"rbrowuph"},
          {"llbrowuph"},
          {"rrbrowuph"},
          {"leyeopenh", 0.8F},
          {"reyeopenh", 0.8F},
          {"mouthopenh", 0.3F},
          {"tmouthopenh", 0.3F}}},
        {E::aa, {{"visemeaa"}}},
        {E::aa, {{"vaa"}}},
        {E::aa, {{"*fclmtha"}}},
        {E::aa, {{"lipa"}}},
        {E::aa, {{"aeaah"}, {"taeaah"}}},
        {E::aa, {{"jawopen", 0.7F}, {"mouthopen", 0.7F}}},
        {E::aa, {{"aa"}}},
        {E::ih, {{"visemei"}}},
        {E::ih, {{"vih"}}},
        {E::ih, {{"*fclmthi"}}},
        {E::ih, {{"lipi"}}},
        {E::ih, {{"tdih"}, {"ttdih"}}},
        {E::ih, {{"jawopen", 0.18F}, {"mouthstretchleft", 0.35F}, {"mouthstretchright", 0.35F}}},
        {E::ou, {{"visemeu"}}},
        {E::ou, {{"vou"}}},
        {E::ou, {{"*fclmthu"}}},
        {E::ou, {{"lipu"}}},
        {E::ou, {{"uwuh"}, {"tuwuh"}}},
        {E::ou, {{"mouthpucker", 0.85F}, {"jawopen", 0.1F}}},
        {E::ee, {{"visemee"}}},
        {E::ee, {{"ve"}}},
        {E::ee, {{"*fclmthe"}}},
        {E::ee, {{"lipe"}}},
        {E::ee, {{"axeh"}, {"taxeh"}}},
        {E::ee,
         {{"jawopen", 0.15F},
          {"mouthstretchleft", 0.4F},
          {"mouthstretchright", 0.4F},
          {"mouthupperupleft", 0.5F},
          {"mouthupperupright", 0.5F},
          {"mouthlowerdownleft", 0.5F},
          {"mouthlowerdownright", 0.5F}}},
        {E::oh, {{"visemeo"}}},
        {E::oh, {{"voh"}}},
        {E::oh, {{"*fclmtho"}}},
        {E::oh, {{"lipo"}}},
        {E::oh, {{"aoah"}, {"taoah"}}},
        {E::oh, {{"mouthfunnel", 0.7F}, {"jawopen", 0.35F}}},
        {E::blink, {{"eyeblinkleft"}, {"eyeblinkright"}}},
        {E::blink, {{"*fcleyeclose"}}},
        {E::blink, {{"eyesclosed"}}},
        {E::blink, {{"blink"}}},
        {E::blink, {{"blinkleft"}, {"blinkright"}}},
        {E::blink, {{"leyecloseh"}, {"reyecloseh"}}},
        {E::blink_left, {{"eyeblinkleft"}}},
        {E::blink_left, {{"*fcleyecloseleft"}}},
        {E::blink_left, {{"blinkleft"}}},
        {E::blink_left, {{"leyecloseh"}}},
        {E::blink_right, {{"eyeblinkright"}}},
        {E::blink_right, {{"*fcleyecloseright"}}},
        {E::blink_right, {{"blinkright"}}},
        {E::blink_right, {{"reyecloseh"}}},
        {E::look_up, {{"eyelookupleft"}, {"eyelookupright"}}},
        {E::look_up, {{"lookup"}}},
        {E::look_down, {{"eyelookdownleft"}, {"eyelookdownright"}}},
        {E::look_down, {{"lookdown"}}},
        {E::look_left, {{"eyelookoutleft"}, {"eyelookinright"}}},
        {E::look_left, {{"lookleft"}}},
        {E::look_right, {{"eyelookinleft"}, {"eyelookoutright"}}},
        {E::look_right, {{"lookright"}}},
        {E::brow_up_left, {{"browouterupleft"}, {"browinnerup", 0.2F}, {"browdownright", 0.2F}}},
        {E::brow_up_left, {{"eyebrowupleft"}}},
        {E::brow_up_left, {{"lbrowuph"}, {"llbrowuph"}}},
        {E::brow_up_right, {{"browouterupright"}, {"browinnerup", 0.2F}, {"browdownleft", 0.2F}}},
        {E::brow_up_right, {{"eyebrowupright"}}},
        {E::brow_up_right, {{"rbrowuph"}, {"rrbrowuph"}}},
    };
    return all;
}

/// What counts of a name. "mouthSmile_L" and "mouthSmileLeft" give the same.
std::string morph_word(std::string_view name) {
    constexpr std::size_t kLongest = 200;
    name = name.substr(0, kLongest);
    const std::size_t dot = name.rfind('.');
    name = dot == std::string_view::npos ? name : name.substr(dot + 1);
    // A side as one letter stands behind a small letter or a sign.
    const bool has_side = name.size() > 2 && (name.back() == 'L' || name.back() == 'R') &&
                          !(name[name.size() - 2] >= 'A' && name[name.size() - 2] <= 'Z');
    std::string plain;
    for (const char c : name) {
        if (c != '_' && c != ' ' && c != '-') {
            plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
        }
    }
    if (has_side) {
        const bool is_left = plain.back() == 'l';
        plain.pop_back();
        plain += is_left ? "left" : "right";
    }
    return plain;
}

/// A morph target of the figure: which of a mesh, shown by a node.
struct NamedTarget {
    int node = 0;
    int target = 0;
};

/// The targets of a figure by their plain names.
class TargetsByName {
 public:
    explicit TargetsByName(const Model& model) {
        for (std::size_t node = 0; node < model.nodes.size(); ++node) {
            const int mesh = model.nodes[node].mesh;
            if (mesh < 0) {
                continue;
            }
            const std::vector<std::string>& names =
                model.meshes[static_cast<std::size_t>(mesh)].morph_names;
            for (std::size_t i = 0; i < names.size(); ++i) {
                if (!names[i].empty()) {
                    targets_[morph_word(names[i])].push_back(
                        {static_cast<int>(node), static_cast<int>(i)});
                }
            }
        }
    }

    [[nodiscard]] bool is_empty() const noexcept { return targets_.empty(); }

    /// Those of a part; empty: the figure has none.
    [[nodiscard]] std::vector<NamedTarget> of(std::string_view part) const {
        if (part.front() != '*') {
            const auto found = targets_.find(part);
            return found != targets_.end() ? found->second : std::vector<NamedTarget>();
        }
        std::vector<NamedTarget> all;
        for (const auto& [name, targets] : targets_) {
            if (std::string_view(name).ends_with(part.substr(1))) {
                all.insert(all.end(), targets.begin(), targets.end());
            }
        }
        return all;
    }

 private:
    std::map<std::string, std::vector<NamedTarget>, std::less<>> targets_;
};

/// The expression by this recipe, where the figure has a part of it.
std::optional<Expression> expression_by(const FaceRecipe& recipe, const TargetsByName& targets) {
    Expression expression;
    const auto number = static_cast<std::size_t>(recipe.expression);
    expression.name = kFaceExpressionNames[number];
    expression.is_preset = number < kPresetExpressionCount;
    for (const MorphPart& part : recipe.parts) {
        for (const NamedTarget& target : targets.of(part.name)) {
            expression.morphs.push_back(
                {.node = target.node, .target = target.target, .weight = part.weight});
        }
    }
    return expression.morphs.empty() ? std::nullopt : std::optional(std::move(expression));
}

/// Eyes that no bone turns look by their targets.
void look_by_targets(Model& model) {
    constexpr float kFarthest = 30.0F;  // degrees, at which a target is whole
    Character& figure = model.character;
    const auto has = [&](std::string_view name) {
        return std::any_of(figure.expressions.begin(),
                           figure.expressions.end(),
                           [&](const Expression& one) { return one.name == name; });
    };
    if (figure.has_look_at || figure.humanoid.left_eye >= 0 || !has("lookLeft")) {
        return;
    }
    figure.has_look_at = true;
    figure.look_at.is_by_bones = false;
    for (LookAtRange* const range : {&figure.look_at.horizontal_inner,
                                     &figure.look_at.horizontal_outer,
                                     &figure.look_at.vertical_down,
                                     &figure.look_at.vertical_up}) {
        *range = {kFarthest, 1.0F};
    }
}

}  // namespace

void add_face_morphs(Model& model) {
    std::vector<Expression>& expressions = model.character.expressions;
    if (!expressions.empty()) {
        return;
    }
    const TargetsByName targets(model);
    if (targets.is_empty()) {
        return;
    }
    for (const FaceRecipe& recipe : face_recipes()) {
        const bool is_shown = !expressions.empty() &&
                              expressions.back().name ==
                                  kFaceExpressionNames[static_cast<std::size_t>(recipe.expression)];
        if (is_shown) {
            continue;
        }
        if (auto expression = expression_by(recipe, targets)) {
            expressions.push_back(std::move(*expression));
        }
    }
    look_by_targets(model);
}

}  // namespace raks::render
