#pragma once

#include "audio/evaluate/piece_features.hpp"
#include "base/expected.hpp"
#include "base/packer.hpp"

namespace raks::audio {

/// Binary form of a piece's features, for caches and shards on the same kind of machine.
void pack_piece(const PieceFeatures& piece, Packer& packer);
/// Reads what pack_piece wrote and checks it. Errors: cut short; numbers that are not finite or too
/// large; sizes that do not fit together; a window outside its piece; a name that no dance can
/// have.
[[nodiscard]] Expected<PieceFeatures> unpack_piece(Unpacker& unpacker);

}  // namespace raks::audio
