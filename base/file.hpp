#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks {

/// Whole file as bytes. Errors: missing, not readable, a folder, larger than `max_bytes`.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path,
                                              std::size_t max_bytes = std::size_t{256} << 20U);

/// A file that appears under its name only when it is complete: written as `NAME.part` in the same
/// folder, renamed by commit(). Without commit() the destructor removes the part.
/// Threads: one. Real-time: no.
class PendingFile {
 public:
    /// Errors: the folder does not exist or the part cannot be made there.
    [[nodiscard]] static Expected<PendingFile> create(const std::filesystem::path& path);
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

/// Writes all of `bytes` to `path`, or leaves what was there. Errors as PendingFile, and a full
/// disk.
[[nodiscard]] Expected<void> write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace raks
