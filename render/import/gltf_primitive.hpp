#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "render/import/gltf_accessors.hpp"
#include "render/import/gltf_meshes.hpp"
#include "render/import/json_field.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Reads primitives of meshes, and counts their vertices against what a model may have.
class PrimitiveReader {
 public:
    /// All must outlive it. `is_quantized`: the file says that it uses KHR_mesh_quantization.
    PrimitiveReader(GltfAccessors& accessors, ImportBudget& budget, Model& model, bool is_quantized)
        : accessors_(accessors), budget_(budget), model_(model), is_quantized_(is_quantized) {}

    /// One primitive; none where it is left out (points, lines, no positions: a warning) or bad (a
    /// fault). `joints`: grows by what it asks of a skin.
    [[nodiscard]] std::optional<ModelPrimitive> read(const JsonField& field, MeshJoints& joints);

 private:
    /// An attribute with the form that it must have; -1: there is none.
    int attribute(const JsonField& attributes,
                  std::string_view name,
                  std::initializer_list<ElementType> elements,
                  std::size_t count);
    void check_component(const GltfAccessor& accessor, std::string_view name);
    void note_names(const JsonField& attributes);
    void note_missing_uv(const JsonField& attributes, const ModelPrimitive& primitive);
    void read_attributes(const JsonField& attributes, ModelPrimitive& primitive);
    void read_normals(const JsonField& attributes, ModelPrimitive& primitive);
    void read_colours(const JsonField& attributes, ModelPrimitive& primitive);
    void read_influences(const JsonField& field, ModelPrimitive& primitive, MeshJoints& joints);
    void read_indices(const JsonField& field, std::int64_t mode, ModelPrimitive& primitive);
    void read_morphs(const JsonField& field,
                     const JsonField& attributes,
                     ModelPrimitive& primitive);
    MorphTarget read_morph(const JsonField& field, std::size_t count);

    GltfAccessors& accessors_;
    ImportBudget& budget_;
    Model& model_;
    bool is_quantized_;
    std::size_t vertices_ = 0;  // so far
};

}  // namespace raks::render
