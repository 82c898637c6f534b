#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/music/styles/band_palette.hpp"
#include "audio/music/styles/rhythm_style.hpp"

namespace raks::audio {

/// A kind of music in the beat tracker's corpus that is not written from a rhythm of the book, and
/// the dance that it is for.
struct CorpusStyle {
    std::string name;   ///< "groove rock", "own salsa", "piano"; also all names "groove rock-..."
    std::string dance;  ///< empty: none of the dances
    std::string style;  ///< the generator's style of this name; empty: another source
};

/// The styles in which training music is written. Dances are named as in their files; the empty
/// name stands for music that is for none of the dances.
///
///     auto book = load_styles("config/styles");
///     for (const RhythmStyle* style : book->rhythms_for("salsa")) { ... }
///
/// The order of `rhythms` matters: a drawn index takes the rhythm at that place, so another order
/// gives other music. Pointers that the book gives are valid as long as the book is not changed.
/// Threads: any number may read. Real-time: no.
struct StyleBook {
    std::vector<RhythmStyle> rhythms;        ///< in the order of the files
    std::vector<BandPalette> palettes;       ///< one a dance, and one for none of the dances
    std::vector<CorpusStyle> corpus_styles;  ///< in the order of the files

    /// The rhythms that the beat tracker's training uses, in order.
    [[nodiscard]] std::vector<const RhythmStyle*> rhythms_for_beats() const;

    /// The rhythms that are music for this dance, in order; "" gives those for none.
    [[nodiscard]] std::vector<const RhythmStyle*> rhythms_for(std::string_view dance) const;

    /// The dances that have a palette, in order.
    [[nodiscard]] std::vector<std::string> dances() const;

    /// The name of pieces in a style of the generator: a corpus style's, else "own STYLE".
    [[nodiscard]] std::string own_name(std::string_view style) const;

    /// The palette of a dance; where it has none, the palette of music for no dance, which the book
    /// must have.
    [[nodiscard]] const BandPalette& palette_of(std::string_view dance) const;

    /// Which dance the music of this name is for, as the beat tracker's training names it: a
    /// rhythm's name or a corpus style's, alone or with "-..." behind it. Nothing where it is
    /// neither clearly for a dance nor clearly for none.
    [[nodiscard]] std::optional<DanceLabel> label_of(std::string_view name) const;
};

/// Hash of the book's rhythms, palettes and corpus styles, under which music is kept between runs.
[[nodiscard]] std::uint64_t fingerprint(const StyleBook& book);

}  // namespace raks::audio
