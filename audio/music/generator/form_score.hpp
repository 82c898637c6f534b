#pragma once

#include <span>
#include <vector>

#include "audio/music/generator/music_generator.hpp"
#include "audio/music/generator/notes.hpp"
#include "audio/music/generator/song_form.hpp"

namespace raks::audio {

/// A section on the beat axis, [from, to).
struct SectionSpan {
    SectionKind kind = SectionKind::full;  ///< what the band does
    int from = 0;                          ///< first beat
    int to = 0;                            ///< one past the last
};
/// The sections one after the other from beat 0 on.
[[nodiscard]] std::vector<SectionSpan> spans_of(std::span<const FormSection> form);

/// The score of a style as its band plays it in a form: who plays in each section, rolls, accents,
/// last chords. `score`: all notes of the style, up to the last section's end at least; later ones
/// are dropped. Levels and filters are not in the notes: FormSound applies them.
[[nodiscard]] Notes arrange(Notes score, std::span<const SectionSpan> form, Style style);

}  // namespace raks::audio
