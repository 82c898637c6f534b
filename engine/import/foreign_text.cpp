#include "engine/import/foreign_text.hpp"

#include "engine/import/collada_text.hpp"
#include "engine/import/fbx_check.hpp"
#include "engine/import/fbx_connections.hpp"
#include "engine/import/obj_check.hpp"

namespace raks::engine {

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
    }
    return text;
}

}  // namespace raks::engine
