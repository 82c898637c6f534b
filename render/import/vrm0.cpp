// VRM 0.x, brought onto VRM 1.0's terms as UniVRM's migration does.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "render/import/lenient.hpp"
#include "render/import/srgb.hpp"
#include "render/import/vrm_parts.hpp"

namespace raks::render {
namespace {

// ---- Expressions

struct PresetName {
    std::string_view vrm0;
    std::string_view vrm1;
};
constexpr std::array<PresetName, 17> kBlendShapePresets = {{
    {"neutral", "neutral"},
    {"a", "aa"},
    {"i", "ih"},
    {"u", "ou"},
    {"e", "ee"},
    {"o", "oh"},
    {"blink", "blink"},
    {"blink_l", "blinkLeft"},
    {"blink_r", "blinkRight"},
    {"joy", "happy"},
    {"angry", "angry"},
    {"sorrow", "sad"},
    {"fun", "relaxed"},
    {"lookup", "lookUp"},
    {"lookdown", "lookDown"},
    {"lookleft", "lookLeft"},
    {"lookright", "lookRight"},
}};

/// The first letters of a name in lower case.
std::string lower_case(std::string_view name) {
    std::string lower(name.substr(0, 20));
    std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return lower;
}

/// The VRM 1.0 name of a preset; empty: it is the maker's own.
std::string_view preset_in_vrm1(std::string_view preset) {
    const std::string lower = lower_case(preset);
    for (const PresetName& name : kBlendShapePresets) {
        if (name.vrm0 == lower) {
            return name.vrm1;
        }
    }
    return {};
}

/// The same of a group. VRM 0.x has no preset for surprise: makers call their own so.
std::string_view preset_of(const JsonField& group) {
    const std::string_view preset = preset_in_vrm1(group["presetName"].text_or({}));
    return preset.empty() && lower_case(group["name"].text_or({})) == "surprised" ? "surprised"
                                                                                  : preset;
}

/// Where to find what binds name: looked up once, as a file may hold many binds.
struct BindTargets {
    explicit BindTargets(const Model& model) : nodes_of_mesh(model.meshes.size()) {
        for (std::size_t node = 0; node < model.nodes.size(); ++node) {
            if (const int mesh = model.nodes[node].mesh; mesh >= 0) {
                nodes_of_mesh[static_cast<std::size_t>(mesh)].push_back(static_cast<int>(node));
            }
        }
        for (std::size_t i = 0; i < model.materials.size(); ++i) {
            materials.emplace(model.materials[i].name, static_cast<int>(i));
        }
    }

    std::vector<std::vector<int>> nodes_of_mesh;
    std::unordered_map<std::string_view, int> materials;  // by name; of two, the first
};

/// A bind names a mesh: it moves that target on every node that shows the mesh.
void read_mesh_bind(const JsonField& bind,
                    const BindTargets& targets,
                    Expression& expression,
                    Model& model) {
    const int mesh = bind["mesh"].index(targets.nodes_of_mesh.size());
    const int target = static_cast<int>(bind["index"].whole(0, 1'000'000));
    const float weight = lenient_number(bind["weight"], {0.0F, 100.0F, 100.0F}, model);
    if (targets.nodes_of_mesh.empty()) {
        return;  // no mesh: a fault already
    }
    const std::vector<int>& nodes = targets.nodes_of_mesh[static_cast<std::size_t>(mesh)];
    if (nodes.empty()) {
        bind["mesh"].complain("is not shown by any node");
    } else if (static_cast<std::size_t>(target) >= morphs_of_node(model, nodes.front())) {
        bind["index"].complain(fmt::format("{} is not a target of its mesh", target));
    } else if (expression.morphs.size() + nodes.size() > kMostBinds) {
        bind.complain("moves too many nodes");
    } else {
        for (const int node : nodes) {
            expression.morphs.push_back({node, target, weight / 100.0F});
        }
    }
}

/// Values of "_MainTex_ST": scale x, y, offset x, y from the lower left corner; "_S" and "_T" are
/// of one direction alone.
TextureBind texture_bind(std::string_view property, const std::array<float, 4>& values) {
    const bool has_u = !property.ends_with("_ST_T");
    const bool has_v = !property.ends_with("_ST_S");
    TextureBind bind;
    bind.scale = {has_u ? values[0] : 1.0F, has_v ? values[1] : 1.0F};
    const float lower = has_v ? values[3] : 0.0F;
    bind.offset = {has_u ? values[2] : 0.0F, 1.0F - lower - bind.scale.y};
    return bind;
}

/// A colour bind of a property; sRGB is made linear, but for emission, which is linear already.
bool colour_bind(std::string_view property, const std::array<float, 4>& values, ColourBind& bind) {
    constexpr std::array<std::pair<std::string_view, ColourBindKind>, 5> kKinds = {{
        {"_Color", ColourBindKind::base},
        {"_EmissionColor", ColourBindKind::emission},
        {"_ShadeColor", ColourBindKind::shade},
        {"_RimColor", ColourBindKind::rim},
        {"_OutlineColor", ColourBindKind::outline},
    }};
    for (const auto& [name, kind] : kKinds) {
        if (name == property) {
            bind.kind = kind;
            const glm::vec4 value(values[0], values[1], values[2], values[3]);
            bind.target = kind == ColourBindKind::emission ? value : linear_from_srgb(value);
            return true;
        }
    }
    return false;
}

void read_material_value(const JsonField& from,
                         const BindTargets& targets,
                         Expression& expression) {
    const auto found = targets.materials.find(from["materialName"].text());
    if (found == targets.materials.end()) {
        from["materialName"].complain("is not a material of the file");
        return;
    }
    const int material = found->second;
    const std::string_view property = from["propertyName"].text();
    std::array<float, 4> values{};
    values = from["targetValue"].numbers_or(values);
    for (float& value : values) {
        value = std::clamp(value, -10'000.0F, 10'000.0F);
    }
    ColourBind colour;
    if (property.find("_ST") != std::string_view::npos) {
        expression.textures.push_back(texture_bind(property, values));
        expression.textures.back().material = material;
    } else if (colour_bind(property, values, colour)) {
        colour.material = material;
        expression.colours.push_back(colour);
    } else {
        from["propertyName"].complain("is not a property that can be changed");
    }
}

/// Reads each of a list on its own by `read(field, part)`, and hands the good parts to `take`; a
/// bad one is left out with a warning.
template <typename Part, typename Read, typename Take>
void read_each(
    const JsonField& list, std::size_t most, Model& model, const Read& read, const Take& take) {
    const bool is_list = read_part(list, model, [&](const JsonField& own) {
        for (const JsonField& item : own.items(most)) {
            Part part;
            if (read_part(item, model, [&](const JsonField& one) { read(one, part); })) {
                take(std::move(part));
            }
        }
    });
    static_cast<void>(is_list);  // said in a warning
}

void add_binds(const Expression& part, Expression& expression) {
    if (expression.morphs.size() + part.morphs.size() <= kMostBinds) {
        expression.morphs.insert(expression.morphs.end(), part.morphs.begin(), part.morphs.end());
    }
    expression.colours.insert(expression.colours.end(), part.colours.begin(), part.colours.end());
    expression.textures.insert(
        expression.textures.end(), part.textures.begin(), part.textures.end());
}

void read_group(const JsonField& group,
                const BindTargets& targets,
                Expression& expression,
                Model& model) {
    const std::string_view preset = preset_of(group);
    expression.is_preset = !preset.empty();
    expression.name = printable(preset.empty() ? group["name"].text() : preset, 100);
    expression.is_binary = lenient_truth(group["isBinary"], false, model);
    const auto take = [&](const Expression& part) { add_binds(part, expression); };
    read_each<Expression>(
        group["binds"],
        kMostBinds,
        model,
        [&](const JsonField& bind, Expression& part) {
            read_mesh_bind(bind, targets, part, model);
        },
        take);
    read_each<Expression>(
        group["materialValues"],
        kMostBinds,
        model,
        [&](const JsonField& value, Expression& part) {
            read_material_value(value, targets, part);
        },
        take);
}

/// Adds an expression, unless one of its name is there.
void add_expression(Expression expression, Model& model) {
    std::vector<Expression>& all = model.character.expressions;
    const auto same = [&](const Expression& one) { return one.name == expression.name; };
    if (std::any_of(all.begin(), all.end(), same)) {
        warn(model,
             fmt::format("blendShapeGroups: the expression {} is there already; left out",
                         expression.name));
        return;
    }
    all.push_back(std::move(expression));
}

// ---- Gaze

/// A curve between the ends is taken as a straight line, as VRM 1.0 has it.
LookAtRange read_degrees(const JsonField& map, float scale, Model& model) {
    constexpr std::array<float, 8> kStraight = {0, 0, 0, 1, 1, 1, 1, 0};
    JsonFaults ignored;
    const std::vector<float> curve = map["curve"].noting_to(ignored).numbers(1000);
    if (!curve.empty() &&
        !std::equal(curve.begin(), curve.end(), kStraight.begin(), kStraight.end())) {
        warn(model, "firstPerson: the curves by which its eyes turn are taken as straight lines");
    }
    return {lenient_number(map["xRange"], {0.01F, 180.0F, 90.0F}, model),
            lenient_number(map["yRange"], {0.0F, 180.0F, scale}, model)};
}

void read_look_at0(const JsonField& from, Model& model) {
    LookAt& gaze = model.character.look_at;
    model.character.has_look_at = true;
    gaze.is_by_bones = lenient_choice(from["lookAtTypeName"], {"Bone", "BlendShape"}, model) == 0;
    const glm::vec3 offset = lenient_xyz(from["firstPersonBoneOffset"], kHeadOffset, model);
    gaze.offset_from_head = {offset.x, offset.y, -offset.z};
    const float scale = gaze.is_by_bones ? 10.0F : 1.0F;
    gaze.horizontal_inner = read_degrees(from["lookAtHorizontalInner"], scale, model);
    gaze.horizontal_outer = read_degrees(from["lookAtHorizontalOuter"], scale, model);
    gaze.vertical_down = read_degrees(from["lookAtVerticalDown"], scale, model);
    gaze.vertical_up = read_degrees(from["lookAtVerticalUp"], scale, model);
    const bool has_bone = read_part(from["firstPersonBone"], model, [&](const JsonField& bone) {
        if (bone.exists()) {
            const auto nodes = static_cast<std::int64_t>(model.nodes.size());
            static_cast<void>(bone.whole(-1, nodes - 1));
        }
    });
    static_cast<void>(has_bone);  // the head is what looks, whatever stands there
}

// ---- Whose work it is

/// CC0 asks for no credit, and other licences may say so in an address ("credit=unnecessary").
bool asks_for_credit(const JsonField& meta, std::string_view licence, Model& model) {
    constexpr std::string_view kNone = "credit=unnecessary";
    return licence != "CC0" &&
           lenient_text(meta["otherLicenseUrl"], model).find(kNone) == std::string::npos &&
           lenient_text(meta["otherPermissionUrl"], model).find(kNone) == std::string::npos;
}

void read_meta0(const JsonField& meta, Model& model) {
    Licence& licence = model.character.licence;
    if (!meta.is_object()) {
        warn(model, meta.line("is missing: whose work it is and its licence are not known"));
        return;
    }
    licence.title = lenient_text(meta["title"], model);
    licence.version = lenient_text(meta["version"], model);
    if (std::string author = lenient_text(meta["author"], model); !author.empty()) {
        licence.authors.push_back(std::move(author));
    }
    licence.contact = lenient_text(meta["contactInformation"], model);
    licence.name = lenient_text(meta["licenseName"], model);
    licence.is_credit_required = asks_for_credit(meta, licence.name, model);
    if (licence.name == "Other") {
        if (std::string address = lenient_text(meta["otherLicenseUrl"], model); !address.empty()) {
            licence.name = std::move(address);
        }
    }
    const bool has_thumbnail = read_part(meta["texture"], model, [&](JsonField texture) {
        // Files without a picture say -1.
        constexpr std::int64_t kMost = 1'000'000;
        const auto index = static_cast<std::size_t>(texture.whole_or(-1, -1, kMost) + 1);
        licence.thumbnail =
            index == 0 || index > model.textures.size() ? -1 : model.textures[index - 1].image;
    });
    static_cast<void>(has_thumbnail);  // said in a warning
    read_terms(meta, {"title", "version", "author", "contactInformation", "texture"}, model);
}

}  // namespace

Expected<void> read_vrm0(const JsonField& vrm, Model& model) {
    JsonFaults faults;
    const JsonField own = vrm.noting_to(faults, "VRM");
    if (!own.is_object()) {
        return fail("VRM is not an object");
    }
    Character& character = model.character;
    character.vrm = VrmVersion::vrm0;
    character.faces_minus_z = true;
    read_human_bones0(own["humanoid"]["humanBones"], model);
    if (Expected<void> read = faults.finish(); !read) {
        return read;
    }
    if (Expected<void> has_all = check_required_bones(character.humanoid); !has_all) {
        return has_all;
    }
    if (character.humanoid.nodes[motion::index_of(motion::Bone::chest)] < 0 ||
        character.humanoid.nodes[motion::index_of(motion::Bone::neck)] < 0) {
        warn(model,
             "VRM.humanoid: has no chest or no neck, which VRM 0.x asks for; Raks goes on without");
    }
    read_meta0(own["meta"], model);
    const BindTargets targets(model);
    read_each<Expression>(
        own["blendShapeMaster"]["blendShapeGroups"],
        kMostExpressions,
        model,
        [&](const JsonField& group, Expression& expression) {
            read_group(group, targets, expression, model);
        },
        [&](Expression expression) { add_expression(std::move(expression), model); });
    if (const JsonField gaze = own["firstPerson"]; gaze.exists()) {
        read_look_at0(gaze, model);
    }
    read_materials0(own["materialProperties"], model);
    read_springs0(own["secondaryAnimation"], model);
    return {};
}

}  // namespace raks::render
