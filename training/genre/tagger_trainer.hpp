// Tagger trainer: learns what the music tagger's numbers say of the dances.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "audio/genre/tagger_classes.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What the tagger says of one recording.
struct TaggedPiece {
    std::string genre;                                     ///< name of a dance; empty: none of them
    std::string group;                                     ///< artist or source: stays in one fold
    std::vector<std::array<float, kTagFeatures>> patches;  ///< embeddings, one every 3 s
};

/// Whether the tagger has a word for a dance: its name without spaces and hyphens is that of a tag.
/// Pure.
[[nodiscard]] bool tagger_knows(std::string_view dance);

/// Fits the classes of `genres`, and none, to pieces: the maximum of the likelihood less an L2
/// penalty, each patch a row; rare dances weigh more, by the root of how rare they are. Genres that
/// no piece has keep the weights 0. Errors: no piece has a patch. The same pieces give the same
/// numbers. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TaggerClasses> fit_tagger(std::span<const TaggedPiece* const> pieces,
                                                 std::span<const std::string> genres);

/// Moves classes that were fitted to other pieces, which are not at hand, towards these: as
/// fit_tagger(), but the penalty holds the numbers, biases too, near those of `base` and not near 0
/// (maximum a posteriori, Chelba & Acero 2004). Mean, deviation and what the tagger knows stay. A
/// few pieces move them a little. Errors: no piece has a patch; `base` is of other genres.
[[nodiscard]] Expected<TaggerClasses> adapt_tagger(const TaggerClasses& base,
                                                   std::span<const TaggedPiece* const> pieces,
                                                   std::span<const std::string> genres);

/// For each piece the mean ln probabilities of its patches (rows of genres.size() + 1) by classes
/// that were fitted without its group: groups are dealt to ten folds, the largest first. A piece
/// without a patch has zeros. Errors: as fit_tagger().
[[nodiscard]] Expected<std::vector<std::vector<float>>> held_out_tagger(
    std::span<const TaggedPiece> pieces, std::span<const std::string> genres);

}  // namespace raks::audio
