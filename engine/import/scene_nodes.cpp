#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/printable.hpp"
#include "engine/import/scene_parts.hpp"
#include "render/model/finite.hpp"
#include "render/model/model_survey.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>

namespace raks::engine {
namespace {

using render::ModelNode;

constexpr std::size_t kMostNodes = 50'000;
constexpr float kLargestScale = 1e4F;  // metres a unit
constexpr float kSmallestScale = 1e-6F;

std::optional<int> whole(const aiMetadata* metadata, const char* key) {
    std::int32_t value = 0;
    return metadata != nullptr && metadata->Get(key, value) ? std::optional(value) : std::nullopt;
}

/// An axis of the file as a direction: axis 0 to 2 and its sign.
std::optional<glm::vec3> axis_of(const aiMetadata* metadata,
                                 const char* axis_key,
                                 const char* sign_key) {
    const auto axis = whole(metadata, axis_key);
    const auto sign = whole(metadata, sign_key);
    if (!axis || *axis < 0 || *axis > 2 || !sign || *sign == 0) {
        return std::nullopt;
    }
    glm::vec3 direction(0.0F);
    direction[*axis] = *sign > 0 ? 1.0F : -1.0F;
    return direction;
}

/// What turns the file's axes to ours: x to the figure's left, y up, z to the front.
glm::quat turn_of(const aiMetadata* metadata) {
    const auto up = axis_of(metadata, "UpAxis", "UpAxisSign");
    const auto front = axis_of(metadata, "FrontAxis", "FrontAxisSign");
    if (!up || !front || glm::dot(*up, *front) != 0.0F) {
        return {1.0F, 0.0F, 0.0F, 0.0F};
    }
    const glm::vec3 left = glm::cross(*up, *front);
    // The file's axes are the rows.
    return glm::quat_cast(glm::transpose(glm::mat3(left, *up, *front)));
}

/// Metres a unit of the file: FBX counts in centimetres.
float scale_of(const aiMetadata* metadata) {
    constexpr double kCentimetre = 0.01;
    double factor = 0.0;
    float narrow = 0.0F;
    if (metadata == nullptr) {
        return 1.0F;
    }
    if (metadata->Get("UnitScaleFactor", narrow)) {
        factor = static_cast<double>(narrow);
    } else if (!metadata->Get("UnitScaleFactor", factor)) {
        return 1.0F;
    }
    const auto scale = static_cast<float>(factor * kCentimetre);
    return scale > kSmallestScale && scale < kLargestScale ? scale : 1.0F;
}

int add_node(ModelNode node, int parent, const aiNode* source, SceneImport& import) {
    const auto index = static_cast<int>(import.model.nodes.size());
    node.parent = parent;
    if (parent >= 0) {
        import.model.nodes[static_cast<std::size_t>(parent)].children.push_back(index);
    } else {
        import.model.roots.push_back(index);
    }
    import.model.nodes.push_back(std::move(node));
    import.sources.push_back(source);
    return index;
}

/// Puts a node where a matrix says; what it shears is lost.
void place_node(const aiMatrix4x4& matrix, ModelNode& node) {
    aiVector3D scale;
    aiVector3D place;
    aiQuaternion turn;
    matrix.Decompose(scale, turn, place);
    node.translation = {place.x, place.y, place.z};
    node.scale = {scale.x, scale.y, scale.z};
    const glm::quat q(turn.w, turn.x, turn.y, turn.z);
    const float length = glm::length(q);
    node.rotation =
        length > 0.0F && std::isfinite(length) ? q / length : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
}

/// Takes the turn and the scale that the scene's root has into those of the scene: Collada's reader
/// puts axes and unit there.
void take_root(ModelNode& root, SceneImport& import) {
    const float scale = root.scale.x;
    constexpr float kSlack = 1e-4F;
    const bool is_uniform = scale > kSmallestScale && scale < kLargestScale &&
                            glm::length(root.scale - glm::vec3(scale)) < kSlack * scale;
    if (is_uniform) {
        import.scale *= scale;
        root.scale = glm::vec3(1.0F);
    }
    import.turn = import.turn * root.rotation;
    root.translation = import.turn * root.translation;
    root.rotation = import.turn;
}

/// Whether an FBX node is as large as it says, whatever its parent's size (Maya's bones).
bool has_own_size(const aiNode& node) {
    constexpr int kRrs = 2;  // InheritType of the FBX SDK: rotations alone
    return whole(node.mMetaData, "InheritType") == kRrs;
}

/// The sizes of nodes, parents first.
class NodeSizes {
 public:
    /// What the next node's scale is multiplied with, so that it is as large as it means to be
    /// below a parent whose size it takes.
    glm::vec3 add(const aiNode& source, const ModelNode& node, int parent) {
        const glm::vec3 above =
            parent < 0 ? glm::vec3(1.0F) : sizes_[static_cast<std::size_t>(parent)];
        const bool is_apart = has_own_size(source) && above.x * above.y * above.z != 0.0F;
        sizes_.push_back(is_apart ? node.scale : above * node.scale);
        return is_apart ? 1.0F / above : glm::vec3(1.0F);
    }

 private:
    std::vector<glm::vec3> sizes_;
};

}  // namespace

glm::mat4 matrix_of(const aiMatrix4x4& m) {
    return {{m.a1, m.b1, m.c1, m.d1},
            {m.a2, m.b2, m.c2, m.d2},
            {m.a3, m.b3, m.c3, m.d3},
            {m.a4, m.b4, m.c4, m.d4}};
}

Expected<void> import_nodes(SceneImport& import) {
    import.turn = turn_of(import.scene.mMetaData);
    import.scale = scale_of(import.scene.mMetaData);
    NodeSizes sizes;
    std::vector<std::pair<const aiNode*, int>> waiting{{import.scene.mRootNode, -1}};
    while (!waiting.empty()) {
        const auto [source, above] = waiting.back();
        waiting.pop_back();
        if (import.model.nodes.size() >= kMostNodes) {
            return fail(fmt::format("more than {} nodes", kMostNodes));
        }
        ModelNode node;
        node.name = source->mName.C_Str();
        if (!render::is_finite(matrix_of(source->mTransformation))) {
            return fail(fmt::format("node \"{}\" is at no finite place", printable(node.name, 60)));
        }
        place_node(source->mTransformation, node);
        if (above < 0) {
            take_root(node, import);
        }
        node.translation *= import.scale;
        import.scale_factors.push_back(sizes.add(*source, node, above));
        node.scale *= import.scale_factors.back();
        const int index = add_node(std::move(node), above, source, import);
        import.nodes.emplace(source->mName.C_Str(), index);
        for (unsigned i = source->mNumChildren; i > 0; --i) {  // the first is taken first
            waiting.emplace_back(source->mChildren[i - 1], index);
        }
    }
    import.world = render::rest_world(import.model);
    return {};
}

}  // namespace raks::engine
