#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "audio/music/styles/rhythm_styles.hpp"
#include "base/music_state.hpp"

namespace raks::audio {

/// The instruments that a band of one genre is drawn from: General MIDI programs, from 0.
struct Palette {
    std::vector<int> bass;
    std::vector<int> chords;
    std::vector<int> leads;
    std::vector<int> kits;
    double band_chance = 0.9;  ///< that more than drums plays
    double lead_chance = 0.5;  ///< that a melody of the genre's own plays
    BandChances players;       ///< of the band
};
[[nodiscard]] const Palette& palette_of(Genre genre);

/// One rhythm of the corpus and the dance that it stands for (unknown: none of them).
struct GenreStyle {
    const RhythmStyle* style = nullptr;
    Genre genre = Genre::unknown;
    /// A family of arrangements that a model can be trained without, to see whether it holds for
    /// what it never heard; one or two a genre.
    enum class Use : std::uint8_t { always, held_out };
    Use use = Use::always;
};

/// All rhythms that a genre is written from: those of the beat tracker's training, and some more.
[[nodiscard]] std::span<const GenreStyle> genre_styles();

/// What music of this style is danced as (unknown: none of the dances), by the name that the beat
/// tracker's training gives it: a rhythm's, "groove rock", "own salsa", "piano". Nothing where it
/// is neither clearly a dance nor clearly none.
[[nodiscard]] std::optional<GenreStyle> genre_of_style(std::string_view name);

}  // namespace raks::audio
