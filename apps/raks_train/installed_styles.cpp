#include "apps/raks_train/installed_styles.hpp"

#include "audio/music/styles/style_book_reader.hpp"
#include "engine/setup/settings.hpp"

namespace raks::apps {

Expected<audio::StyleBook> load_installed_styles() {
    const auto folder = engine::data_path("config/styles");
    return folder ? audio::load_styles(*folder) : fail(folder.error());
}

}  // namespace raks::apps
