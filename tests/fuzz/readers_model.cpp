// What is done with models: read, measured, their pictures unpacked; every index is what its type
// promises.
#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "engine/unpack/unpackers.hpp"
#include "motion/skeleton/pose.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "render/avatar/skin_vertices.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/image_file.hpp"
#include "render/import/model_motion.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/plain_picture.hpp"
#include "render/import/standing_body.hpp"
#include "render/model/model_survey.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

/// Ends the program where a promise is broken: a find of the fuzzer.
void promise(bool is_kept) {
    if (!is_kept) {
        __builtin_trap();
    }
}

/// An index into an array of `count`, or -1.
void promise_index(int index, std::size_t count) {
    promise(index >= -1 && index < static_cast<int>(count));
}

void check(const render::ModelPrimitive& primitive, const render::Model& model) {
    const std::size_t count = primitive.positions.size();
    promise_index(primitive.material, model.materials.size());
    promise(primitive.indices.size() % 3 == 0);
    for (const std::uint32_t index : primitive.indices) {
        promise(index < count);
    }
    for (const glm::vec3& place : primitive.positions) {
        promise(std::isfinite(place.x) && std::isfinite(place.y) && std::isfinite(place.z));
    }
    for (const auto& weights : primitive.weights) {
        const float sum = weights[0] + weights[1] + weights[2] + weights[3];
        promise(std::abs(sum - 1.0F) < 1e-3F);
    }
    promise(primitive.joints.size() == primitive.weights.size());
    for (const std::size_t size : {primitive.normals.size(),
                                   primitive.tangents.size(),
                                   primitive.uv[0].size(),
                                   primitive.uv[1].size(),
                                   primitive.colours.size(),
                                   primitive.joints.size()}) {
        promise(size == 0 || size == count);
    }
    for (const render::MorphTarget& morph : primitive.morphs) {
        promise(std::is_sorted(morph.vertices.begin(), morph.vertices.end()));
        promise(morph.vertices.empty() || morph.vertices.back() < count);
        promise(morph.positions.size() == morph.vertices.size());
    }
}

void check(const render::ModelNode& node, const render::Model& model) {
    promise_index(node.parent, model.nodes.size());
    promise_index(node.mesh, model.meshes.size());
    promise_index(node.skin, model.skins.size());
    if (node.mesh < 0 || node.skin < 0) {
        return;
    }
    const std::size_t joints = model.skins[static_cast<std::size_t>(node.skin)].joints.size();
    for (const auto& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
        for (const auto& four : primitive.joints) {
            promise(*std::max_element(four.begin(), four.end()) < joints);
        }
    }
}

void check(const render::Expression& expression, const render::Model& model) {
    for (const render::MorphBind& bind : expression.morphs) {
        promise(bind.node >= 0 && bind.node < static_cast<int>(model.nodes.size()));
        promise(bind.weight >= 0.0F && bind.weight <= 1.0F);
    }
    for (const render::ColourBind& bind : expression.colours) {
        promise(bind.material >= 0 && bind.material < static_cast<int>(model.materials.size()));
    }
    for (const render::TextureBind& bind : expression.textures) {
        promise(bind.material >= 0 && bind.material < static_cast<int>(model.materials.size()));
    }
}

void check(const render::SpringChain& chain, const render::Model& model) {
    promise(!chain.joints.empty());
    promise_index(chain.center, model.nodes.size());
    for (const render::SpringJoint& joint : chain.joints) {
        promise(joint.node >= 0 && joint.node < static_cast<int>(model.nodes.size()));
        promise(joint.drag >= 0.0F && joint.drag <= 1.0F && std::isfinite(joint.stiffness));
    }
    for (const int collider : chain.colliders) {
        promise(collider >= 0 && collider < static_cast<int>(model.character.colliders.size()));
    }
}

void check(const render::Character& character, const render::Model& model) {
    for (const render::Expression& expression : character.expressions) {
        check(expression, model);
    }
    for (const render::SpringChain& chain : character.springs) {
        check(chain, model);
    }
    for (const render::SpringCollider& collider : character.colliders) {
        promise(collider.node >= 0 && collider.node < static_cast<int>(model.nodes.size()));
        promise(collider.radius >= 0.0F);
    }
    for (const render::NodeConstraint& constraint : character.constraints) {
        promise(constraint.node >= 0 && constraint.node < static_cast<int>(model.nodes.size()));
        promise(constraint.source >= 0 && constraint.source < static_cast<int>(model.nodes.size()));
    }
    for (const int node : character.humanoid.nodes) {
        promise_index(node, model.nodes.size());
    }
}

/// A body that is found stands: finite, with parents that end.
void check_standing(render::Model model) {
    if (!render::map_humanoid(model)) {
        return;
    }
    promise(render::missing_bones(model.character.humanoid).empty() ||
            model.character.vrm == render::VrmVersion::none);
    const render::StandingBody standing = render::stand_up(model);
    promise(standing.world.size() == model.nodes.size() && standing.height > 0.0F);
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        std::size_t steps = 0;
        for (int up = static_cast<int>(node); up >= 0;
             up = standing.parents[static_cast<std::size_t>(up)]) {
            promise(++steps <= model.nodes.size());
        }
    }
}

void check(const render::Model& model) {
    for (const render::ModelMesh& mesh : model.meshes) {
        for (const render::ModelPrimitive& primitive : mesh.primitives) {
            check(primitive, model);
            promise(primitive.morphs.size() == mesh.morph_weights.size());
        }
    }
    for (const render::ModelNode& node : model.nodes) {
        check(node, model);
    }
    check(model.character, model);
    for (const render::ModelTexture& texture : model.textures) {
        promise_index(texture.image, model.images.size());
    }
}

/// A second of a turn, with all that swings and every vertex.
void move(const render::Model& model) {
    const render::AvatarRig rig = render::build_rig(model);
    render::RigState state(rig);
    const auto pose_at = [](StreamTime time) {
        motion::Pose pose;
        pose.rotation(motion::Bone::hips) =
            glm::angleAxis(static_cast<float>(to_seconds(time)), glm::vec3(0.0F, 1.0F, 0.0F));
        return pose;
    };
    render::Face face;
    face.weights.fill(0.6F);
    face.gaze = 1.0F;
    for (const double seconds : {0.0, 0.2, 0.4}) {
        const StreamTime time = stream_time_from_seconds(seconds);
        render::advance(rig, time, 1.0F, pose_at, state);
        render::pose_avatar(rig, pose_at(time), face, 1.0F, state);
    }
    std::vector<glm::mat4> matrices;
    render::PosedVertices posed;
    for (const int node : rig.tree.nodes) {
        const int mesh = model.nodes[static_cast<std::size_t>(node)].mesh;
        if (mesh < 0) {
            continue;
        }
        matrices.resize(render::matrix_count(model, node));
        render::skinning_matrices(model, rig.tree, state.joints, node, matrices);
        for (const auto& primitive : model.meshes[static_cast<std::size_t>(mesh)].primitives) {
            render::pose_vertices(primitive, state.face.morphs, matrices, posed);
        }
    }
}

/// Unpacks a picture as raks-unpack does it, but in this process and without a cage.
bool unpack_here(std::span<const std::byte> packed) {
    const auto head = render::look_at_image(packed);
    if (!head) {
        promise(head.error().message.find('\n') == std::string::npos);
        return false;
    }
    constexpr render::PackedKind kKinds[] = {
        render::PackedKind::png, render::PackedKind::jpeg, render::PackedKind::webp};
    const render::UnpackRequest what{.kind = kKinds[static_cast<std::size_t>(head->format)],
                                     .row_bytes = static_cast<std::uint32_t>(head->width) * 4,
                                     .rows = static_cast<std::uint64_t>(head->height)};
    std::vector<std::byte> pixels(static_cast<std::size_t>(what.rows * what.row_bytes));
    return engine::unpack(what, packed, pixels).has_value();
}

bool read_model_named(const char* name, std::string_view text) {
    const auto model = render::read_model(
        std::as_bytes(std::span(text.data(), text.size())), name, render::SideFiles());
    if (!model) {
        promise(model.error().message.find('\n') == std::string::npos);
        return false;
    }
    check(*model);
    static_cast<void>(render::survey(*model));
    move(*model);
    check_standing(*model);
    for (std::size_t clip = 0; clip < std::min<std::size_t>(model->animations.size(), 3); ++clip) {
        const auto motion = render::model_motion(*model, clip, std::nullopt);
        const auto places = motion ? motion->positions : std::vector<glm::dvec3>();
        for (const glm::dvec3& place : places) {
            promise(std::isfinite(place.x + place.y + place.z));
        }
    }
    for (const render::ModelImage& image : model->images) {
        if (!image.packed.empty()) {
            static_cast<void>(unpack_here(image.packed));
        }
    }
    return true;
}

}  // namespace

// A text may be either glTF or its container: the ending says nothing to the reader.
bool read_model_file(std::string_view text) { return read_model_named("x.vrm", text); }

bool read_tds_file(std::string_view bytes) { return read_model_named("x.3ds", bytes); }

bool read_packed_picture(std::string_view bytes) {
    return unpack_here(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

bool read_plain_picture_file(std::string_view bytes) {
    const auto file = std::as_bytes(std::span(bytes.data(), bytes.size()));
    const auto image = render::read_plain_picture(file);
    if (!image) {
        promise(image.error().message.find('\n') == std::string::npos);
        return false;
    }
    promise(image->pixels.size() ==
            4 * static_cast<std::size_t>(image->width) * static_cast<std::size_t>(image->height));
    return true;
}

bool read_bone_label_file(std::string_view text) {
    const auto labels = render::read_bone_labels(text, "x.toml");
    if (!labels) {
        promise(labels.error().message.find('\n') == std::string::npos);
        return false;
    }
    promise(!labels->bones.empty());
    return true;
}

}  // namespace raks::fuzz
