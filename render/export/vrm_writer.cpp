#include "render/export/vrm_writer.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "render/export/vrm_extensions.hpp"

#include <fmt/format.h>

namespace raks::render {
namespace {

using motion::Bone;

constexpr const char* kLicenceAddress = "https://vrm.dev/licenses/1.0/";

Expected<void> check(const Character& character) {
    for (const Bone bone : kRequiredBones) {
        if (character.humanoid.nodes[motion::index_of(bone)] < 0) {
            return fail(fmt::format("VRM asks for the bone {}, which it lacks",
                                    motion::kBoneNames[motion::index_of(bone)]));
        }
    }
    if (character.licence.title.empty() || character.licence.authors.empty()) {
        return fail("VRM asks for a title and an author, which it does not name");
    }
    return {};
}

/// VRM 1.0's members of meta that a term may fill, and whether their values are truths.
constexpr std::array<std::pair<std::string_view, bool>, 9> kTerms = {
    {{"avatarPermission", false},
     {"allowExcessivelyViolentUsage", true},
     {"allowExcessivelySexualUsage", true},
     {"commercialUsage", false},
     {"allowPoliticalOrReligiousUsage", true},
     {"allowAntisocialOrHateUsage", true},
     {"allowRedistribution", true},
     {"modification", false},
     {"otherLicenseUrl", false}}};

Json meta_of(const Licence& licence) {
    Json meta = {{"name", licence.title}};
    const auto put = [&](const char* name, const std::string& value) {
        if (!value.empty()) {
            meta[name] = value;
        }
    };
    put("version", licence.version);
    meta["authors"] = licence.authors;
    put("copyrightInformation", licence.copyright);
    put("contactInformation", licence.contact);
    const bool is_vrm = licence.name.rfind("https://vrm.dev/licenses/1.0", 0) == 0;
    meta["licenseUrl"] = kLicenceAddress;
    if (!is_vrm) {
        put(licence.name.rfind("http", 0) == 0 ? "otherLicenseUrl" : "thirdPartyLicenses",
            licence.name);
    }
    meta["creditNotation"] = licence.is_credit_required ? "required" : "unnecessary";
    for (const auto& [name, value] : licence.terms) {
        const auto* const term = std::find_if(
            kTerms.begin(), kTerms.end(), [&](const auto& each) { return each.first == name; });
        if (term == kTerms.end()) {
            continue;
        }
        if (term->second) {
            meta[name] = value == "true";
        } else {
            meta[name] = value;
        }
    }
    return meta;
}

Json bones_of(const HumanoidMap& humanoid) {
    Json bones = Json::object();
    for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
        if (humanoid.nodes[bone] >= 0) {
            bones[std::string(motion::kBoneNames[bone])] = {{"node", humanoid.nodes[bone]}};
        }
    }
    const auto put = [&](const char* name, int node) {
        if (node >= 0) {
            bones[name] = {{"node", node}};
        }
    };
    put("leftEye", humanoid.left_eye);
    put("rightEye", humanoid.right_eye);
    put("jaw", humanoid.jaw);
    return bones;
}

Json range_of(const LookAtRange& range) {
    return {{"inputMaxValue", range.input_max}, {"outputScale", range.output_scale}};
}

Json look_at_of(const LookAt& look) {
    return {{"offsetFromHeadBone", numbers_of(look.offset_from_head)},
            {"type", look.is_by_bones ? "bone" : "expression"},
            {"rangeMapHorizontalInner", range_of(look.horizontal_inner)},
            {"rangeMapHorizontalOuter", range_of(look.horizontal_outer)},
            {"rangeMapVerticalDown", range_of(look.vertical_down)},
            {"rangeMapVerticalUp", range_of(look.vertical_up)}};
}

Json vrm_of(const Model& model) {
    const Character& character = model.character;
    Json vrm = {{"specVersion", "1.0"},
                {"meta", meta_of(character.licence)},
                {"humanoid", {{"humanBones", bones_of(character.humanoid)}}}};
    if (character.has_look_at) {
        vrm["lookAt"] = look_at_of(character.look_at);
    }
    if (!character.expressions.empty()) {
        vrm["expressions"] = expressions_of(model);
    }
    return vrm;
}

}  // namespace

Expected<std::string> vrm_bytes(const Model& model) {
    if (auto good = check(model.character); !good) {
        return fail(good.error());
    }
    GlbDocument glb;
    glb.use_extension("VRMC_vrm");
    add_nodes(model, glb);
    add_meshes(model, glb);
    add_skins(model, glb);
    add_materials(model, glb);
    add_mtoon(model, glb);
    add_constraints(model.character, glb);
    glb.json()["extensions"]["VRMC_vrm"] = vrm_of(model);
    add_springs(model.character, glb);
    return glb.bytes();
}

}  // namespace raks::render
