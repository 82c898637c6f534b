#include <array>
#include <map>
#include <vector>

#include "render/export/vrm_extensions.hpp"

namespace raks::render {
namespace {

constexpr const char* kExtendedCollider = "VRMC_springBone_extended_collider";

Json ball_of(const SpringCollider& collider) {
    return {{"offset", numbers_of(collider.offset)}, {"radius", collider.radius}};
}

Json rod_of(const SpringCollider& collider) {
    Json rod = ball_of(collider);
    rod["tail"] = numbers_of(collider.tail);
    return rod;
}

/// The shape; `is_extended`: one that VRM 1.0 itself has not.
Json shape_of(const SpringCollider& collider, bool& is_extended) {
    is_extended =
        collider.shape != ColliderShape::sphere && collider.shape != ColliderShape::capsule;
    Json shape;
    switch (collider.shape) {
        case ColliderShape::sphere:
        case ColliderShape::inside_sphere:
            shape["sphere"] = ball_of(collider);
            break;
        case ColliderShape::capsule:
        case ColliderShape::inside_capsule:
            shape["capsule"] = rod_of(collider);
            break;
        case ColliderShape::plane:
            shape["plane"] = {{"offset", numbers_of(collider.offset)},
                              {"normal", numbers_of(collider.normal)}};
            break;
    }
    if (collider.shape == ColliderShape::inside_sphere) {
        shape["sphere"]["inside"] = true;
    } else if (collider.shape == ColliderShape::inside_capsule) {
        shape["capsule"]["inside"] = true;
    }
    return shape;
}

Json collider_json(const SpringCollider& collider, GlbDocument& glb) {
    bool is_extended = false;
    Json shape = shape_of(collider, is_extended);
    if (!is_extended) {
        return {{"node", collider.node}, {"shape", std::move(shape)}};
    }
    glb.use_extension(kExtendedCollider);
    // Readers without the extension meet a ball too small to hit.
    Json json = {{"node", collider.node}, {"shape", {{"sphere", {{"radius", 0.0F}}}}}};
    json["extensions"][kExtendedCollider] = {{"specVersion", "1.0"}, {"shape", std::move(shape)}};
    return json;
}

Json joint_json(const SpringJoint& joint) {
    return {{"node", joint.node},
            {"hitRadius", joint.hit_radius},
            {"stiffness", joint.stiffness},
            {"gravityPower", joint.gravity_power},
            {"gravityDir", numbers_of(joint.gravity_direction)},
            {"dragForce", joint.drag}};
}

}  // namespace

void add_springs(const Character& character, GlbDocument& glb) {
    if (character.springs.empty()) {
        return;
    }
    glb.use_extension("VRMC_springBone");
    Json json = {{"specVersion", "1.0"}};
    for (const SpringCollider& collider : character.colliders) {
        json["colliders"].push_back(collider_json(collider, glb));
    }
    // Chains that meet the same colliders share the group of them.
    std::map<std::vector<int>, std::size_t> groups;
    for (const SpringChain& chain : character.springs) {
        Json spring = Json::object();
        if (!chain.name.empty()) {
            spring["name"] = chain.name;
        }
        for (const SpringJoint& joint : chain.joints) {
            spring["joints"].push_back(joint_json(joint));
        }
        if (!chain.colliders.empty()) {
            const auto [group, is_new] = groups.try_emplace(chain.colliders, groups.size());
            spring["colliderGroups"] = {group->second};
            if (is_new) {
                json["colliderGroups"].push_back({{"colliders", chain.colliders}});
            }
        }
        if (chain.center >= 0) {
            spring["center"] = chain.center;
        }
        json["springs"].push_back(std::move(spring));
    }
    glb.json()["extensions"]["VRMC_springBone"] = std::move(json);
}

void add_constraints(const Character& character, GlbDocument& glb) {
    constexpr std::array kRollAxes = {"X", "Y", "Z"};
    constexpr std::array kAimAxes = {
        "PositiveX", "PositiveY", "PositiveZ", "NegativeX", "NegativeY", "NegativeZ"};
    for (const NodeConstraint& constraint : character.constraints) {
        Json own = {{"source", constraint.source}, {"weight", constraint.weight}};
        const auto axis = static_cast<std::size_t>(constraint.axis);
        const char* kind = "rotation";
        if (constraint.kind == ConstraintKind::roll) {
            own["rollAxis"] = kRollAxes.at(axis);
            kind = "roll";
        } else if (constraint.kind == ConstraintKind::aim) {
            own["aimAxis"] = kAimAxes.at(axis);
            kind = "aim";
        }
        glb.use_extension("VRMC_node_constraint");
        Json& node = glb.json()["nodes"][static_cast<std::size_t>(constraint.node)];
        node["extensions"]["VRMC_node_constraint"] = {{"specVersion", "1.0"},
                                                      {"constraint", {{kind, std::move(own)}}}};
    }
}

}  // namespace raks::render
