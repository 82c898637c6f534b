#include "engine/import/foreign_text.hpp"

#include "engine/import/collada_text.hpp"
#include "engine/import/fbx_check.hpp"
#include "engine/import/obj_check.hpp"

namespace raks::engine {

Expected<std::string> mended_text(ForeignFormat format, const std::string& bytes) {
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
    return checked ? Expected<std::string>(bytes) : fail(checked.error());
}

}  // namespace raks::engine
