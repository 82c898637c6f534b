#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/expected.hpp"

namespace raks {

/// Reads UTF-8 text as any editor or spreadsheet may have saved it: removes a byte-order mark,
/// turns "\r\n" and lone "\r" into "\n"; line numbers stay. Errors: as read_file; UTF-16 or UTF-32,
/// or a zero byte, which no text has.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::size_t max_bytes);

}  // namespace raks
