#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"

namespace raks {

/// What is said of the part of a pending file or folder (base/pending_file.hpp) is meant of `path`,
/// the name that it was to get: the first mention of the part becomes `path`.
[[nodiscard]] Error named_as(const std::filesystem::path& path,
                             const std::filesystem::path& part,
                             Error error);

/// One of several files.
struct NamedFile {
    std::filesystem::path path;
    std::string bytes;
};

/// Writes files that belong together. None of them takes its name before all bytes of all of them
/// are written: where a disk is full, or one of them cannot be made, what was there stays. They
/// take their names in the order of `files`; of two with one path the later one stays. Errors: as
/// write_file (base/pending_file.hpp). Threads: one. Real-time: no.
[[nodiscard]] Expected<void> write_files(const std::vector<NamedFile>& files);

}  // namespace raks
