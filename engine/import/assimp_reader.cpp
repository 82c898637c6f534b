#include "engine/import/assimp_reader.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <string_view>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "engine/import/foreign_text.hpp"
#include "engine/import/memory_files.hpp"
#include "engine/import/scene_parts.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

namespace raks::engine {
namespace {

constexpr std::array kNames = {"model.fbx", "model.dae", "model.obj"};  // by ForeignFormat

// Triangles alone, with normals; indices that assimp itself checks.
constexpr unsigned kSteps = aiProcess_Triangulate | aiProcess_SortByPType |
                            aiProcess_GenSmoothNormals | aiProcess_ValidateDataStructure;

void configure(Assimp::Importer& importer) {
    // Else each pivot of an FBX becomes nodes of its own.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_CAMERAS, false);
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_READ_LIGHTS, false);
    // Else a skeleton without a mesh gets one of pyramids.
    importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                                aiPrimitiveType_POINT | aiPrimitiveType_LINE);
}

/// Whether assimp says that a file contradicts itself, not that assimp does not know how to read
/// it.
bool is_damage(std::string_view line) {
    constexpr std::array kSigns = {"out of range", "orrupted", "nvalid read size", "nflate"};
    return std::any_of(kSigns.begin(), kSigns.end(), [&](const char* sign) {
        return line.find(sign) != std::string_view::npos;
    });
}

/// The line for people where assimp refuses a file that mended_text has found good.
std::string why(const Assimp::Importer& importer, ForeignFormat format) {
    const std::string line = printable(importer.GetErrorString(), 200);
    // Assimp catches it and gives its name; who set the limit has words for it.
    if (line == std::bad_alloc().what()) {
        throw std::bad_alloc();
    }
    if (line.empty()) {
        return "it cannot be read";
    }
    // Of an FBX it is known that nothing is cut off.
    return format == ForeignFormat::fbx && !is_damage(line)
               ? fmt::format(
                     "the file is whole, but assimp, which reads it for raks, cannot ({}): save it "
                     "as GLB, in Blender for example",
                     line)
               : fmt::format("it cannot be read: {}", line);
}

bool has_skeleton(const render::Model& model) {
    constexpr std::size_t kFewest = 3;  // a root, and a bone below another
    return model.nodes.size() >= kFewest;
}

}  // namespace

Expected<render::Model> read_with_assimp(ForeignFormat format,
                                         const std::string& bytes,
                                         const ImportWays& ways) {
    std::vector<std::string> notes;
    auto text = mended_text(format, bytes, notes);
    if (!text) {
        return fail(text.error());
    }
    for (std::string& note : notes) {
        ways.note(std::move(note));
    }
    const char* const name = kNames[static_cast<std::size_t>(format)];
    Assimp::Importer importer;
    configure(importer);
    // The importer owns it.
    importer.SetIOHandler(std::make_unique<MemoryFiles>(name, *text, ways).release());
    const aiScene* const scene = importer.ReadFile(name, kSteps);
    if (scene == nullptr || scene->mRootNode == nullptr) {
        return fail(why(importer, format));
    }
    SceneImport import{*scene, ways, format == ForeignFormat::fbx};
    if (auto done = import_nodes(import); !done) {
        return fail(done.error());
    }
    import_materials(import);
    if (auto done = import_meshes(import); !done) {
        return fail(done.error());
    }
    import_clips(import);
    if (import.model.meshes.empty() && !has_skeleton(import.model)) {
        return fail("neither a mesh nor a skeleton is in it");
    }
    return std::move(import.model);
}

}  // namespace raks::engine
