#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "engine/import/scene_parts.hpp"
#include "render/import/image_file.hpp"
#include "render/import/plain_picture.hpp"
#include "render/import/srgb.hpp"

#include <assimp/material.h>
#include <fmt/format.h>

namespace raks::engine {
namespace {

using render::ModelMaterial;

/// Where the file that a texture names may lie: as it is named, by its last name, and in the
/// folders where exporters put them. Makers' own paths ("C:\\Users\\...") lead nowhere.
std::vector<std::string> places_of(std::string path) {
    std::replace(path.begin(), path.end(), '\\', '/');
    while (path.rfind("./", 0) == 0) {
        path.erase(0, 2);
    }
    const std::size_t slash = path.rfind('/');
    const std::string last = slash == std::string::npos ? path : path.substr(slash + 1);
    std::vector<std::string> places{path};
    for (const char* folder : {"", "textures/", "Textures/", "tex/"}) {
        places.push_back(folder + last);
    }
    return places;
}

/// '%' as "%25": names of files as they are become the names of side files, which are URIs.
std::string as_uri(const std::string& path) {
    std::string uri;
    for (const char c : path) {
        uri += c == '%' ? std::string("%25") : std::string(1, c);
    }
    return uri;
}

/// Materials of a scene, and the pictures that they share.
class MaterialImport {
 public:
    explicit MaterialImport(SceneImport& import) : import_(import) {}

    void run() {
        for (unsigned i = 0; i < import_.scene.mNumMaterials; ++i) {
            import_.model.materials.push_back(material_of(*import_.scene.mMaterials[i]));
        }
    }

 private:
    ModelMaterial material_of(const aiMaterial& source) {
        ModelMaterial material;
        aiString name;
        if (source.Get(AI_MATKEY_NAME, name) == aiReturn_SUCCESS) {
            material.name = name.C_Str();
        }
        material.metallic = 0.0F;
        material.roughness = 0.8F;  // cloth and skin
        material.base_texture.texture =
            texture_of(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
        material.normal_texture.texture = texture_of(source, {aiTextureType_NORMALS});
        material.emissive_texture.texture = texture_of(source, {aiTextureType_EMISSIVE});
        material.emissive = colour_of(source, AI_MATKEY_COLOR_EMISSIVE, glm::vec3(0.0F));
        // A picture takes the place of the colour; glTF would multiply them.
        const glm::vec3 colour = material.base_texture.texture >= 0
                                     ? glm::vec3(1.0F)
                                     : colour_of(source, AI_MATKEY_COLOR_DIFFUSE, glm::vec3(1.0F));
        material.base_colour = glm::vec4(colour, opacity_of(source));
        material.alpha_mode =
            material.base_colour.a < 1.0F ? render::AlphaMode::blend : render::AlphaMode::opaque;
        int is_two_sided = 0;
        material.is_double_sided =
            source.Get(AI_MATKEY_TWOSIDED, is_two_sided) == aiReturn_SUCCESS && is_two_sided != 0;
        return material;
    }

    /// Linear.
    glm::vec3 colour_of(const aiMaterial& source,
                        const char* key,
                        unsigned type,
                        unsigned index,
                        const glm::vec3& otherwise) const {
        aiColor3D colour;
        if (source.Get(key, type, index, colour) != aiReturn_SUCCESS) {
            return otherwise;
        }
        const auto part = [&](float x) {
            const float one = x > 0.0F ? std::min(x, 1.0F) : 0.0F;
            return import_.has_linear_colours ? one : render::linear_from_srgb(one);
        };
        return {part(colour.r), part(colour.g), part(colour.b)};
    }

    /// Exporters that mix it up with transparency say 0, which would be no surface.
    static float opacity_of(const aiMaterial& source) {
        float opacity = 1.0F;
        if (source.Get(AI_MATKEY_OPACITY, opacity) != aiReturn_SUCCESS || !(opacity > 0.0F)) {
            return 1.0F;
        }
        return std::min(opacity, 1.0F);
    }

    int texture_of(const aiMaterial& source, std::initializer_list<aiTextureType> types) {
        for (const aiTextureType type : types) {
            aiString path;
            if (source.GetTexture(type, 0, &path) == aiReturn_SUCCESS && path.length > 0) {
                return texture_at(path.C_Str());
            }
        }
        return -1;
    }

    int texture_at(const std::string& path) {
        const auto known = textures_.find(path);
        if (known != textures_.end()) {
            return known->second;
        }
        const std::string bytes = picture_at(path);
        int index = -1;
        if (!bytes.empty()) {
            index = add_texture(path, bytes);
        }
        return textures_[path] = index;
    }

    /// The packed bytes of a picture; empty: it could not be had, which is said.
    std::string picture_at(const std::string& path) {
        if (const aiTexture* const inside = import_.scene.GetEmbeddedTexture(path.c_str())) {
            if (inside->mHeight == 0) {
                return {reinterpret_cast<const char*>(inside->pcData), inside->mWidth};
            }
            import_.ways.note("a picture stored in it as plain pixels is left out");
            return {};
        }
        std::string why;
        for (const std::string& place : places_of(path)) {
            auto file = import_.ways.fetch(as_uri(place));
            if (file) {
                return std::move(*file);
            }
            why = why.empty() ? file.error().message : why;
        }
        import_.ways.note(fmt::format("picture left out: {}", why));
        return {};
    }

    /// As a glTF has it. Errors: it is no picture that is read.
    static Expected<std::vector<std::byte>> packed_picture(const std::string& path,
                                                           std::span<const std::byte> bytes) {
        if (render::is_plain_picture(bytes, path)) {
            return render::png_of_plain_picture(bytes);
        }
        const auto head = render::look_at_image(bytes);
        return head ? Expected<std::vector<std::byte>>(std::vector(bytes.begin(), bytes.end()))
                    : fail(head.error());
    }

    int add_texture(const std::string& path, const std::string& bytes) {
        auto packed = packed_picture(path, std::as_bytes(std::span(bytes.data(), bytes.size())));
        if (!packed) {
            import_.ways.note(fmt::format(
                "picture \"{}\" left out: it {}", printable(path, 80), packed.error().message));
            return -1;
        }
        render::ModelImage image;
        const std::size_t slash = path.find_last_of("/\\");
        image.name = slash == std::string::npos ? path : path.substr(slash + 1);
        image.packed = std::move(*packed);
        render::ModelTexture texture;
        texture.image = static_cast<int>(import_.model.images.size());
        import_.model.images.push_back(std::move(image));
        import_.model.textures.push_back(texture);
        return static_cast<int>(import_.model.textures.size()) - 1;
    }

    SceneImport& import_;
    std::map<std::string, int> textures_;  // by the path that materials name; -1: left out
};

}  // namespace

void import_materials(SceneImport& import) { MaterialImport(import).run(); }

}  // namespace raks::engine
