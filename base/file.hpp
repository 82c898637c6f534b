#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Files and folders, with errors that name the path.
namespace raks {

/// Does a file or folder of this name exist (links are followed)? False also where that cannot be
/// checked.
[[nodiscard]] bool is_there(const std::filesystem::path& path) noexcept;

/// Whole file as bytes. Errors: no name, missing, not readable, not a plain file (a folder, a pipe,
/// a device: they could keep the program waiting), larger than `max_bytes`.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path,
                                              std::size_t max_bytes = std::size_t{256} << 20U);

/// The first bytes of a file, at most `count`; fewer only if the file is shorter. Used to check
/// what a file is before all of it is read. Errors: as read_file.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_file_start(const std::filesystem::path& path,
                                                    std::size_t count);

/// Folder for temporary files: $TMPDIR or another that the system names, else /tmp. Never fails.
[[nodiscard]] std::filesystem::path temporary_folder();

/// How deep list_folder looks: the folder alone, or all folders below it.
enum class ListingDepth { folder, tree };
/// Paths in a folder, sorted by name; links to folders are not followed. Errors: missing, not a
/// folder, it or one inside cannot be listed.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> list_folder(
    const std::filesystem::path& folder, ListingDepth depth = ListingDepth::folder);

/// Reads UTF-8 text as any editor or spreadsheet may have saved it: removes a byte-order mark,
/// turns "\r\n" and lone "\r" into "\n"; line numbers stay. Errors: as read_file; UTF-16 or UTF-32,
/// or a zero byte, which no text has.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::size_t max_bytes);

}  // namespace raks
