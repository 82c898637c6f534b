#include <algorithm>
#include <cmath>
#include <map>

#include "render/export/tds_parts.hpp"

#include <fmt/format.h>
#include <glm/common.hpp>

namespace raks::render {
namespace {

float srgb_part(float linear) {
    const float part = std::clamp(linear, 0.0F, 1.0F);
    return part <= 0.0031308F ? 12.92F * part : 1.055F * std::pow(part, 1.0F / 2.4F) - 0.055F;
}

TdsBytes colour(const glm::vec3& linear) {
    constexpr std::uint16_t kFloats = 0x0010;
    return TdsBytes().chunk(
        kFloats,
        TdsBytes().vector({srgb_part(linear.x), srgb_part(linear.y), srgb_part(linear.z)}));
}

TdsBytes percent(float share) {
    constexpr std::uint16_t kWhole = 0x0030;
    return TdsBytes().chunk(kWhole,
                            TdsBytes().u16(static_cast<std::size_t>(
                                std::lround(100.0F * glm::clamp(share, 0.0F, 1.0F)))));
}

/// Materials, and the pictures that they share.
class MaterialTexts {
 public:
    MaterialTexts(const Model& model, const std::string& stem, TdsExport& made)
        : model_(model), stem_(stem), made_(made) {}

    TdsBytes of(const ModelMaterial& material, const std::string& name) {
        constexpr std::uint16_t kName = 0xA000;
        constexpr std::uint16_t kAmbient = 0xA010;
        constexpr std::uint16_t kDiffuse = 0xA020;
        constexpr std::uint16_t kSpecular = 0xA030;
        constexpr std::uint16_t kTransparency = 0xA050;
        constexpr std::uint16_t kTwoSided = 0xA081;
        constexpr std::uint16_t kSelfLight = 0xA084;
        constexpr std::uint16_t kTexture = 0xA200;
        constexpr std::uint16_t kTextureFile = 0xA300;
        const glm::vec3 base(material.base_colour);
        TdsBytes body;
        body.chunk(kName, TdsBytes().text(name))
            .chunk(kAmbient, colour(base))
            .chunk(kDiffuse, colour(base))
            .chunk(kSpecular, colour(glm::vec3(0.0F)));
        if (material.alpha_mode == AlphaMode::blend) {
            body.chunk(kTransparency, percent(1.0F - material.base_colour.a));
        }
        if (material.is_double_sided) {
            body.chunk(kTwoSided, {});
        }
        const float light =
            std::max({material.emissive.x, material.emissive.y, material.emissive.z});
        const float most = std::max({base.x, base.y, base.z});
        if (light > 0.0F && most > 0.0F) {
            body.chunk(kSelfLight, percent(light / most));
        }
        if (const std::string file = picture_of(material.base_texture); !file.empty()) {
            TdsBytes texture = percent(1.0F);
            texture.chunk(kTextureFile, TdsBytes().text(file));
            body.chunk(kTexture, texture);
        }
        return body;
    }

 private:
    /// The name of its file; empty: there is none.
    std::string picture_of(const TextureUse& use) {
        const int image =
            use.texture < 0 ? -1 : model_.textures[static_cast<std::size_t>(use.texture)].image;
        if (image < 0 || model_.images[static_cast<std::size_t>(image)].packed.empty()) {
            return {};
        }
        const auto [place, is_new] = files_.try_emplace(image);
        if (is_new) {
            const auto& packed = model_.images[static_cast<std::size_t>(image)].packed;
            // As old programs want it: 8 characters, a dot, 3.
            constexpr std::size_t kStem = 6;
            place->second =
                fmt::format("{}{}.{}", stem_.substr(0, kStem), files_.size(), ending_of(packed));
            made_.pictures.push_back({place->second, packed});
        }
        return place->second;
    }

    static const char* ending_of(const std::vector<std::byte>& packed) {
        switch (std::to_integer<int>(packed.front())) {
            case 0x89:
                return "png";
            case 0xFF:
                return "jpg";
            default:
                return "webp";
        }
    }

    const Model& model_;
    std::string stem_;
    TdsExport& made_;
    std::map<int, std::string> files_;  // by image
};

}  // namespace

TdsBytes tds_materials(const Model& model,
                       const std::vector<std::string>& names,
                       const std::string& stem,
                       TdsExport& made) {
    constexpr std::uint16_t kMaterial = 0xAFFF;
    MaterialTexts texts(model, stem, made);
    TdsBytes all;
    for (std::size_t i = 0; i < model.materials.size(); ++i) {
        all.chunk(kMaterial, texts.of(model.materials[i], names[i]));
    }
    return all;
}

}  // namespace raks::render
