#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string>
#include <tuple>
#include <utility>

#include "base/printable.hpp"
#include "engine/import/mesh_skin.hpp"
#include "engine/import/scene_parts.hpp"
#include "engine/import/weld.hpp"
#include "render/model/finite.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace raks::engine {
namespace {

using render::ModelMesh;
using render::ModelNode;
using render::ModelPrimitive;
using render::MorphTarget;

constexpr std::size_t kMostVertices = 3'000'000;  // of all meshes

glm::vec3 vector_of(const aiVector3D& v) { return {v.x, v.y, v.z}; }

glm::vec3 unit(const glm::vec3& v) {
    const float length = glm::length(v);
    return length > 0.0F && std::isfinite(length) ? v / length : glm::vec3(0.0F, 1.0F, 0.0F);
}

/// The four joints that weigh most on a vertex, the heaviest first.
struct FourJoints {
    std::array<std::uint16_t, 4> joints{};
    std::array<float, 4> weights{};

    void add(std::uint16_t joint, float weight) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (weight > weights[i]) {
                std::swap(weight, weights[i]);
                std::swap(joint, joints[i]);
            }
        }
    }

    void make_whole(std::uint16_t otherwise) {
        const float sum = weights[0] + weights[1] + weights[2] + weights[3];
        if (!(sum > 0.0F)) {
            joints = {otherwise};
            weights = {1.0F};
            return;
        }
        for (float& weight : weights) {
            weight /= sum;
        }
    }
};

/// The meshes of a scene.
class MeshImport {
 public:
    explicit MeshImport(SceneImport& import) : import_(import), skins_(import.model) {}

    Expected<void> run() {
        const std::size_t nodes = import_.model.nodes.size();
        for (std::size_t node = 0; node < nodes; ++node) {
            const aiNode* const source = import_.sources[node];
            if (source == nullptr || source->mNumMeshes == 0) {
                continue;
            }
            if (auto done = import_node(static_cast<int>(node), *source); !done) {
                return done;
            }
        }
        return {};
    }

 private:
    using MeshList = std::vector<unsigned>;

    /// All meshes of a node: rigid ones and those of each skin as one mesh each. The first of them
    /// is the node's, the others hang on nodes below it.
    Expected<void> import_node(int node, const aiNode& source) {
        std::vector<std::pair<int, MeshList>> groups;  // skin (-1: none) and meshes
        for (unsigned i = 0; i < source.mNumMeshes; ++i) {
            const aiMesh& mesh = *import_.scene.mMeshes[source.mMeshes[i]];
            if (mesh.mNumFaces == 0 || mesh.mNumVertices == 0) {
                continue;
            }
            const auto skin = bind(mesh, node, places_[{node, source.mMeshes[i]}]);
            if (!skin) {
                return fail(skin.error());
            }
            const auto group = std::find_if(groups.begin(), groups.end(), [&](const auto& each) {
                return each.first == *skin;
            });
            if (group == groups.end()) {
                groups.emplace_back(*skin, MeshList{source.mMeshes[i]});
            } else {
                group->second.push_back(source.mMeshes[i]);
            }
        }
        bool is_first = true;
        for (const auto& [skin, meshes] : groups) {
            const auto mesh = mesh_of(node, skin, meshes);
            if (!mesh) {
                return fail(mesh.error());
            }
            ModelNode& carrier = is_first ? node_at(node) : below(node);
            carrier.mesh = *mesh;
            carrier.skin = skin;
            is_first = false;
        }
        return {};
    }

    ModelNode& node_at(int node) { return import_.model.nodes[static_cast<std::size_t>(node)]; }

    ModelNode& below(int node) {
        const auto index = static_cast<int>(import_.model.nodes.size());
        ModelNode child;
        child.parent = node;
        child.name = node_at(node).name + " part";
        node_at(node).children.push_back(index);
        import_.model.nodes.push_back(std::move(child));
        import_.sources.push_back(nullptr);
        return import_.model.nodes.back();
    }

    /// The skin of a mesh and which of its joints the mesh's bones are, after them the mesh's own
    /// node, which carries what hangs on no bone; -1: it has none.
    Expected<int> bind(const aiMesh& mesh, int node, std::vector<std::uint16_t>& places) {
        std::vector<BoundJoint> joints;
        for (unsigned i = 0; i < mesh.mNumBones; ++i) {
            const aiBone& bone = *mesh.mBones[i];
            // In metres, from where the mesh is as it is stored.
            const glm::mat4 inverse_bind =
                scaling() * matrix_of(bone.mOffsetMatrix) * glm::inverse(skinned_place(node));
            const int joint = joint_of(bone.mName.C_Str(), inverse_bind);
            if (joint < 0 || !render::is_finite(inverse_bind)) {
                return fail(fmt::format("mesh \"{}\" hangs on \"{}\", which {}",
                                        printable(mesh.mName.C_Str(), 60),
                                        printable(bone.mName.C_Str(), 60),
                                        joint < 0 ? "is not there" : "is at no finite place"));
            }
            joints.push_back({joint, inverse_bind});
        }
        if (joints.empty()) {
            return -1;
        }
        if (has_loose_vertices(mesh)) {
            joints.push_back({node, glm::inverse(import_.world[static_cast<std::size_t>(node)])});
        }
        return skins_.skin_of(joints, places);
    }

    [[nodiscard]] glm::mat4 scaling() const {
        glm::mat4 matrix(import_.scale);
        matrix[3][3] = 1.0F;
        return matrix;
    }

    /// Where the vertices of a skinned mesh go: into the world, so that its bones are bound there.
    [[nodiscard]] glm::mat4 skinned_place(int node) const {
        return import_.world[static_cast<std::size_t>(node)] * scaling();
    }

    /// The node of a bone: of several with its name the one that is nearest to where it is bound;
    /// -1: there is none.
    [[nodiscard]] int joint_of(std::string_view name, const glm::mat4& inverse_bind) const {
        const auto [first, last] = import_.nodes.equal_range(name);
        if (first == last || std::next(first) == last) {
            return first == last ? -1 : first->second;
        }
        const glm::mat4 bound = glm::inverse(inverse_bind);
        const auto distance = [&](const auto& entry) {
            return glm::length(import_.world[static_cast<std::size_t>(entry.second)][3] - bound[3]);
        };
        return std::min_element(
                   first,
                   last,
                   [&](const auto& a, const auto& b) { return distance(a) < distance(b); })
            ->second;
    }

    static bool has_loose_vertices(const aiMesh& mesh) {
        std::vector<bool> is_held(mesh.mNumVertices, false);
        for (unsigned i = 0; i < mesh.mNumBones; ++i) {
            const aiBone& bone = *mesh.mBones[i];
            for (unsigned w = 0; w < bone.mNumWeights; ++w) {
                const aiVertexWeight& weight = bone.mWeights[w];
                if (weight.mVertexId < mesh.mNumVertices && weight.mWeight > 0.0F) {
                    is_held[weight.mVertexId] = true;
                }
            }
        }
        return std::find(is_held.begin(), is_held.end(), false) != is_held.end();
    }

    /// The mesh of a group, which nodes share that have the same ones.
    Expected<int> mesh_of(int node, int skin, const MeshList& list) {
        const auto key = std::tuple(skin, skin >= 0 ? node : -1, list);
        const auto known = meshes_.find(key);
        if (known != meshes_.end()) {
            return known->second;
        }
        ModelMesh mesh;
        mesh.name = import_.scene.mMeshes[list.front()]->mName.C_Str();
        for (const unsigned index : list) {
            const aiMesh& source = *import_.scene.mMeshes[index];
            vertices_ += source.mNumVertices;
            if (vertices_ > kMostVertices) {
                return fail(fmt::format("more than {} vertices", kMostVertices));
            }
            auto primitive = primitive_of(
                source, places_[{node, index}], skin >= 0 ? skinned_place(node) : scaling());
            if (!primitive) {
                return fail(std::move(primitive.error())
                                .in("mesh \"" + printable(source.mName.C_Str(), 60) + "\""));
            }
            add_morph_names(source, mesh);
            mesh.primitives.push_back(std::move(*primitive));
        }
        // As many for each primitive.
        for (ModelPrimitive& primitive : mesh.primitives) {
            primitive.morphs.resize(mesh.morph_names.size());
            for (MorphTarget& morph : primitive.morphs) {
                const bool has_normals = !morph.normals.empty();
                morph.normals.resize(has_normals ? morph.vertices.size() : 0);
            }
        }
        mesh.morph_weights.assign(mesh.morph_names.size(), 0.0F);
        const auto index = static_cast<int>(import_.model.meshes.size());
        import_.model.meshes.push_back(std::move(mesh));
        meshes_[key] = index;
        return index;
    }

    static void add_morph_names(const aiMesh& source, ModelMesh& mesh) {
        for (unsigned i = static_cast<unsigned>(mesh.morph_names.size()); i < source.mNumAnimMeshes;
             ++i) {
            mesh.morph_names.emplace_back(source.mAnimMeshes[i]->mName.C_Str());
        }
    }

    Expected<ModelPrimitive> primitive_of(const aiMesh& source,
                                          const std::vector<std::uint16_t>& places,
                                          const glm::mat4& place) const {
        ModelPrimitive primitive;
        primitive.material = source.mMaterialIndex < import_.model.materials.size()
                                 ? static_cast<int>(source.mMaterialIndex)
                                 : -1;
        for (unsigned v = 0; v < source.mNumVertices; ++v) {
            primitive.positions.push_back(vector_of(source.mVertices[v]));
            if (!render::is_finite(primitive.positions.back())) {
                return fail(fmt::format("vertex {} is at no finite place", v));
            }
            if (source.HasNormals()) {
                primitive.normals.push_back(unit(vector_of(source.mNormals[v])));
            }
        }
        add_coordinates(source, primitive);
        for (unsigned f = 0; f < source.mNumFaces; ++f) {
            const aiFace& face = source.mFaces[f];
            for (unsigned corner = 0; face.mNumIndices == 3 && corner < 3; ++corner) {
                if (face.mIndices[corner] >= source.mNumVertices) {
                    return fail(fmt::format("face {} has a corner that does not exist", f));
                }
                primitive.indices.push_back(face.mIndices[corner]);
            }
        }
        if (!places.empty()) {
            add_weights(source, places, primitive);
        }
        add_morphs(source, primitive);
        move(place, primitive);
        weld(primitive);
        return primitive;
    }

    /// Takes a primitive to a place.
    static void move(const glm::mat4& place, ModelPrimitive& primitive) {
        const glm::mat3 linear(place);
        const glm::mat3 of_normals = glm::transpose(glm::inverse(linear));
        for (glm::vec3& position : primitive.positions) {
            position = glm::vec3(place * glm::vec4(position, 1.0F));
        }
        for (MorphTarget& morph : primitive.morphs) {
            for (glm::vec3& position : morph.positions) {
                position = linear * position;
            }
            for (std::size_t i = 0; i < morph.normals.size(); ++i) {
                const glm::vec3& normal = primitive.normals[morph.vertices[i]];
                morph.normals[i] =
                    unit(of_normals * (normal + morph.normals[i])) - unit(of_normals * normal);
            }
        }
        for (glm::vec3& normal : primitive.normals) {
            normal = unit(of_normals * normal);
        }
        if (glm::determinant(linear) < 0.0F) {  // a mirror turns triangles over
            for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
                std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
            }
        }
    }

    static void add_coordinates(const aiMesh& source, ModelPrimitive& primitive) {
        for (unsigned set = 0; set < 2 && source.HasTextureCoords(set); ++set) {
            for (unsigned v = 0; v < source.mNumVertices; ++v) {
                const aiVector3D& uv = source.mTextureCoords[set][v];
                const bool is_good = std::isfinite(uv.x) && std::isfinite(uv.y);
                // glTF counts from the upper edge.
                primitive.uv[set].push_back(is_good ? glm::vec2(uv.x, 1.0F - uv.y)
                                                    : glm::vec2(0.0F));
            }
        }
        for (unsigned v = 0; source.HasVertexColors(0) && v < source.mNumVertices; ++v) {
            const aiColor4D& c = source.mColors[0][v];
            const auto part = [](float x) { return x > 0.0F ? std::min(x, 1.0F) : 0.0F; };
            primitive.colours.emplace_back(part(c.r), part(c.g), part(c.b), part(c.a));
        }
    }

    static void add_weights(const aiMesh& source,
                            const std::vector<std::uint16_t>& places,
                            ModelPrimitive& primitive) {
        std::vector<FourJoints> all(source.mNumVertices);
        for (unsigned i = 0; i < source.mNumBones; ++i) {
            const aiBone& bone = *source.mBones[i];
            for (unsigned w = 0; w < bone.mNumWeights; ++w) {
                const aiVertexWeight& weight = bone.mWeights[w];
                if (weight.mVertexId < all.size() && std::isfinite(weight.mWeight)) {
                    all[weight.mVertexId].add(places[i], weight.mWeight);
                }
            }
        }
        for (FourJoints& four : all) {
            four.make_whole(places.back());
            primitive.joints.push_back(four.joints);
            primitive.weights.push_back(four.weights);
        }
    }

    static void add_morphs(const aiMesh& source, ModelPrimitive& primitive) {
        for (unsigned i = 0; i < source.mNumAnimMeshes; ++i) {
            const aiAnimMesh& shape = *source.mAnimMeshes[i];
            MorphTarget& morph = primitive.morphs.emplace_back();
            const bool has_normals = shape.HasNormals() && source.HasNormals();
            const unsigned count =
                shape.HasPositions() ? std::min(shape.mNumVertices, source.mNumVertices) : 0;
            for (unsigned v = 0; v < count; ++v) {
                const glm::vec3 moved = vector_of(shape.mVertices[v] - source.mVertices[v]);
                const glm::vec3 turned = has_normals
                                             ? vector_of(shape.mNormals[v] - source.mNormals[v])
                                             : glm::vec3(0.0F);
                const bool is_still = moved == glm::vec3(0.0F) && turned == glm::vec3(0.0F);
                if (is_still || !render::is_finite(moved) || !render::is_finite(turned)) {
                    continue;
                }
                morph.vertices.push_back(v);
                morph.positions.push_back(moved);
                if (has_normals) {
                    morph.normals.push_back(turned);
                }
            }
        }
    }

    SceneImport& import_;
    SkinPool skins_;
    std::map<std::pair<int, unsigned>, std::vector<std::uint16_t>> places_;  // by node and mesh
    // By skin, node where there is one, and meshes.
    std::map<std::tuple<int, int, MeshList>, int> meshes_;
    std::size_t vertices_ = 0;
};

}  // namespace

Expected<void> import_meshes(SceneImport& import) { return MeshImport(import).run(); }

}  // namespace raks::engine
