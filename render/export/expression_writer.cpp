#include <array>

#include "render/export/vrm_extensions.hpp"

namespace raks::render {
namespace {

Json override_of(ExpressionOverride override) {
    constexpr std::array kNames = {"none", "block", "blend"};
    return kNames[static_cast<std::size_t>(override)];
}

const char* kind_of(ColourBindKind kind) {
    constexpr std::array kNames = {
        "color", "emissionColor", "shadeColor", "matcapColor", "rimColor", "outlineColor"};
    return kNames[static_cast<std::size_t>(kind)];
}

Json expression_of(const Expression& expression) {
    Json json = {{"isBinary", expression.is_binary},
                 {"overrideBlink", override_of(expression.override_blink)},
                 {"overrideLookAt", override_of(expression.override_look_at)},
                 {"overrideMouth", override_of(expression.override_mouth)}};
    for (const MorphBind& bind : expression.morphs) {
        json["morphTargetBinds"].push_back(
            {{"node", bind.node}, {"index", bind.target}, {"weight", bind.weight}});
    }
    for (const ColourBind& bind : expression.colours) {
        json["materialColorBinds"].push_back({{"material", bind.material},
                                              {"type", kind_of(bind.kind)},
                                              {"targetValue", numbers_of(bind.target)}});
    }
    for (const TextureBind& bind : expression.textures) {
        json["textureTransformBinds"].push_back({{"material", bind.material},
                                                 {"scale", numbers_of(bind.scale)},
                                                 {"offset", numbers_of(bind.offset)}});
    }
    return json;
}

}  // namespace

Json expressions_of(const Model& model) {
    Json json = Json::object();
    for (const Expression& expression : model.character.expressions) {
        json[expression.is_preset ? "preset" : "custom"][expression.name] =
            expression_of(expression);
    }
    return json;
}

}  // namespace raks::render
