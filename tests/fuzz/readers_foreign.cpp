// What raks-import does to foreign models before assimp reads them.
#include "engine/import/foreign_text.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

bool read_foreign_text(std::string_view bytes) {
    bool is_any = false;
    for (const auto format :
         {engine::ForeignFormat::fbx, engine::ForeignFormat::collada, engine::ForeignFormat::obj}) {
        std::vector<std::string> notes;
        const auto text = engine::mended_text(format, std::string(bytes), notes);
        for (const std::string& note : notes) {
            must_be_one_line(note);
        }
        if (!text) {
            must_be_one_line(text.error().message);
        } else {
            // From UTF-16 it becomes half as long again at most.
            must(text->size() <= 2 * bytes.size());
        }
        is_any = is_any || text;
    }
    return is_any;
}

}  // namespace raks::fuzz
