#include "render/import/gltf_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/printable.hpp"
#include "render/import/gltf_primitive.hpp"
#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostMeshes = 20'000;
constexpr std::size_t kMostPrimitives = 20'000;
constexpr std::size_t kMostMorphNames = 5'000;

/// Names that exporters agreed on: extras.targetNames of the mesh or of its first primitive.
std::vector<std::string> morph_names(const JsonField& mesh, const JsonField& primitive) {
    std::vector<std::string> names;
    for (const JsonField& owner : {mesh, primitive}) {
        const JsonField list = owner["extras"]["targetNames"];
        if (!list.is_array()) {
            continue;
        }
        for (const JsonField& name : list.items(kMostMorphNames)) {
            names.push_back(name.is_text() ? printable(name.text(), 100) : std::string());
        }
        break;
    }
    return names;
}

/// As many morph targets in each primitive, and as many names and weights.
void even_out(ModelMesh& mesh, const JsonField& field, Model& model) {
    std::size_t count = 0;
    for (const ModelPrimitive& primitive : mesh.primitives) {
        count = std::max(count, primitive.morphs.size());
    }
    for (ModelPrimitive& primitive : mesh.primitives) {
        if (primitive.morphs.size() != count) {
            warn(model, field.line("its primitives have unequal numbers of morph targets"));
            primitive.morphs.resize(count);
        }
    }
    if (!mesh.morph_weights.empty() && mesh.morph_weights.size() != count) {
        warn(model,
             field.line(fmt::format(
                 "has {} weights for {} morph targets", mesh.morph_weights.size(), count)));
    }
    mesh.morph_weights.resize(count, 0.0F);
    mesh.morph_names.resize(count);
}

ModelMesh read_mesh(const JsonField& field,
                    PrimitiveReader& reader,
                    MeshJoints& joints,
                    Model& model) {
    ModelMesh mesh;
    mesh.name = printable(field["name"].text_or(""), 100);
    const std::vector<JsonField> primitives = field["primitives"].objects(kMostPrimitives);
    if (primitives.empty()) {
        field.complain("has no primitives");
        return mesh;
    }
    for (const JsonField& primitive : primitives) {
        if (auto read = reader.read(primitive, joints)) {
            mesh.primitives.push_back(std::move(*read));
        }
    }
    mesh.morph_names = morph_names(field, primitives.front());
    mesh.morph_weights = field["weights"].numbers(kMostMorphNames);
    even_out(mesh, field, model);
    return mesh;
}

}  // namespace

std::vector<MeshJoints> read_meshes(const JsonField& root,
                                    GltfAccessors& accessors,
                                    ImportBudget& budget,
                                    Model& model) {
    std::vector<MeshJoints> joints;
    bool is_quantized = false;
    for (const JsonField& name : root["extensionsUsed"].items()) {
        is_quantized = is_quantized || name.text() == "KHR_mesh_quantization";
    }
    PrimitiveReader reader(accessors, budget, model, is_quantized);
    for (const JsonField& field : root["meshes"].objects(kMostMeshes)) {
        joints.emplace_back();
        model.meshes.push_back(read_mesh(field, reader, joints.back(), model));
    }
    return joints;
}

}  // namespace raks::render
