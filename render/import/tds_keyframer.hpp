#pragma once

#include "render/import/tds_chunks.hpp"
#include "render/import/tds_file.hpp"

namespace raks::render {

/// Reads the keyframer's chunk (B000) into TdsFile::nodes: names, ids, parents, pivots and tracks.
/// Faults: as of TdsChunk. A track whose frames fall is left out, with a note.
void read_tds_keyframer(TdsChunk& chunk, TdsFile& file);

}  // namespace raks::render
