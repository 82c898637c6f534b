#pragma once

#include "audio/evaluate/piece_features.hpp"
#include "base/expected.hpp"
#include "base/packer.hpp"

namespace raks::audio {

void pack_piece(const PieceFeatures& piece, Packer& packer);
/// Errors: cut short, sizes that do not fit together, a window outside its piece.
[[nodiscard]] Expected<PieceFeatures> unpack_piece(Unpacker& unpacker);

}  // namespace raks::audio
