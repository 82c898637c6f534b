#pragma once

#include <string_view>

namespace raks::render {

/// config/themes/stage.toml as it was when the program was built, so that there is a theme where no
/// file is.
extern const std::string_view kStageTheme;

}  // namespace raks::render
