#include <vector>

#include "render/export/glb_parts.hpp"

namespace raks::render {
namespace {

/// Joints that weigh nothing are joint 0, as glTF wants it.
std::vector<std::array<std::uint16_t, 4>> weighing_joints(const ModelPrimitive& primitive) {
    auto joints = primitive.joints;
    for (std::size_t v = 0; v < joints.size() && v < primitive.weights.size(); ++v) {
        for (std::size_t i = 0; i < 4; ++i) {
            if (primitive.weights[v][i] == 0.0F) {
                joints[v][i] = 0;
            }
        }
    }
    return joints;
}

/// The meshes of a document.
class MeshWriter {
 public:
    explicit MeshWriter(GlbDocument& glb) : glb_(glb) {}

    Json json_of(const ModelMesh& mesh) {
        Json json = Json::object();
        if (!mesh.name.empty()) {
            json["name"] = mesh.name;
        }
        json["primitives"] = Json::array();
        for (const ModelPrimitive& primitive : mesh.primitives) {
            json["primitives"].push_back(json_of(primitive));
        }
        if (!mesh.morph_weights.empty()) {
            json["weights"] = mesh.morph_weights;
        }
        if (!mesh.morph_names.empty()) {
            json["extras"] = {{"targetNames", mesh.morph_names}};
        }
        return json;
    }

 private:
    Json json_of(const ModelPrimitive& primitive) {
        Json json = {{"attributes", attributes_of(primitive)}};
        if (!primitive.indices.empty()) {
            json["indices"] = glb_.add_indices(primitive.indices, primitive.positions.size());
        }
        if (primitive.material >= 0) {
            json["material"] = primitive.material;
        }
        for (const MorphTarget& morph : primitive.morphs) {
            json["targets"].push_back(json_of(morph, primitive.positions.size()));
        }
        return json;
    }

    Json attributes_of(const ModelPrimitive& primitive) {
        Json json = {{"POSITION",
                      glb_.add_floats(
                          floats_of(primitive.positions), GlbType::vec3, GlbUse::vertices, true)}};
        add(primitive.normals, GlbType::vec3, "NORMAL", json);
        add(primitive.tangents, GlbType::vec4, "TANGENT", json);
        add(primitive.uv[0], GlbType::vec2, "TEXCOORD_0", json);
        add(primitive.uv[1], GlbType::vec2, "TEXCOORD_1", json);
        add(primitive.colours, GlbType::vec4, "COLOR_0", json);
        if (!primitive.joints.empty()) {
            json["JOINTS_0"] = glb_.add_joints(weighing_joints(primitive));
            add(primitive.weights, GlbType::vec4, "WEIGHTS_0", json);
        }
        return json;
    }

    template <typename Vector>
    void add(const std::vector<Vector>& values, GlbType type, const char* name, Json& json) {
        if (!values.empty()) {
            json[name] = glb_.add_floats(floats_of(values), type, GlbUse::vertices);
        }
    }

    Json json_of(const MorphTarget& morph, std::size_t vertices) {
        Json json = {
            {"POSITION",
             glb_.add_sparse_vec3(vertices, morph.vertices, floats_of(morph.positions), true)}};
        if (!morph.normals.empty()) {
            json["NORMAL"] =
                glb_.add_sparse_vec3(vertices, morph.vertices, floats_of(morph.normals), false);
        }
        return json;
    }

    GlbDocument& glb_;
};

}  // namespace

void add_meshes(const Model& model, GlbDocument& glb) {
    MeshWriter writer(glb);
    for (const ModelMesh& mesh : model.meshes) {
        glb.json()["meshes"].push_back(writer.json_of(mesh));
    }
}

}  // namespace raks::render
