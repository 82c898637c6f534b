#include "render/import/gltf_reader.hpp"

#include <fmt/format.h>

#include <functional>
#include <vector>

#include "render/import/gltf_accessors.hpp"
#include "render/import/gltf_animations.hpp"
#include "render/import/gltf_buffers.hpp"
#include "render/import/gltf_file.hpp"
#include "render/import/gltf_materials.hpp"
#include "render/import/gltf_meshes.hpp"
#include "render/import/gltf_nodes.hpp"
#include "render/import/json_field.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/vrm.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kBytesPerJson = 14;  // that the parser takes for a byte of JSON at most

/// What is left for the model's own arrays.
std::size_t bytes_for_model(std::span<const std::byte> bytes, const GltfFile& file) {
    const std::size_t taken = bytes.size() + kBytesPerJson * file.json_bytes;
    return taken < kMostModelBytes ? kMostModelBytes - taken : 0;
}

/// What the file has and Raks does not show.
void note_left_out(const JsonField& root, Model& model) {
    if (const std::size_t cameras = root["cameras"].size(); root["cameras"].exists()) {
        warn(model, fmt::format("{} cameras are left out", cameras));
    }
    for (const std::string_view list : {"accessors",
                                        "animations",
                                        "buffers",
                                        "bufferViews",
                                        "images",
                                        "materials",
                                        "meshes",
                                        "nodes",
                                        "samplers",
                                        "scenes",
                                        "skins",
                                        "textures"}) {
        if (root[list].is_array() && root[list].size() == 0) {
            warn(model, root[list].line("is an empty list"));
        }
    }
    if (model.meshes.empty() && model.animations.empty()) {
        warn(model, "there is nothing in it to draw");
    }
}

/// Reads part after part, each of which may take those before it for good.
Expected<void> read_parts(const GltfFile& file,
                          const SideFiles& side,
                          const JsonField& root,
                          const JsonFaults& faults,
                          ImportBudget budget,
                          Model& model) {
    GltfBuffers buffers(file, side, root, budget, model);
    if (faults.any()) {
        return faults.finish();
    }
    GltfAccessors accessors(root, buffers, budget, model);
    std::vector<MeshJoints> joints;
    const std::function<void()> parts[] = {
        [&] { read_materials(root, buffers, side, budget, model); },
        [&] { joints = read_meshes(root, accessors, budget, model); },
        [&] { read_nodes(root, root["skins"].size(), model); },
        [&] { read_skins(root, accessors, joints, model); },
        [&] { read_animations(root, accessors, model); },
        [&] { accessors.check_unread(); },
        [&] { buffers.check_unread(); },
        [&] { note_left_out(root, model); },
    };
    for (const auto& read_part : parts) {
        if (faults.any()) {
            break;
        }
        read_part();
    }
    return faults.finish();
}

}  // namespace

Expected<Model> read_gltf(std::span<const std::byte> bytes, const SideFiles& side) {
    Model model;
    const auto file = open_gltf(bytes, model);
    if (!file) {
        return fail(file.error());
    }
    JsonFaults faults;
    const JsonField root = file->json.root(faults);
    check_gltf_needs(root, model);
    if (const auto good = faults.finish(); !good) {
        return fail(good.error());
    }
    if (const auto good = read_parts(
            *file, side, root, faults, ImportBudget(bytes_for_model(bytes, *file)), model);
        !good) {
        return fail(good.error());
    }
    model.animated_face.is_vrma = root["extensions"]["VRMC_vrm_animation"].exists();
    if (const auto good = read_character(root, model); !good) {
        return fail(good.error());
    }
    if (const auto good = faults.finish(); !good) {
        return fail(good.error());
    }
    return model;
}

}  // namespace raks::render
