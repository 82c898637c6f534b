#include "engine/import/mesh_skin.hpp"

#include <algorithm>
#include <limits>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace raks::engine {
namespace {

using render::ModelSkin;

constexpr std::size_t kMostJoints = std::numeric_limits<std::uint16_t>::max();

std::size_t place_of(const ModelSkin& skin, int node) {
    return static_cast<std::size_t>(std::find(skin.joints.begin(), skin.joints.end(), node) -
                                    skin.joints.begin());
}

/// But for rounding: meshes are bound from different places.
bool is_same(const glm::mat4& a, const glm::mat4& b) {
    constexpr float kSlack = 1e-5F;
    for (int column = 0; column < 4; ++column) {
        const glm::vec4 difference = glm::abs(a[column] - b[column]);
        if (glm::any(glm::greaterThan(difference, glm::vec4(kSlack)))) {
            return false;
        }
    }
    return true;
}

}  // namespace

/// One joint in common at least, and none that is bound otherwise.
bool SkinPool::fits(const ModelSkin& skin, std::span<const BoundJoint> joints) const {
    bool has_common = false;
    for (const BoundJoint& joint : joints) {
        const std::size_t place = place_of(skin, joint.node);
        if (place < skin.joints.size()) {
            if (!is_same(skin.inverse_bind[place], joint.inverse_bind)) {
                return false;
            }
            has_common = true;
        }
    }
    return has_common && skin.joints.size() + joints.size() < kMostJoints;
}

int SkinPool::skin_of(std::span<const BoundJoint> joints, std::vector<std::uint16_t>& places) {
    auto skin = std::find_if(model_.skins.begin(), model_.skins.end(), [&](const ModelSkin& each) {
        return fits(each, joints);
    });
    if (skin == model_.skins.end()) {
        skin = model_.skins.insert(skin, ModelSkin{});
    }
    places.clear();
    for (const BoundJoint& joint : joints) {
        const std::size_t place = place_of(*skin, joint.node);
        if (place == skin->joints.size()) {
            skin->joints.push_back(joint.node);
            skin->inverse_bind.push_back(joint.inverse_bind);
        }
        places.push_back(static_cast<std::uint16_t>(place));
    }
    return static_cast<int>(skin - model_.skins.begin());
}

}  // namespace raks::engine
