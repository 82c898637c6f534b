#include "render/import/foreign_model.hpp"

#include <fmt/format.h>

#include <string>

#include "base/talking_child.hpp"
#include "render/import/characters.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/import/import_talk.hpp"
#include "render/import/wanted_files.hpp"

namespace raks::render {
namespace {

constexpr TalkingPart kImporter{.name = "raks-import", .variable = "RAKS_IMPORTER"};

/// For people; empty: glTF.
const char* name_of(std::string_view format) {
    return format == "fbx" ? "FBX" : format == "dae" ? "Collada" : format == "obj" ? "OBJ" : "";
}

}  // namespace

Expected<Model> read_foreign_model(std::string_view format,
                                   std::span<const std::byte> bytes,
                                   const SideFiles& side,
                                   std::chrono::milliseconds longest) {
#ifdef RAKS_WITHOUT_IMPORT
    static_cast<void>(bytes);
    static_cast<void>(side);
    static_cast<void>(longest);
    return fail(
        fmt::format("this build of raks reads no {} (RAKS_IMPORT=OFF); bring it as .glb", format));
#else
    const auto deadline = std::chrono::steady_clock::now() + longest;
    auto child = TalkingChild::start(kImporter, {.arguments = {std::string(format)}});
    if (!child) {
        return fail(child.error());
    }
    WantedFiles wanted(bytes, side);
    Expected<Imported> imported;
    const Talk talk = import_over(child->socket(), bytes, wanted, deadline, imported);
    if (talk != Talk::good) {
        return fail(child->end(talk, longest));
    }
    if (!imported) {
        return fail(imported.error());
    }
    // Of the other formats all is in the glTF: what it names was named by nobody else.
    auto model = read_gltf(std::as_bytes(std::span(imported->glb.data(), imported->glb.size())),
                           format == "draco" ? side : SideFiles());
    if (!model) {
        return fail(fmt::format("read as glTF: {}", model.error().message));
    }
    model->format = name_of(format);
    model->warnings.insert(model->warnings.begin(), imported->notes.begin(), imported->notes.end());
    return model;
#endif
}

bool uses_draco(std::span<const std::byte> gltf) {
    constexpr std::string_view kDraco = "KHR_draco_mesh_compression";
    return characters_of(gltf).find(kDraco) != std::string_view::npos;
}

}  // namespace raks::render
