#include <algorithm>
#include <string_view>

#include "render/export/glb_parts.hpp"

namespace raks::render {
namespace {

constexpr std::string_view kWebp = "EXT_texture_webp";

/// What the first bytes of a packed image show.
std::string_view mime_type(const ModelImage& image) {
    const auto starts_with = [&](std::string_view start, std::size_t at) {
        return image.packed.size() >= at + start.size() &&
               std::equal(start.begin(),
                          start.end(),
                          image.packed.begin() + std::ptrdiff_t(at),
                          [](char a, std::byte b) { return std::byte(a) == b; });
    };
    if (starts_with("WEBP", 8)) {
        return "image/webp";
    }
    return starts_with("\x89PNG", 0) ? "image/png" : "image/jpeg";
}

void add_images(const Model& model, GlbDocument& glb, std::vector<int>& places) {
    for (const ModelImage& image : model.images) {
        Json& images = glb.json()["images"];
        places.push_back(image.packed.empty() ? -1 : static_cast<int>(images.size()));
        if (image.packed.empty()) {
            continue;
        }
        Json json = Json::object();
        if (!image.name.empty()) {
            json["name"] = image.name;
        }
        json["mimeType"] = mime_type(image);
        json["bufferView"] = glb.add_view(image.packed);
        images.push_back(std::move(json));
    }
    if (glb.json()["images"].empty()) {
        glb.json().erase("images");
    }
}

int wrap_of(TextureWrap wrap) {
    constexpr std::array kWraps = {10497, 33648, 33071};
    return kWraps[static_cast<std::size_t>(wrap)];
}

Json sampler_of(const ModelTexture& texture) {
    constexpr int kNearest = 9728;
    constexpr int kLinear = 9729;
    constexpr int kSharpFar = 9984;   // nearest, in the nearest smaller copy
    constexpr int kSmoothFar = 9987;  // linear, between two smaller copies
    const int near_filter = texture.is_smooth ? kLinear : kNearest;
    const int far_filter = texture.is_smooth ? kSmoothFar : kSharpFar;
    return {{"magFilter", near_filter},
            {"minFilter", texture.has_mipmaps ? far_filter : near_filter},
            {"wrapS", wrap_of(texture.wrap_u)},
            {"wrapT", wrap_of(texture.wrap_v)}};
}

void add_textures(const Model& model, const std::vector<int>& images, GlbDocument& glb) {
    Json& json = glb.json();
    for (const ModelTexture& texture : model.textures) {
        Json& samplers = json["samplers"];
        const Json sampler = sampler_of(texture);
        const auto same = std::find(samplers.begin(), samplers.end(), sampler);
        Json entry = {{"sampler", same - samplers.begin()}};
        if (same == samplers.end()) {
            samplers.push_back(sampler);
        }
        const int image = texture.image < 0 ? -1 : images[static_cast<std::size_t>(texture.image)];
        const bool is_webp =
            image >= 0 &&
            mime_type(model.images[static_cast<std::size_t>(texture.image)]) == "image/webp";
        if (is_webp) {
            glb.use_extension(kWebp);
            entry["extensions"][std::string(kWebp)] = {{"source", image}};
        } else if (image >= 0) {
            entry["source"] = image;
        }
        json["textures"].push_back(std::move(entry));
    }
}

Json surface_of(const ModelMaterial& material, GlbDocument& glb) {
    Json json = Json::object();
    if (material.base_colour != glm::vec4(1.0F)) {
        json["baseColorFactor"] = numbers_of(material.base_colour);
    }
    put_texture(material.base_texture, "baseColorTexture", glb, json);
    json["metallicFactor"] = material.metallic;
    json["roughnessFactor"] = material.roughness;
    put_texture(material.metallic_roughness_texture, "metallicRoughnessTexture", glb, json);
    return json;
}

void put_emission(const ModelMaterial& material, GlbDocument& glb, Json& json) {
    put_texture(material.emissive_texture, "emissiveTexture", glb, json);
    const glm::vec3& light = material.emissive;
    const float strength = std::max({light.x, light.y, light.z, 1.0F});
    if (light != glm::vec3(0.0F)) {
        json["emissiveFactor"] = numbers_of(light / strength);
    }
    if (strength > 1.0F) {
        glb.use_extension("KHR_materials_emissive_strength");
        json["extensions"]["KHR_materials_emissive_strength"] = {{"emissiveStrength", strength}};
    }
}

Json material_json(const ModelMaterial& material, GlbDocument& glb) {
    Json json = Json::object();
    if (!material.name.empty()) {
        json["name"] = material.name;
    }
    json["pbrMetallicRoughness"] = surface_of(material, glb);
    put_texture(material.normal_texture, "normalTexture", glb, json);
    if (material.normal_texture.texture >= 0 && material.normal_scale != 1.0F) {
        json["normalTexture"]["scale"] = material.normal_scale;
    }
    put_texture(material.occlusion_texture, "occlusionTexture", glb, json);
    if (material.occlusion_texture.texture >= 0 && material.occlusion_strength != 1.0F) {
        json["occlusionTexture"]["strength"] = material.occlusion_strength;
    }
    put_emission(material, glb, json);
    if (material.alpha_mode != AlphaMode::opaque) {
        json["alphaMode"] = material.alpha_mode == AlphaMode::mask ? "MASK" : "BLEND";
    }
    if (material.alpha_mode == AlphaMode::mask) {
        json["alphaCutoff"] = material.alpha_cutoff;
    }
    if (material.is_double_sided) {
        json["doubleSided"] = true;
    }
    if (material.is_unlit) {
        glb.use_extension("KHR_materials_unlit");
        json["extensions"]["KHR_materials_unlit"] = Json::object();
    }
    return json;
}

}  // namespace

void put_texture(const TextureUse& use, const char* name, GlbDocument& glb, Json& json) {
    if (use.texture >= 0) {
        json[name] = texture_info(use, glb);
    }
}

Json texture_info(const TextureUse& use, GlbDocument& glb) {
    Json json = {{"index", use.texture}};
    if (use.uv_set != 0) {
        json["texCoord"] = use.uv_set;
    }
    if (use.offset == glm::vec2(0.0F) && use.scale == glm::vec2(1.0F) && use.rotation == 0.0F) {
        return json;
    }
    glb.use_extension("KHR_texture_transform");
    json["extensions"]["KHR_texture_transform"] = {{"offset", numbers_of(use.offset)},
                                                   {"rotation", use.rotation},
                                                   {"scale", numbers_of(use.scale)}};
    return json;
}

void add_materials(const Model& model, GlbDocument& glb) {
    std::vector<int> images;
    add_images(model, glb, images);
    add_textures(model, images, glb);
    for (const ModelMaterial& material : model.materials) {
        glb.json()["materials"].push_back(material_json(material, glb));
    }
}

}  // namespace raks::render
