#include "render/import/vrm.hpp"

namespace raks::render {

Expected<void> read_character(const JsonField& /*root*/, Model& /*model*/) { return {}; }

}  // namespace raks::render
