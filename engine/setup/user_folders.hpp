#pragma once

#include <filesystem>
#include <string_view>

namespace raks::engine {

/// Where a person's pictures are kept: as `xdg-user-dir PICTURES` says it; else ~/Pictures where
/// that is there; else the current folder, as an empty path. The folder exists. Threads: main.
[[nodiscard]] std::filesystem::path pictures_folder();

/// The value of a line such as XDG_PICTURES_DIR="$HOME/Pictures" of a user-dirs.dirs file; the last
/// one counts. Empty: there is none, or it is neither absolute nor below $HOME.
[[nodiscard]] std::filesystem::path user_folder_in(std::string_view user_dirs,
                                                   std::string_view name,
                                                   const std::filesystem::path& home);

}  // namespace raks::engine
