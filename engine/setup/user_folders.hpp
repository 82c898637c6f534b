#pragma once

#include <filesystem>
#include <string_view>

#include "base/expected.hpp"

namespace raks::engine {

/// Raks's own folder among those of one kind that the XDG Base Directory Specification names:
/// `variable` / raks where it holds an absolute path (another is no setting), else below the
/// person's home. Empty: neither is known. `variable`: "XDG_STATE_HOME"; `below_home`:
/// ".local/state". Threads: main, before others could set variables.
[[nodiscard]] std::filesystem::path xdg_folder(const char* variable,
                                               const std::filesystem::path& below_home);

/// TMP/raks-UID: for files that can be made again where user_cache_path() is no place for them.
/// Made where it is missing, for this user alone. Errors: it cannot be made; what has the name is
/// not a folder of this user's that nobody else may enter: others may have put something there.
/// Threads: main. Real-time: no.
[[nodiscard]] Expected<std::filesystem::path> private_temporary_folder();

/// `name` below user_cache_path(), or below private_temporary_folder() where that is unknown or
/// cannot be written. The folder exists. Errors: those of private_temporary_folder(). Threads:
/// main. Real-time: no.
[[nodiscard]] Expected<std::filesystem::path> kept_folder(const std::filesystem::path& name);

/// Where a person's pictures are kept: as `xdg-user-dir PICTURES` says it; else ~/Pictures where
/// that is there; else the current folder, as an empty path. The folder exists. Threads: main.
[[nodiscard]] std::filesystem::path pictures_folder();

/// The same for films: `xdg-user-dir VIDEOS`, ~/Videos.
[[nodiscard]] std::filesystem::path videos_folder();

/// A file name from the local time that nobody has yet: "raks-20260131-235959.png" in `folder`;
/// with a number appended when a file of that name exists there. `ending`: ".png". Threads: main.
[[nodiscard]] std::filesystem::path dated_file(const std::filesystem::path& folder,
                                               std::string_view ending);

/// The value of a line such as XDG_PICTURES_DIR="$HOME/Pictures" of a user-dirs.dirs file; the last
/// one counts. Empty: there is none, or it is neither absolute nor below $HOME.
[[nodiscard]] std::filesystem::path user_folder_in(std::string_view user_dirs,
                                                   std::string_view name,
                                                   const std::filesystem::path& home);

}  // namespace raks::engine
