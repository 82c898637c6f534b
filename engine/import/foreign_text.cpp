#include "engine/import/foreign_text.hpp"

#include <string_view>

#include "engine/import/collada_text.hpp"
#include "engine/import/fbx_check.hpp"
#include "engine/import/fbx_connections.hpp"
#include "engine/import/obj_check.hpp"

namespace raks::engine {
namespace {

/// Hides the property DiffuseFactor from assimp, which multiplies DiffuseColor with it. Blender and
/// FBX2glTF, like the glTF that is exported beside an FBX, take the colour as it stands.
void hide_diffuse_factor(std::string& fbx) {
    constexpr std::string_view kName = "DiffuseFactor";
    for (std::size_t at = fbx.find(kName); at != std::string::npos; at = fbx.find(kName, at + 1)) {
        fbx[at + kName.size() - 1] = '_';
    }
}

}  // namespace

Expected<std::string> mended_text(ForeignFormat format,
                                  const std::string& bytes,
                                  std::vector<std::string>& notes) {
    if (bytes.empty()) {
        return fail("empty");
    }
    Expected<void> checked;
    switch (format) {
        case ForeignFormat::fbx:
            checked = check_fbx(bytes);
            break;
        case ForeignFormat::collada:
            return mended_collada(bytes);
        case ForeignFormat::obj:
            checked = check_obj(bytes);
            break;
    }
    if (!checked) {
        return fail(checked.error());
    }
    std::string text = bytes;
    if (format == ForeignFormat::fbx) {
        mend_fbx_connections(text, notes);
        hide_diffuse_factor(text);
    }
    return text;
}

}  // namespace raks::engine
