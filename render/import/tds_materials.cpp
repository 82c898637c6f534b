#include "render/import/tds_materials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "render/import/model_images.hpp"
#include "render/import/model_warnings.hpp"
#include "render/import/plain_picture.hpp"
#include "render/import/srgb.hpp"

#include <glm/common.hpp>

namespace raks::render {
namespace {

constexpr std::uint16_t kTdsColourFloats = 0x0010;
constexpr std::uint16_t kTdsColourBytes = 0x0011;
constexpr std::uint16_t kTdsPercentWhole = 0x0030;
constexpr std::uint16_t kTdsPercentFloat = 0x0031;
constexpr std::uint16_t kTdsMaterialName = 0xA000;
constexpr std::uint16_t kTdsDiffuse = 0xA020;
constexpr std::uint16_t kTdsShininess = 0xA040;
constexpr std::uint16_t kTdsShineStrength = 0xA041;
constexpr std::uint16_t kTdsTransparency = 0xA050;
constexpr std::uint16_t kTdsTwoSided = 0xA081;
constexpr std::uint16_t kTdsSelfLight = 0xA084;
constexpr std::uint16_t kTdsTexture = 0xA200;
constexpr std::uint16_t kTdsTextureFile = 0xA300;
constexpr std::uint16_t kTdsTextureFlags = 0xA351;
constexpr std::uint16_t kTdsTextureScaleU = 0xA354;
constexpr std::uint16_t kTdsTextureScaleV = 0xA356;
constexpr std::uint16_t kTdsTextureOffsetU = 0xA358;
constexpr std::uint16_t kTdsTextureOffsetV = 0xA35A;
constexpr unsigned kTdsTextureMirrors = 0x02;
constexpr unsigned kTdsTextureStands = 0x10;  // it is not repeated

/// The first colour within a chunk: programs write a corrected one behind it.
glm::vec3 read_colour(TdsChunk& chunk, const glm::vec3& otherwise) {
    while (auto part = chunk.next()) {
        if (part->id() == kTdsColourFloats) {
            return glm::clamp(part->vector3(), 0.0F, 1.0F);
        }
        if (part->id() == kTdsColourBytes) {
            const auto red = static_cast<float>(part->u8());
            const auto green = static_cast<float>(part->u8());
            return glm::vec3(red, green, static_cast<float>(part->u8())) / 255.0F;
        }
    }
    return otherwise;
}

/// A share, 0..1, that stands in a chunk or within it.
float share_in(TdsChunk& part, float otherwise) {
    if (part.id() == kTdsPercentWhole) {
        return std::clamp(static_cast<float>(part.u16()) / 100.0F, 0.0F, 1.0F);
    }
    if (part.id() == kTdsPercentFloat) {
        return std::clamp(part.number(), 0.0F, 1.0F);
    }
    return otherwise;
}

float read_share(TdsChunk& chunk) {
    float share = 0.0F;
    while (auto part = chunk.next()) {
        share = share_in(*part, share);
    }
    return share;
}

void read_texture(TdsChunk& chunk, TdsMaterial& material) {
    while (auto part = chunk.next()) {
        switch (part->id()) {
            case kTdsTextureFile:
                material.texture = part->text();
                break;
            case kTdsTextureFlags: {
                const unsigned flags = part->u16();
                material.is_tiled = (flags & kTdsTextureStands) == 0;
                material.is_mirrored = (flags & kTdsTextureMirrors) != 0;
                break;
            }
            case kTdsTextureScaleU:
                material.uv_scale.x = part->number();
                break;
            case kTdsTextureScaleV:
                material.uv_scale.y = part->number();
                break;
            case kTdsTextureOffsetU:
                material.uv_offset.x = part->number();
                break;
            case kTdsTextureOffsetV:
                material.uv_offset.y = part->number();
                break;
            default:
                material.texture_strength = share_in(*part, material.texture_strength);
                break;
        }
    }
}

/// The maps that are not drawn: a second colour, opacity, bumps, shine, reflections, their masks.
bool is_other_texture(std::uint16_t id) {
    return (id > kTdsTexture && id <= 0xA230 && id % 16 == 0) || id == 0xA33A || id == 0xA33C ||
           id == 0xA33D;
}

// ---- into the model

/// The name behind the last folder, as SideFiles wants it.
std::string uri_of(const std::string& path) {
    const std::size_t folder = path.find_last_of("/\\:");
    const std::string_view name =
        std::string_view(path).substr(folder == std::string::npos ? 0 : folder + 1);
    std::string uri;
    for (const char c : name) {
        uri += c == '%' ? std::string("%25") : std::string(1, c);
    }
    return uri;
}

std::string in_small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return text;
}

/// Brings materials into a model.
class MaterialAdder {
 public:
    MaterialAdder(const SideFiles& side, ImportBudget& budget, Model& model)
        : side_(side), budget_(budget), model_(model) {}

    void add(const TdsMaterial& from) {
        ModelMaterial material;
        material.name = printable(from.name, 100);
        material.metallic = 0.0F;
        material.roughness = 1.0F - 0.6F * from.shininess * from.shine_strength;
        material.is_double_sided = from.is_two_sided;
        glm::vec3 colour = from.diffuse;
        if (!from.texture.empty()) {
            material.base_texture = use_of(from);
            if (material.base_texture.texture >= 0) {
                // The picture takes the colour's place, as far as it is strong.
                colour = glm::mix(from.diffuse, glm::vec3(1.0F), from.texture_strength);
            }
        }
        material.base_colour = linear_from_srgb(glm::vec4(colour, 1.0F - from.transparency));
        material.emissive = from.self_light * glm::vec3(material.base_colour);
        constexpr float kSeenThrough = 0.004F;  // less is rounding
        material.alpha_mode =
            from.transparency > kSeenThrough ? AlphaMode::blend : AlphaMode::opaque;
        if (from.other_textures > 0) {
            warn(model_,
                 fmt::format("material \"{}\": {} textures are left out; only the one of its "
                             "colour is drawn",
                             material.name,
                             from.other_textures));
        }
        model_.materials.push_back(std::move(material));
    }

 private:
    /// The picture of a name; -1: it cannot be had.
    int image_of(const std::string& texture) {
        const std::string uri = uri_of(texture);
        const auto [known, is_new] = images_.try_emplace(in_small_letters(uri), -1);
        if (!is_new) {
            return known->second;
        }
        ModelImage image;
        image.name = printable(uri, 100);
        auto bytes = side_.read(uri, budget_.left());
        for (const std::string& other : {in_small_letters(uri)}) {
            bytes = bytes ? std::move(bytes) : side_.read(other, budget_.left());
        }
        if (!bytes || !budget_.claim(bytes->size(), 1)) {
            warn(model_,
                 fmt::format("texture left out: {}", bytes ? "too large" : bytes.error().message));
            return -1;
        }
        if (is_plain_picture(*bytes, texture)) {
            bytes = png_of_plain_picture(*bytes);
        }
        if (!bytes) {
            warn(model_,
                 fmt::format("texture \"{}\" left out: it {}", image.name, bytes.error().message));
            return -1;
        }
        image.packed = std::move(*bytes);
        if (const auto good = take_size(image); !good) {
            warn(model_,
                 fmt::format("texture \"{}\" left out: it {}", image.name, good.error().message));
            return -1;
        }
        known->second = static_cast<int>(model_.images.size());
        model_.images.push_back(std::move(image));
        return known->second;
    }

    TextureUse use_of(const TdsMaterial& from) {
        TextureUse use;
        const int image = image_of(from.texture);
        if (image < 0) {
            return use;
        }
        const TextureWrap wrap = from.is_mirrored ? TextureWrap::mirror
                                 : from.is_tiled  ? TextureWrap::repeat
                                                  : TextureWrap::clamp;
        use.texture = static_cast<int>(model_.textures.size());
        model_.textures.push_back({.image = image, .wrap_u = wrap, .wrap_v = wrap});
        // In the file v runs upwards.
        use.scale = from.uv_scale;
        use.offset = {from.uv_offset.x, 1.0F - from.uv_scale.y - from.uv_offset.y};
        return use;
    }

    const SideFiles& side_;
    ImportBudget& budget_;
    Model& model_;
    std::map<std::string, int> images_;  // by small letters
};

}  // namespace

TdsMaterial read_tds_material(TdsChunk& chunk) {
    TdsMaterial material;
    while (auto part = chunk.next()) {
        switch (part->id()) {
            case kTdsMaterialName:
                material.name = part->text();
                break;
            case kTdsDiffuse:
                material.diffuse = read_colour(*part, material.diffuse);
                break;
            case kTdsShininess:
                material.shininess = read_share(*part);
                break;
            case kTdsShineStrength:
                material.shine_strength = read_share(*part);
                break;
            case kTdsTransparency:
                material.transparency = read_share(*part);
                break;
            case kTdsSelfLight:
                material.self_light = read_share(*part);
                break;
            case kTdsTwoSided:
                material.is_two_sided = true;
                break;
            case kTdsTexture:
                read_texture(*part, material);
                break;
            default:
                material.other_textures += is_other_texture(part->id()) ? 1U : 0U;
                break;
        }
    }
    return material;
}

std::map<std::string, int> add_tds_materials(const TdsFile& file,
                                             const SideFiles& side,
                                             ImportBudget& budget,
                                             Model& model) {
    std::map<std::string, int> names;
    MaterialAdder adder(side, budget, model);
    for (const TdsMaterial& material : file.materials) {
        const bool is_new =
            names.try_emplace(material.name, static_cast<int>(model.materials.size())).second;
        if (!is_new) {
            warn(model,
                 fmt::format("two materials are named \"{}\"; the first is drawn for both",
                             printable(material.name, 60)));
        }
        adder.add(material);
    }
    leave_out_images_beyond_reason(model);
    return names;
}

}  // namespace raks::render
