// Materials of VRM 0.x: the shader's Unity properties, brought onto MToon 1.0 and glTF as UniVRM's
// migration does (vrm-c/UniVRM, VRM10/Runtime/Migration/Materials). Where it differs from pixiv's
// three-vrm (outlines by the screen, the rim's light, rotation of textures), UniVRM is followed,
// which defines the format.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <set>
#include <string_view>
#include <vector>

#include "base/printable.hpp"
#include "render/import/lenient.hpp"
#include "render/import/srgb.hpp"
#include "render/import/vrm_parts.hpp"

#include <glm/common.hpp>

namespace raks::render {
namespace {

constexpr std::string_view kToonShader = "VRM/MToon";
constexpr std::string_view kZWriteShader = "VRM/UnlitTransparentZWrite";

enum class BlendMode : std::uint8_t { opaque, cutout, transparent, transparent_z_write };

/// The properties of one material, with the defaults of MToon's shader.
class Properties {
 public:
    Properties(const JsonField& from, Model& model)
        : floats_(from["floatProperties"]),
          vectors_(from["vectorProperties"]),
          textures_(from["textureProperties"]),
          keywords_(from["keywordMap"]),
          shader_(from["shader"].is_text() ? from["shader"].text() : std::string_view()),
          queue_(from["renderQueue"]),
          model_(model) {}

    [[nodiscard]] std::string_view shader() const { return shader_; }

    [[nodiscard]] float number(std::string_view name, NumberLimits limits) const {
        return lenient_number(floats_[name], limits, model_);
    }

    /// Four numbers 0 to 1000, as they stand.
    [[nodiscard]] glm::vec4 vector(std::string_view name, const glm::vec4& otherwise) const {
        glm::vec4 vector = otherwise;
        const bool is_good = read_part(vectors_[name], model_, [&](const JsonField& field) {
            const std::vector<float> numbers = field.numbers(4);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                vector[static_cast<int>(i)] = std::clamp(numbers[i], -1000.0F, 1000.0F);
            }
        });
        return is_good ? vector : otherwise;
    }

    /// A colour, from sRGB.
    [[nodiscard]] glm::vec4 colour(std::string_view name, const glm::vec4& otherwise) const {
        return linear_from_srgb(glm::max(vector(name, otherwise), glm::vec4(0.0F)));
    }

    /// A texture, moved and scaled as all textures of the material are but the matcap.
    [[nodiscard]] TextureUse texture(std::string_view name) const {
        TextureUse use = plain_texture(name);
        if (use.texture >= 0) {
            // Unity: offset x, y, scale x, y, with the origin at the lower left corner.
            const glm::vec4 st = vector("_MainTex", {0.0F, 0.0F, 1.0F, 1.0F});
            use.scale = {st.z, st.w};
            use.offset = {st.x, 1.0F - st.y - st.w};
        }
        return use;
    }

    [[nodiscard]] TextureUse plain_texture(std::string_view name) const {
        TextureUse use;
        const bool is_good = read_part(textures_[name], model_, [&](const JsonField& field) {
            use.texture = field.index_or_none(model_.textures.size());
        });
        return is_good ? use : TextureUse();
    }

    [[nodiscard]] BlendMode blend_mode() const {
        if (shader_ == kZWriteShader) {
            return BlendMode::transparent_z_write;
        }
        if (floats_["_BlendMode"].is_number()) {
            return static_cast<BlendMode>(number("_BlendMode", {0.0F, 3.0F, 0.0F}));
        }
        if (lenient_truth(keywords_["_ALPHABLEND_ON"], false, model_)) {
            return number("_ZWrite", {0.0F, 1.0F, 0.0F}) > 0.0F ? BlendMode::transparent_z_write
                                                                : BlendMode::transparent;
        }
        return lenient_truth(keywords_["_ALPHATEST_ON"], false, model_) ? BlendMode::cutout
                                                                        : BlendMode::opaque;
    }

    /// Unity's number for the order of drawing; the mode's own where it says -1.
    [[nodiscard]] int render_queue() const {
        const float queue = lenient_number(queue_, {-1.0F, 5000.0F, -1.0F}, model_);
        const float usual = blend_mode() == BlendMode::transparent_z_write ? 2501.0F : 3000.0F;
        return static_cast<int>(queue < 0.0F ? usual : queue);
    }

 private:
    JsonField floats_;
    JsonField vectors_;
    JsonField textures_;
    JsonField keywords_;
    std::string_view shader_;
    JsonField queue_;
    Model& model_;
};

/// Unity's numbers of all blended materials, from which MToon 1.0's -9..9 are made: their order
/// stays, each of the two kinds for itself.
class RenderQueues {
 public:
    void add(const Properties& from) {
        if (from.blend_mode() == BlendMode::transparent) {
            plain_.insert(from.render_queue());
        } else if (from.blend_mode() == BlendMode::transparent_z_write) {
            z_write_.insert(from.render_queue());
        }
    }

    [[nodiscard]] int offset_of(const Properties& from) const {
        const int queue = from.render_queue();
        if (from.blend_mode() == BlendMode::transparent) {
            return std::max(-9,
                            -static_cast<int>(std::distance(plain_.find(queue), plain_.end()) - 1));
        }
        if (from.blend_mode() == BlendMode::transparent_z_write) {
            return std::min(
                9, static_cast<int>(std::distance(z_write_.begin(), z_write_.find(queue))));
        }
        return 0;
    }

 private:
    std::set<int> plain_;
    std::set<int> z_write_;
};

void set_alpha(const Properties& from, ModelMaterial& material) {
    constexpr std::array<AlphaMode, 4> kModes = {
        AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend, AlphaMode::blend};
    const BlendMode mode = from.blend_mode();
    material.alpha_mode = kModes[static_cast<std::size_t>(mode)];
    material.alpha_cutoff =
        mode == BlendMode::cutout ? from.number("_Cutoff", {0.0F, 1.0F, 0.5F}) : 0.5F;
}

/// The band between light and shade: 0.x says where it begins and how sharp it is, 1.0 its middle
/// and its margin.
void set_band(const Properties& from, MToon& toon) {
    const float begin = from.number("_ShadeShift", {-1.0F, 1.0F, 0.0F});
    const float sharpness = from.number("_ShadeToony", {0.0F, 1.0F, 0.9F});
    const float end = 1.0F + (begin - 1.0F) * sharpness;
    toon.shading_toony = std::clamp((2.0F - (end - begin)) / 2.0F, 0.0F, 1.0F);
    toon.shading_shift = std::clamp(-(end + begin) / 2.0F, -1.0F, 1.0F);
    toon.gi_equalization = 1.0F - from.number("_IndirectLightIntensity", {0.0F, 1.0F, 0.1F});
}

void set_rim(const Properties& from, MToon& toon) {
    toon.matcap_texture = from.plain_texture("_SphereAdd");
    toon.matcap_factor = glm::vec3(toon.matcap_texture.texture >= 0 ? 1.0F : 0.0F);
    toon.rim_colour = from.colour("_RimColor", {0.0F, 0.0F, 0.0F, 1.0F});
    toon.rim_texture = from.texture("_RimTexture");
    toon.rim_fresnel_power = from.number("_RimFresnelPower", {0.0F, 1000.0F, 1.0F});
    toon.rim_lift = from.number("_RimLift", {-1000.0F, 1000.0F, 0.0F});
    toon.rim_lighting_mix = 1.0F;  // one with the matcap in 1.0: lit, whatever 0.x says
}

void set_outline(const Properties& from, MToon& toon) {
    // Centimetres; on the screen per cent of half its height.
    constexpr std::array<float, 3> kUnits = {0.0F, 0.01F, 0.005F};
    const auto mode =
        static_cast<std::size_t>(from.number("_OutlineWidthMode", {0.0F, 2.0F, 0.0F}));
    toon.outline_mode = static_cast<OutlineWidth>(mode);
    toon.outline_width = from.number("_OutlineWidth", {0.0F, 1000.0F, 0.5F}) * kUnits[mode];
    toon.outline_width_texture = from.texture("_OutlineWidthTexture");
    toon.outline_colour = from.colour("_OutlineColor", {0.0F, 0.0F, 0.0F, 1.0F});
    const bool is_mixed = from.number("_OutlineColorMode", {0.0F, 1.0F, 0.0F}) >= 1.0F;
    toon.outline_lighting_mix =
        is_mixed ? from.number("_OutlineLightingMix", {0.0F, 1.0F, 1.0F}) : 0.0F;
}

void set_uv_animation(const Properties& from, MToon& toon) {
    constexpr NumberLimits kScroll{-1000.0F, 1000.0F, 0.0F};
    toon.uv_mask_texture = from.texture("_UvAnimMaskTexture");
    toon.uv_scroll_speed = {from.number("_UvAnimScrollX", kScroll),
                            -from.number("_UvAnimScrollY", kScroll)};  // v runs down in glTF
    toon.uv_rotation_speed =
        from.number("_UvAnimRotation", kScroll) * 2.0F * std::numbers::pi_v<float>;
}

void set_toon(const Properties& from, const RenderQueues& queues, ModelMaterial& material) {
    set_alpha(from, material);
    // Unity's 2 hides back faces; of front faces hidden (1) glTF knows nothing.
    material.is_double_sided = from.number("_CullMode", {0.0F, 2.0F, 2.0F}) < 2.0F;
    material.base_colour = from.colour("_Color", glm::vec4(1.0F));
    material.base_texture = from.texture("_MainTex");
    material.normal_texture = from.texture("_BumpMap");
    material.normal_scale = from.number("_BumpScale", {-1000.0F, 1000.0F, 1.0F});
    material.emissive = glm::max(from.vector("_EmissionColor", {0, 0, 0, 1}), glm::vec4(0.0F));
    material.emissive_texture = from.texture("_EmissionMap");
    MToon toon;
    toon.transparent_with_z_write = from.blend_mode() == BlendMode::transparent_z_write;
    toon.render_queue_offset = queues.offset_of(from);
    toon.shade_colour = from.colour("_ShadeColor", {0.97F, 0.81F, 0.86F, 1.0F});
    toon.shade_texture = from.texture("_ShadeTexture");
    if (toon.shade_texture.texture < 0) {
        toon.shade_texture = material.base_texture;  // makers rely on it, UniVRM found
    }
    set_band(from, toon);
    set_rim(from, toon);
    set_outline(from, toon);
    set_uv_animation(from, toon);
    material.mtoon = toon;
}

/// Unlit and blended but with depth: all of its colour becomes emission of a black MToon.
void set_unlit_z_write(const Properties& from,
                       const RenderQueues& queues,
                       ModelMaterial& material) {
    set_alpha(from, material);
    const glm::vec4 colour = from.colour("_Color", glm::vec4(1.0F));
    material.base_colour = {0.0F, 0.0F, 0.0F, colour.w};
    material.base_texture = from.texture("_MainTex");
    material.emissive = colour;
    material.emissive_texture = material.base_texture;
    MToon toon;
    toon.transparent_with_z_write = true;
    toon.render_queue_offset = queues.offset_of(from);
    material.mtoon = toon;
}

/// An unlit shader of before KHR_materials_unlit; false: it is none.
bool set_unlit(const Properties& from, ModelMaterial& material) {
    struct UnlitShader {
        std::string_view name;
        AlphaMode mode;
        bool has_texture;
    };
    static constexpr std::array<UnlitShader, 7> kShaders = {{
        {"Unlit/Color", AlphaMode::opaque, false},
        {"Unlit/Texture", AlphaMode::opaque, true},
        {"Unlit/Transparent", AlphaMode::blend, true},
        {"Unlit/Transparent Cutout", AlphaMode::mask, true},
        {"VRM/UnlitTexture", AlphaMode::opaque, true},
        {"VRM/UnlitTransparent", AlphaMode::blend, true},
        {"VRM/UnlitCutout", AlphaMode::mask, true},
    }};
    const auto* const found =
        std::find_if(kShaders.begin(), kShaders.end(), [&](const UnlitShader& shader) {
            return shader.name == from.shader();
        });
    if (found == kShaders.end()) {
        return false;
    }
    material.is_unlit = true;
    material.alpha_mode = found->mode;
    material.alpha_cutoff = from.number("_Cutoff", {0.0F, 1.0F, 0.5F});
    material.base_colour =
        found->has_texture ? glm::vec4(1.0F) : from.colour("_Color", glm::vec4(1.0F));
    material.base_texture = found->has_texture ? from.texture("_MainTex") : TextureUse();
    return true;
}

/// Whether glTF's own description holds for a shader.
bool is_as_gltf_says(std::string_view shader) {
    return shader.empty() || shader == "VRM_USE_GLTFSHADER" || shader == "Standard" ||
           shader == "UniGLTF/UniUnlit";
}

void set_material(const JsonField& at,
                  const Properties& from,
                  const RenderQueues& queues,
                  ModelMaterial& material,
                  Model& model) {
    if (from.shader() == kToonShader) {
        set_toon(from, queues, material);
    } else if (from.shader() == kZWriteShader) {
        set_unlit_z_write(from, queues, material);
    } else if (!set_unlit(from, material) && !is_as_gltf_says(from.shader())) {
        warn(model,
             at.line(fmt::format("the shader \"{}\" is not known; drawn by its glTF material",
                                 printable(from.shader(), 60))));
    }
}

}  // namespace

void read_materials0(const JsonField& properties, Model& model) {
    std::vector<JsonField> all;
    JsonFaults faults;
    all = properties.noting_to(faults, "VRM.materialProperties").items();
    if (const Expected<void> read = faults.finish(); !read) {
        warn(model, read.error().message + "; materials are drawn as glTF says");
    }
    const std::size_t count = std::min(all.size(), model.materials.size());
    RenderQueues queues;
    for (std::size_t i = 0; i < count; ++i) {
        queues.add(Properties(all[i], model));
    }
    for (std::size_t i = 0; i < count; ++i) {
        ModelMaterial material = model.materials[i];
        set_material(all[i], Properties(all[i], model), queues, material, model);
        model.materials[i] = std::move(material);
    }
}

}  // namespace raks::render
