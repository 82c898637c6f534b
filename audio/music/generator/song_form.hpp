#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/music_state.hpp"
#include "base/time.hpp"

/// The form of a piece: which sections it has, and what they are to a listener.
namespace raks::audio {

/// What the band does in a section.
enum class SectionKind : std::uint8_t {
    intro,      ///< drums and bass alone, quieter
    verse,      ///< the whole band, 4 dB quieter than in full
    full,       ///< the whole band
    breakdown,  ///< the drums leave; long bass notes, chords and melody go on, 6 dB quieter
    filtered,   ///< a breakdown by filter: the whole band through a low-pass at 300 Hz, 12 dB less
    build_up,   ///< bass and drums give way to a roll that doubles; level and low-pass rise
    drop,       ///< the whole band, with an accent on its first beat
    stop,       ///< the whole band is cut: digital silence
    hit_stop,   ///< one short chord on its first beat, then nothing
    ending,     ///< the last chord on its first beat, which rings out
    fade_out,   ///< the whole band, whose level falls to nothing
    riff,  ///< a breakdown without a fall in level: drums and bass leave, the others play louder
};
/// Names in the order of SectionKind: "intro", "build-up", "hit-stop" and so on.
[[nodiscard]] std::span<const std::string_view> section_names() noexcept;

/// What a listener calls it.
[[nodiscard]] MusicPart part_of(SectionKind kind) noexcept;

/// One section of a form.
struct FormSection {
    SectionKind kind = SectionKind::full;  ///< what the band does
    int beats = 32;                        ///< how long, 1 to 10000
};

/// The form written as "full:32,breakdown:16,stop:4,drop:32,ending:8": kinds and beats. Errors: an
/// unknown kind (the nearest is named), beats out of range.
[[nodiscard]] Expected<std::vector<FormSection>> parse_form(std::string_view text);

/// What a typical song is drawn from.
struct FormDraw {
    int bars = 32;             ///< it has at most so many, and at most 3 less
    int beats_per_bar = 4;     ///< of its style
    double bar_seconds = 2.0;  ///< short bars make longer phrases
    std::uint64_t seed = 1;    ///< same seed, same form
};
/// A typical song in phrases of four and eight bars: intro, verse, then in turn breakdowns,
/// build-ups and drops, full sections, and stops of half a bar to two bars at the ends of phrases;
/// at last a chord that rings out, or a fade. From 24 bars on it has a breakdown, a drop and a
/// stop.
[[nodiscard]] std::vector<FormSection> draw_form(const FormDraw& draw);

/// A section as it was played.
struct PlayedSection {
    SectionKind kind = SectionKind::full;  ///< what the band did
    StreamTime from{};                     ///< its first beat
    StreamTime to{};                       ///< the next section's first beat, or its end
};

/// What happens where sections begin and where the form ends: the truth that analysis is measured
/// against, ascending. An event lies on the first beat of its section. The return of the drums is
/// a drop after a breakdown or a build-up, also with a stop between; after a stop alone it is an
/// entry. The end lies on the last chord, or where the music is cut or faded out.
[[nodiscard]] std::vector<MusicEvent> events_of(std::span<const PlayedSection> sections);

}  // namespace raks::audio
