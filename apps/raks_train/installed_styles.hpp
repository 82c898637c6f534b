#pragma once

#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// The installed music styles: the folder config/styles beside the program, or below $RAKS_DATA.
/// Errors: it is not there; as load_styles.
[[nodiscard]] Expected<audio::StyleBook> load_installed_styles();

}  // namespace raks::apps
