#include "render/export/tds_writer.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "render/export/tds_names.hpp"
#include "render/export/tds_parts.hpp"
#include "render/model/model_survey.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostInObject = 65'535;  // vertices, and triangles
constexpr std::size_t kMostNodes = 65'534;     // 65535: no parent

/// A triangle of an object.
struct Face {
    std::array<std::uint32_t, 3> corners{};
    int material = -1;
    bool is_flat = false;
};

/// What becomes one object: at most 65,535 vertices and triangles.
struct Object {
    std::vector<glm::vec3> positions;  // in the node's axes
    std::vector<glm::vec2> uv;
    std::vector<Face> faces;
};

/// Whether a triangle's corners have its own normal.
bool is_flat(const ModelPrimitive& primitive, std::size_t first) {
    if (primitive.normals.empty()) {
        return false;
    }
    std::array<glm::vec3, 3> places{};
    for (std::size_t i = 0; i < 3; ++i) {
        places[i] = primitive.positions[primitive.indices[first + i]];
    }
    const glm::vec3 across = glm::cross(places[1] - places[0], places[2] - places[0]);
    const float length = glm::length(across);
    constexpr float kAlike = 0.9999F;  // cosine
    for (std::size_t i = 0; i < 3 && length > 0.0F; ++i) {
        if (glm::dot(primitive.normals[primitive.indices[first + i]], across / length) < kAlike) {
            return false;
        }
    }
    return length > 0.0F;
}

/// The objects of a mesh; its triangles stay in order.
std::vector<Object> objects_of(const ModelMesh& mesh) {
    std::vector<Object> objects;
    std::map<std::pair<const ModelPrimitive*, std::uint32_t>, std::uint32_t> known;
    for (const ModelPrimitive& primitive : mesh.primitives) {
        for (std::size_t t = 0; t + 2 < primitive.indices.size(); t += 3) {
            if (objects.empty() || objects.back().positions.size() + 3 > kMostInObject ||
                objects.back().faces.size() == kMostInObject) {
                objects.emplace_back();
                known.clear();
            }
            Object& object = objects.back();
            Face face{.material = primitive.material, .is_flat = is_flat(primitive, t)};
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = primitive.indices[t + corner];
                const auto [place, is_new] = known.try_emplace(
                    {&primitive, vertex}, static_cast<std::uint32_t>(object.positions.size()));
                if (is_new) {
                    object.positions.push_back(primitive.positions[vertex]);
                    object.uv.push_back(primitive.uv[0].empty() ? glm::vec2(0.0F)
                                                                : primitive.uv[0][vertex]);
                }
                face.corners[corner] = place->second;
            }
            object.faces.push_back(face);
        }
    }
    return objects;
}

/// Writes a model.
class TdsWriter {
 public:
    TdsWriter(const Model& model, TdsExport& made)
        : model_(model),
          made_(made),
          world_(rest_world(model)),
          materials_(tds_material_names(model)) {
        made.node_names = tds_node_names(model);
    }

    Expected<void> write(const std::string& stem) {
        constexpr std::uint16_t kFile = 0x4D4D;
        constexpr std::uint16_t kVersion = 0x0002;
        constexpr std::uint16_t kEditor = 0x3D3D;
        constexpr std::uint16_t kMeshVersion = 0x3D3E;
        constexpr std::uint16_t kScale = 0x0100;
        constexpr std::uint16_t kKeyframer = 0xB000;
        editor_.chunk(kMeshVersion, TdsBytes().u32(3));
        const TdsBytes materials = tds_materials(model_, materials_, stem, made_);
        keyframer_ = head();
        for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
            add_node(i);
        }
        for (const auto& [node, object] : rest_) {
            add_further_object(node, object);
        }
        if (next_id_ > kMostNodes) {
            return fail(fmt::format("more than {} nodes: 3DS has no more", kMostNodes));
        }
        TdsBytes file;
        file.chunk(kVersion, TdsBytes().u32(3))
            .chunk(
                kEditor,
                editor_.append(materials).chunk(kScale, TdsBytes().number(1.0F)).append(objects_))
            .chunk(kKeyframer, keyframer_);
        if (file.bytes().size() > std::numeric_limits<std::uint32_t>::max() - 6U) {
            return fail("more than 4 GiB: 3DS has no more");
        }
        made_.bytes = TdsBytes().chunk(kFile, file).bytes();
        return {};
    }

 private:
    static TdsBytes head() {
        constexpr std::uint16_t kHead = 0xB00A;
        constexpr std::uint16_t kSegment = 0xB008;
        TdsBytes keyframer;
        keyframer.chunk(kHead, TdsBytes().u16(5).text("RAKS").u32(1))
            .chunk(kSegment, TdsBytes().u32(0).u32(1));
        return keyframer;
    }

    void add_node(std::size_t index) {
        const ModelNode& node = model_.nodes[index];
        const auto parent =
            node.parent < 0 ? std::nullopt : std::optional<std::size_t>(node.parent);
        std::vector<Object> objects =
            node.mesh < 0 ? std::vector<Object>()
                          : objects_of(model_.meshes[static_cast<std::size_t>(node.mesh)]);
        const std::string& name = made_.node_names[index];
        for (std::size_t i = 1; i < objects.size(); ++i) {
            rest_.emplace_back(index, std::move(objects[i]));
        }
        if (!objects.empty()) {
            add_object(name, objects.front(), index);
        }
        add_keys({.name = name, .has_mesh = !objects.empty(), .parent = parent, .place = node});
    }

    /// More than one object can hold: a node below its own.
    void add_further_object(std::size_t node, const Object& object) {
        const std::string name = fmt::format("part{}", next_id_);
        add_object(name, object, node);
        add_keys({.name = name, .has_mesh = true, .parent = node, .place = {}});
    }

    /// Vertices are where they are at rest; the axes say where the node is then.
    void add_object(const std::string& name, const Object& object, std::size_t node) {
        constexpr std::uint16_t kObject = 0x4000;
        constexpr std::uint16_t kMesh = 0x4100;
        constexpr std::uint16_t kVertices = 0x4110;
        constexpr std::uint16_t kUv = 0x4140;
        constexpr std::uint16_t kAxes = 0x4160;
        const glm::mat4& world = world_[node];
        TdsBytes vertices;
        TdsBytes uv;
        vertices.u16(object.positions.size());
        uv.u16(object.uv.size());
        for (std::size_t i = 0; i < object.positions.size(); ++i) {
            vertices.vector(with_z_up(glm::vec3(world * glm::vec4(object.positions[i], 1.0F))));
            uv.number(object.uv[i].x).number(1.0F - object.uv[i].y);
        }
        // The axes x, y, z of z up are those of x, -z, y.
        TdsBytes axes;
        axes.vector(with_z_up(glm::vec3(world[0])))
            .vector(with_z_up(-glm::vec3(world[2])))
            .vector(with_z_up(glm::vec3(world[1])))
            .vector(with_z_up(glm::vec3(world[3])));
        TdsBytes mesh;
        mesh.chunk(kVertices, vertices).chunk(kUv, uv).chunk(kAxes, axes).append(faces_of(object));
        objects_.chunk(kObject, TdsBytes().text(name).append(TdsBytes().chunk(kMesh, mesh)));
    }

    /// The faces with their materials and what is smooth.
    [[nodiscard]] TdsBytes faces_of(const Object& object) const {
        constexpr std::uint16_t kFaces = 0x4120;
        constexpr std::uint16_t kMaterial = 0x4130;
        constexpr std::uint16_t kSmoothing = 0x4150;
        constexpr std::size_t kEdgesShown = 7;
        TdsBytes faces;
        TdsBytes smoothing;
        std::map<int, std::vector<std::size_t>> by_material;
        faces.u16(object.faces.size());
        for (std::size_t i = 0; i < object.faces.size(); ++i) {
            const Face& face = object.faces[i];
            faces.u16(face.corners[0]).u16(face.corners[1]).u16(face.corners[2]).u16(kEdgesShown);
            smoothing.u32(face.is_flat ? 0 : 1);
            by_material[face.material].push_back(i);
        }
        for (const auto& [material, which] : by_material) {
            if (material < 0) {
                continue;
            }
            TdsBytes group;
            group.text(materials_[static_cast<std::size_t>(material)]).u16(which.size());
            for (const std::size_t face : which) {
                group.u16(face);
            }
            faces.chunk(kMaterial, group);
        }
        faces.chunk(kSmoothing, smoothing);
        return TdsBytes().chunk(kFaces, faces);
    }

    /// A node of the keyframer.
    struct Keys {
        std::string name;
        bool has_mesh = false;
        std::optional<std::size_t> parent;  ///< an id
        ModelNode place;
    };

    static TdsBytes track() { return TdsBytes().u16(0).u32(0).u32(0).u32(1).u32(0).u16(0); }

    /// Its id is the next: nodes of the model have those of their place.
    void add_keys(const Keys& keys) {
        constexpr std::uint16_t kNode = 0xB002;
        constexpr std::uint16_t kName = 0xB010;
        constexpr std::uint16_t kInstance = 0xB011;
        constexpr std::uint16_t kPivot = 0xB013;
        constexpr std::uint16_t kPlaces = 0xB020;
        constexpr std::uint16_t kTurns = 0xB021;
        constexpr std::uint16_t kScales = 0xB022;
        constexpr std::uint16_t kId = 0xB030;
        constexpr std::size_t kNoParent = 0xFFFF;
        const glm::quat q =
            keys.place.rotation.w < 0.0F ? -keys.place.rotation : keys.place.rotation;
        const glm::vec3 part(q.x, q.y, q.z);
        const float length = glm::length(part);
        const glm::vec3 axis = length > 0.0F ? part / length : glm::vec3(0.0F, 1.0F, 0.0F);
        const float angle = 2.0F * std::atan2(length, q.w);
        const glm::vec3& scale = keys.place.scale;
        TdsBytes node;
        node.chunk(kId, TdsBytes().u16(next_id_++))
            .chunk(kName,
                   TdsBytes()
                       .text(keys.has_mesh ? keys.name : "$$$DUMMY")
                       .u16(0)
                       .u16(0)
                       .u16(keys.parent.value_or(kNoParent)));
        if (!keys.has_mesh) {
            node.chunk(kInstance, TdsBytes().text(keys.name));
        }
        // Turns are clockwise.
        node.chunk(kPivot, TdsBytes().vector(glm::vec3(0.0F)))
            .chunk(kPlaces, track().vector(with_z_up(keys.place.translation)))
            .chunk(kTurns, track().number(-angle).vector(with_z_up(axis)))
            .chunk(kScales, track().vector({scale.x, scale.z, scale.y}));
        keyframer_.chunk(kNode, node);
    }

    const Model& model_;
    TdsExport& made_;
    std::vector<glm::mat4> world_;
    std::vector<std::string> materials_;
    std::vector<std::pair<std::size_t, Object>> rest_;  // node, object
    std::size_t next_id_ = 0;
    TdsBytes editor_;
    TdsBytes objects_;
    TdsBytes keyframer_;
};

}  // namespace

Expected<TdsExport> tds_export(const Model& model, const std::string& stem) {
    if (!model.skins.empty()) {
        return fail("3DS has no skins");
    }
    TdsExport made;
    if (auto written = TdsWriter(model, made).write(stem); !written) {
        return fail(written.error());
    }
    return made;
}

}  // namespace raks::render
