#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "base/expected.hpp"

namespace raks {

/// A file of UTF-8 text as every editor and spreadsheet may have left it: without the mark at its
/// start, with "\n" at the end of lines ("\r\n" and lone "\r" are made so; line numbers stay).
/// Errors: as read_file; UTF-16 or UTF-32, or a zero byte: then it is no text.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::size_t max_bytes);

}  // namespace raks
