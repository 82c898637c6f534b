#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audio/music/styles/band_palette.hpp"
#include "audio/music/styles/rhythm_style.hpp"

namespace raks::audio {

/// Music of the beat tracker's corpus that is written from no rhythm of the book, and which dance
/// it is for.
struct CorpusStyle {
    std::string name;   ///< "groove rock", "own salsa", "piano"; also all names "groove rock-..."
    std::string dance;  ///< empty: none of the dances
    std::string style;  ///< of our own generator, that is called so; empty: of another source
};

/// The styles that music is written in. Dances are named as in their files; the empty name is that
/// of music for none of the dances.
///
///     auto book = load_styles("config/styles");
///     for (const RhythmStyle* style : book->rhythms_for("salsa")) { ... }
///
/// The order of `rhythms` is part of what is written: the same draw takes the rhythm at the same
/// place. Pointers that the book gives live as long as the book stays as it is.
/// Threads: any number may read. Real-time: no.
struct StyleBook {
    std::vector<RhythmStyle> rhythms;
    std::vector<BandPalette> palettes;  ///< one a dance, and one for none of the dances
    std::vector<CorpusStyle> corpus_styles;

    /// Those that the beat tracker's training has, in order.
    [[nodiscard]] std::vector<const RhythmStyle*> rhythms_for_beats() const;

    /// Those that are music for this dance, in order.
    [[nodiscard]] std::vector<const RhythmStyle*> rhythms_for(std::string_view dance) const;

    /// The dances that have a palette, in order.
    [[nodiscard]] std::vector<std::string> dances() const;

    /// What pieces of a style of our own generator are called.
    [[nodiscard]] std::string own_name(std::string_view style) const;

    /// The dance's palette; without one of its own that of none of the dances.
    [[nodiscard]] const BandPalette& palette_of(std::string_view dance) const;

    /// Which dance music of this style is for, by the name that the beat tracker's training gives
    /// it: a rhythm's or that of a corpus style. Nothing where it is neither clearly for a dance
    /// nor clearly for none.
    [[nodiscard]] std::optional<DanceLabel> label_of(std::string_view name) const;
};

/// A number for all that the book says: music that is kept between runs is kept under it.
[[nodiscard]] std::uint64_t fingerprint(const StyleBook& book);

}  // namespace raks::audio
