#include "render/import/model_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "render/import/face_morphs.hpp"
#include "render/import/foreign_model.hpp"
#include "render/import/gltf_reader.hpp"
#include "render/import/tds_reader.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20U;  // bytes

/// A kind of model file.
struct Format {
    std::string_view ending;
    Expected<Model> (*read)(std::span<const std::byte>, const SideFiles&);
};

Expected<Model> read_any_gltf(std::span<const std::byte> bytes, const SideFiles& side) {
    return uses_draco(bytes) ? read_foreign_model("draco", bytes, side) : read_gltf(bytes, side);
}

Expected<Model> read_fbx(std::span<const std::byte> bytes, const SideFiles& side) {
    return read_foreign_model("fbx", bytes, side);
}

Expected<Model> read_collada(std::span<const std::byte> bytes, const SideFiles& side) {
    return read_foreign_model("dae", bytes, side);
}

Expected<Model> read_obj(std::span<const std::byte> bytes, const SideFiles& side) {
    return read_foreign_model("obj", bytes, side);
}

constexpr std::array<Format, 8> kFormats = {{
    {".glb", read_any_gltf},
    {".gltf", read_any_gltf},
    {".vrm", read_any_gltf},
    {".vrma", read_gltf},
    {".3ds", read_tds},
    {".fbx", read_fbx},
    {".dae", read_collada},
    {".obj", read_obj},
}};

/// ".glb, .gltf and .obj".
std::string known_endings() {
    std::string list;
    for (std::size_t i = 0; i < kFormats.size(); ++i) {
        list += i == 0 ? "" : i + 1 == kFormats.size() ? " and " : ", ";
        list += kFormats[i].ending;
    }
    return list;
}

std::string ending_in_small(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return ending;
}

// Why a file is none that is read, and what to do where something can be done.
std::string refusal_of_name(const std::filesystem::path& path) {
    const std::string ending = ending_in_small(path);
    if (ending == ".pmx" || ending == ".pmd") {
        return "is a model of MikuMikuDance, which Raks does not read; convert it to VRM, in "
               "Blender with MMD Tools and the VRM add-on";
    }
    return fmt::format("is not a model that Raks reads; it reads {}", known_endings());
}

const Format* format_of(const std::filesystem::path& path) {
    const std::string ending = ending_in_small(path);
    const auto* const found =
        std::find_if(kFormats.begin(), kFormats.end(), [&](const Format& format) {
            return format.ending == ending;
        });
    return found != kFormats.end() ? found : nullptr;
}

}  // namespace

std::vector<std::string_view> model_endings() {
    std::vector<std::string_view> endings;
    endings.reserve(kFormats.size());
    for (const Format& format : kFormats) {
        endings.push_back(format.ending);
    }
    return endings;
}

bool is_model_name(const std::filesystem::path& path) { return format_of(path) != nullptr; }

Expected<Model> read_model(std::span<const std::byte> bytes,
                           std::string_view name,
                           const SideFiles& side) {
    const Format* const format = format_of(name);
    if (format == nullptr) {
        return fail(refusal_of_name(name));
    }
    auto model = format->read(bytes, side);
    if (model) {
        model->name = printable(std::filesystem::path(name).stem().string(), 100);
        if (!model->animated_face.is_vrma) {
            add_face_morphs(*model);
        }
    }
    return model;
}

Expected<Model> load_model(const std::filesystem::path& path) {
    const std::string shown = printable(path.string());
    if (!is_model_name(path)) {
        return fail(shown + ": " + refusal_of_name(path));
    }
    const auto file = read_file(path, kLargestFile);
    if (!file) {
        return fail(file.error());
    }
    const SideFiles side(path.parent_path());
    auto model = read_model(
        std::as_bytes(std::span(file->data(), file->size())), path.filename().string(), side);
    if (!model) {
        return fail(Error(model.error()).in(shown));
    }
    return model;
}

}  // namespace raks::render
