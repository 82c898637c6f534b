#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/packer.hpp"
#include "motion/cells/cell_dance.hpp"

namespace raks::motion {

/// Bytes of such a file, at most: kMostTakeBeats are some 13 MiB.
inline constexpr std::size_t kMostCellBytes = std::size_t{16} << 20U;

/// The file of a dance of cells, DANCE.cells: binary, little-endian, means of states as half floats
/// (docs/reference/files.md). What is read back is what was written up to that rounding.
/// Threads: any. Real-time: no.
[[nodiscard]] std::string cell_text(const CellDance& dance);

/// Reads what cell_text() wrote; `name` stands for the file in errors. Counts are checked before
/// anything of that size is made: whatever the bytes are, it takes no more than a dance of
/// kMostTakeBeats does, some 600 MB. Errors, one line: another format, a newer version, cut short,
/// damaged, a value out of its range.
[[nodiscard]] Expected<CellDance> parse_cells(std::string_view bytes, const std::string& name);
/// The same from a file of at most kMostCellBytes.
[[nodiscard]] Expected<CellDance> load_cells(const std::filesystem::path& path);

/// Appends the graph alone, without its takes, as it lies in such a file.
void pack_graph(const CellGraph& graph, Packer& packer);
/// Reads what pack_graph() wrote of a graph of these takes. Errors: a fault of `unpacker`, which is
/// to be asked; what validate() says.
[[nodiscard]] Expected<CellGraph> unpack_graph(std::vector<CellTake> takes, Unpacker& unpacker);

}  // namespace raks::motion
