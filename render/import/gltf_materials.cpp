#include "render/import/gltf_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "base/printable.hpp"
#include "render/import/model_images.hpp"
#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostImages = 2'000;
constexpr std::size_t kMostMaterials = 10'000;
constexpr float kAny = 1e6F;  // factors, offsets and scales beyond are no surface

// ---- images

/// The packed bytes of an image. Nothing: it could not be had, and is left out.
std::vector<std::byte> packed_image(const JsonField& field,
                                    GltfBuffers& buffers,
                                    const SideFiles& side,
                                    ImportBudget& budget,
                                    Model& model) {
    const JsonField view = field["bufferView"];
    const JsonField uri = field["uri"];
    if (view.exists()) {
        if (uri.exists()) {
            warn(model, field.line("has both uri and bufferView; bufferView is read"));
        }
        if (!field["mimeType"].exists()) {
            warn(model, field.line("has a bufferView, but no mimeType"));
        }
        const int index = view.index(buffers.view_count());
        if (buffers.view_count() == 0) {
            return {};  // noted
        }
        if (buffers.stride(index) != 0) {
            warn(model,
                 view.line("its bufferView has a byteStride, which is allowed for vertices alone"));
        }
        const auto bytes = buffers.bytes(index, view);
        if (!budget.claim(bytes.size(), 1)) {
            field.complain("the model needs too much memory");
            return {};
        }
        return {bytes.begin(), bytes.end()};
    }
    if (!uri.exists()) {
        field.complain("has neither uri nor bufferView");
        return {};
    }
    const std::string_view where = uri.text();
    auto bytes =
        is_data_uri(where) ? read_data_uri(where, budget.left()) : side.read(where, budget.left());
    if (!bytes || !budget.claim(bytes->size(), 1)) {
        warn(model,
             field.line(fmt::format("left out: {}", bytes ? "too large" : bytes.error().message)));
        return {};
    }
    return std::move(*bytes);
}

constexpr std::array<std::string_view, 3> kMimeTypes = {"image/png", "image/jpeg", "image/webp"};

ModelImage read_image(const JsonField& field,
                      GltfBuffers& buffers,
                      const SideFiles& side,
                      ImportBudget& budget,
                      Model& model) {
    ModelImage image;
    image.name = printable(field["name"].text_or(""), 100);
    image.packed = packed_image(field, buffers, side, budget, model);
    if (image.packed.empty()) {
        return image;
    }
    const auto format = take_size(image);
    if (!format) {
        warn(model, field.line(fmt::format("left out: it {}", format.error().message)));
        return image;
    }
    const JsonField type = field["mimeType"];
    if (type.exists() && type.text() != kMimeTypes[static_cast<std::size_t>(*format)]) {
        warn(model,
             field.line(fmt::format(
                 "says {}, is {}", type.text(), kMimeTypes[static_cast<std::size_t>(*format)])));
    }
    return image;
}

// ---- textures

TextureWrap wrap_of(const JsonField& field) {
    switch (field.whole_or(10497, 0, 100'000)) {
        case 33071:
            return TextureWrap::clamp;
        case 33648:
            return TextureWrap::mirror;
        case 10497:
            return TextureWrap::repeat;
        default:
            field.complain("is not a way to repeat a texture that glTF knows");
            return TextureWrap::repeat;
    }
}

ModelTexture read_sampler(const JsonField& field) {
    ModelTexture sampler;
    sampler.wrap_u = wrap_of(field["wrapS"]);
    sampler.wrap_v = wrap_of(field["wrapT"]);
    sampler.is_smooth = field["magFilter"].whole_or(9729, 9728, 9729) == 9729;
    const std::int64_t far_filter = field["minFilter"].whole_or(9987, 9728, 9987);
    sampler.has_mipmaps = far_filter > 9729;
    return sampler;
}

void read_textures(const JsonField& root, Model& model) {
    std::vector<ModelTexture> samplers;
    for (const JsonField& field : root["samplers"].objects(kMostMaterials)) {
        samplers.push_back(read_sampler(field));
    }
    for (const JsonField& field : root["textures"].objects(kMostMaterials)) {
        const int sampler = field["sampler"].index_or_none(samplers.size());
        ModelTexture texture = sampler >= 0 && !samplers.empty()
                                   ? samplers[static_cast<std::size_t>(sampler)]
                                   : ModelTexture{};
        const JsonField webp = field["extensions"]["EXT_texture_webp"]["source"];
        const JsonField source = webp.exists() ? webp : field["source"];
        texture.image = source.index_or_none(model.images.size());
        if (texture.image < 0) {
            const bool has_other = field["extensions"].size() > 0;
            warn(model,
                 field.line(has_other ? "its only image is of a kind that Raks does not read (PNG, "
                                        "JPEG and WebP are read)"
                                      : "has no image"));
        }
        model.textures.push_back(texture);
    }
}

// ---- materials

float fraction(const JsonField& field, float otherwise, Model& model) {
    const float number = field.number_or(otherwise, -kAny, kAny);
    if (number < 0.0F || number > 1.0F) {
        warn(model, field.line("is not in 0 .. 1"));
    }
    return std::clamp(number, 0.0F, 1.0F);
}

template <std::size_t N>
std::array<float, N> fractions(const JsonField& field,
                               const std::array<float, N>& otherwise,
                               Model& model) {
    std::array<float, N> numbers = field.numbers_or(otherwise);
    for (float& number : numbers) {
        if (number < 0.0F || number > 1.0F) {
            warn(model, field.line("is not in 0 .. 1"));
        }
        number = std::clamp(number, 0.0F, 1.0F);
    }
    return numbers;
}

ModelMaterial read_material(const JsonField& field, Model& model) {
    ModelMaterial material;
    material.name = printable(field["name"].text_or(""), 100);
    const JsonField surface = field["pbrMetallicRoughness"];
    const auto base = fractions<4>(surface["baseColorFactor"], {1.0F, 1.0F, 1.0F, 1.0F}, model);
    material.base_colour = {base[0], base[1], base[2], base[3]};
    material.base_texture = read_texture_use(surface["baseColorTexture"], model);
    material.metallic = fraction(surface["metallicFactor"], 1.0F, model);
    material.roughness = fraction(surface["roughnessFactor"], 1.0F, model);
    material.metallic_roughness_texture =
        read_texture_use(surface["metallicRoughnessTexture"], model);
    const JsonField normal = field["normalTexture"];
    material.normal_texture = read_texture_use(normal, model);
    material.normal_scale = normal["scale"].number_or(1.0F, -kAny, kAny);
    const JsonField occlusion = field["occlusionTexture"];
    material.occlusion_texture = read_texture_use(occlusion, model);
    material.occlusion_strength = fraction(occlusion["strength"], 1.0F, model);
    const auto emissive = fractions<3>(field["emissiveFactor"], {0.0F, 0.0F, 0.0F}, model);
    const float strength =
        field["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"].number_or(
            1.0F, 0.0F, kAny);
    material.emissive = glm::vec3(emissive[0], emissive[1], emissive[2]) * strength;
    material.emissive_texture = read_texture_use(field["emissiveTexture"], model);
    material.alpha_mode =
        static_cast<AlphaMode>(field["alphaMode"].choice_or(0, {"OPAQUE", "MASK", "BLEND"}));
    material.alpha_cutoff = field["alphaCutoff"].number_or(0.5F, 0.0F, kAny);
    material.is_double_sided = field["doubleSided"].truth_or(false);
    material.is_unlit = field["extensions"]["KHR_materials_unlit"].exists();
    return material;
}

}  // namespace

TextureUse read_texture_use(const JsonField& use, Model& model) {
    TextureUse texture;
    if (!use.exists()) {
        return texture;
    }
    texture.texture = use["index"].index(model.textures.size());
    std::int64_t uv_set = use["texCoord"].whole_or(0, 0, 1'000);
    if (const JsonField transform = use["extensions"]["KHR_texture_transform"];
        transform.exists()) {
        const auto offset = transform["offset"].numbers_or<2>({0.0F, 0.0F});
        const auto scale = transform["scale"].numbers_or<2>({1.0F, 1.0F});
        texture.offset = {offset[0], offset[1]};
        texture.scale = {scale[0], scale[1]};
        texture.rotation = transform["rotation"].number_or(0.0F, -kAny, kAny);
        uv_set = transform["texCoord"].whole_or(uv_set, 0, 1'000);
    }
    if (uv_set > 1) {
        warn(model,
             use.line(
                 fmt::format("has texCoord {}, of which 0 and 1 are known; drawn with 0", uv_set)));
        uv_set = 0;
    }
    texture.uv_set = static_cast<int>(uv_set);
    return texture;
}

void read_materials(const JsonField& root,
                    GltfBuffers& buffers,
                    const SideFiles& side,
                    ImportBudget& budget,
                    Model& model) {
    for (const JsonField& field : root["images"].objects(kMostImages)) {
        model.images.push_back(read_image(field, buffers, side, budget, model));
    }
    leave_out_images_beyond_reason(model);
    read_textures(root, model);
    for (const JsonField& field : root["materials"].objects(kMostMaterials)) {
        model.materials.push_back(read_material(field, model));
    }
}

}  // namespace raks::render
