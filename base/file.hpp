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

/// A file that appears under its name only when it is complete: written as `NAME.part` in the same
/// folder and renamed by commit(). Without commit() the destructor removes the part.
/// Threads: one. Real-time: no.
class PendingFile {
 public:
    /// Errors: no name, the folder does not exist, the part cannot be made there; what has one of
    /// the two names is not a plain file (a device is never replaced by a file).
    [[nodiscard]] static Expected<PendingFile> create(const std::filesystem::path& path);
    /// The same for a folder: part() is an empty one. A part that an earlier, killed run left is
    /// removed. Errors: the folder exists and is not empty, or cannot be made.
    [[nodiscard]] static Expected<PendingFile> create_folder(const std::filesystem::path& path);
    PendingFile(PendingFile&& other) noexcept;             ///< the source then owns nothing
    PendingFile& operator=(PendingFile&& other) noexcept;  ///< removes its own part first
    ~PendingFile();                                        ///< removes the part, unless committed

    /// Where to write until commit().
    [[nodiscard]] const std::filesystem::path& part() const noexcept { return part_; }
    /// Renames the part to its final name, replacing what was there. Errors: the system's.
    [[nodiscard]] Expected<void> commit();

 private:
    PendingFile(std::filesystem::path path, std::filesystem::path part);
    void remove_part() noexcept;

    std::filesystem::path path_;
    std::filesystem::path part_;  // empty once committed or moved from
};

/// Checks before long work that its output can be written at the end. Errors: as
/// PendingFile::create; `output` is one of the `inputs` (by whatever name), which it would replace.
[[nodiscard]] Expected<void> check_output(const std::filesystem::path& output,
                                          const std::vector<std::filesystem::path>& inputs);
/// The second of these checks alone, for outputs that may be folders.
[[nodiscard]] Expected<void> check_is_no_input(const std::filesystem::path& output,
                                               const std::vector<std::filesystem::path>& inputs);

/// Folder for temporary files: $TMPDIR or another that the system names, else /tmp. Never fails.
[[nodiscard]] std::filesystem::path temporary_folder();

/// How deep list_folder looks: the folder alone, or all folders below it.
enum class ListingDepth { folder, tree };
/// Paths in a folder, sorted by name; links to folders are not followed. Errors: missing, not a
/// folder, it or one inside cannot be listed.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> list_folder(
    const std::filesystem::path& folder, ListingDepth depth = ListingDepth::folder);

/// Writes all of `bytes` to `path`, or leaves what was there. Errors: as PendingFile, and a full
/// disk.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path, std::string_view bytes);

/// Reads UTF-8 text as any editor or spreadsheet may have saved it: removes a byte-order mark,
/// turns "\r\n" and lone "\r" into "\n"; line numbers stay. Errors: as read_file; UTF-16 or UTF-32,
/// or a zero byte, which no text has.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::size_t max_bytes);

}  // namespace raks
