#include "engine/show/avatar_files.hpp"

#include <algorithm>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "engine/setup/user_folders.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/model_reader.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

/// The line that says that there is no such avatar.
std::string why_none(const std::string& name, const std::vector<fs::path>& files) {
    std::string names(kMannequinName);
    for (const fs::path& file : files) {
        names += ", " + file.filename().string();
    }
    return fmt::format("no avatar \"{}\": neither a file nor one of {}",
                       printable(name, 200),
                       printable(names, 300));
}

}  // namespace

fs::path user_avatars_path() {
    const fs::path folder = xdg_folder("XDG_DATA_HOME", ".local/share");
    return folder.empty() ? folder : folder / "avatars";
}

Expected<std::vector<fs::path>> list_avatars() {
    const fs::path folder = user_avatars_path();
    if (folder.empty() || !is_there(folder)) {
        return std::vector<fs::path>{};
    }
    auto files = list_folder(folder);
    if (!files) {
        return files;
    }
    std::erase_if(*files, [](const fs::path& file) {
        std::error_code ignored;
        return !render::is_model_name(file) || !fs::is_regular_file(file, ignored);
    });
    return files;
}

Expected<fs::path> find_avatar(const std::string& name) {
    if (name == kMannequinName) {
        return fs::path();
    }
    if (is_there(name)) {
        return fs::path(name);
    }
    const auto files = list_avatars();
    if (!files) {
        return fail(files.error());
    }
    const auto found = std::find_if(files->begin(), files->end(), [&](const fs::path& file) {
        return file.filename() == name || file.stem() == name;
    });
    if (found == files->end()) {
        return fail(why_none(name, *files));
    }
    return *found;
}

fs::path find_labels(const fs::path& model, const fs::path& asked) {
    return asked.empty() ? render::labels_beside(model) : asked;
}

}  // namespace raks::engine
