#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks {

/// Whether anything has this name. What cannot be looked at is not there.
[[nodiscard]] bool is_there(const std::filesystem::path& path) noexcept;

/// Whole file as bytes. Errors: no name, missing, not readable, not a plain file (a folder, a pipe,
/// a device: they could keep the program waiting), larger than `max_bytes`.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path,
                                              std::size_t max_bytes = std::size_t{256} << 20U);

/// The first bytes of a file, at most `count`: fewer only if the file is shorter. To tell what a
/// file is before it is read. Errors: as read_file.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_file_start(const std::filesystem::path& path,
                                                    std::size_t count);

/// A file that appears under its name only when it is complete: written as `NAME.part` in the same
/// folder, renamed by commit(). Without commit() the destructor removes the part.
/// Threads: one. Real-time: no.
class PendingFile {
 public:
    /// Errors: no name, the folder does not exist, the part cannot be made there; what has one of
    /// the two names is not a plain file (a device is never replaced by a file).
    [[nodiscard]] static Expected<PendingFile> create(const std::filesystem::path& path);
    /// The same of a folder: part() is an empty one. What a run that was killed left there is
    /// removed. Errors: the folder is there and not empty, or cannot be made.
    [[nodiscard]] static Expected<PendingFile> create_folder(const std::filesystem::path& path);
    PendingFile(PendingFile&& other) noexcept;
    PendingFile& operator=(PendingFile&& other) noexcept;
    ~PendingFile();

    /// Where to write until commit().
    [[nodiscard]] const std::filesystem::path& part() const noexcept { return part_; }
    /// Gives the part its final name (replacing what was there).
    [[nodiscard]] Expected<void> commit();

 private:
    PendingFile(std::filesystem::path path, std::filesystem::path part);
    void remove_part() noexcept;

    std::filesystem::path path_;
    std::filesystem::path part_;  // empty once committed or moved from
};

/// Whether a file can be made under this name: asked before long work that ends in it. Errors: as
/// PendingFile::create; `output` is one of the `inputs` (by whatever name), which it would replace.
[[nodiscard]] Expected<void> check_output(const std::filesystem::path& output,
                                          const std::vector<std::filesystem::path>& inputs);
/// Its second half alone, for outputs that may be folders.
[[nodiscard]] Expected<void> check_is_no_input(const std::filesystem::path& output,
                                               const std::vector<std::filesystem::path>& inputs);

/// Where files for a while belong: $TMPDIR or what stands for it, else /tmp. Never fails.
[[nodiscard]] std::filesystem::path temporary_folder();

/// What lies in a folder, at any depth if `depth` says so (links to folders are not followed), in
/// the order of names. Errors: missing, not a folder, it or one inside cannot be listed.
enum class ListingDepth { folder, tree };
[[nodiscard]] Expected<std::vector<std::filesystem::path>> list_folder(
    const std::filesystem::path& folder, ListingDepth depth = ListingDepth::folder);

/// Writes all of `bytes` to `path`, or leaves what was there. Errors as PendingFile, and a full
/// disk.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raks
