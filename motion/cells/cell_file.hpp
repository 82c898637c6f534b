#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/cells/cell_dance.hpp"

namespace raks::motion {

/// The file of a dance of cells, DANCE.cells: binary, little-endian, means of states as half floats
/// (docs/reference/files.md). What is read back is what was written up to that rounding.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string cell_text(const CellDance& dance);

/// Reads what cell_text() wrote; `name` stands for the file in errors. Errors, one line: another
/// format, a newer version, cut short, damaged, a value out of its range.
[[nodiscard]] Expected<CellDance> parse_cells(std::string_view bytes, const std::string& name);
/// The same from a file of at most 64 MiB.
[[nodiscard]] Expected<CellDance> load_cells(const std::filesystem::path& path);

}  // namespace raks::motion
