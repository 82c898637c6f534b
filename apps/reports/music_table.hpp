#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <string_view>
#include <variant>

#include "base/music_state.hpp"
#include "base/time.hpp"

/// What a MusicState says, as Raks writes it down: one table, of which `raks analyze --json` and
/// `--plot` are made and with which a test compares docs/reference/files.md. A feature more is a
/// row more. Beats, tempo and dance are not in it: a method that has the whole file replaces the
/// beats, and the classes of dances have the names of the model.
namespace raks::apps {

/// A number, a yes or no, or a word.
using MusicValue = std::variant<double, bool, std::string_view>;

/// How the picture shows a number, in the panel of its row.
enum class Drawn {
    no,    ///< not at all
    area,  ///< filled from the lowest value on; areas stand before lines in their row
    line,  ///< as a line
};

/// One thing that a row says.
struct MusicField {
    std::string_view key;                              ///< in the document; empty: there is none
    MusicValue (*value)(const MusicState&) = nullptr;  ///< what the state says
    std::string_view what{};                           ///< in words; empty: the key says it
    std::string_view unit{};                           ///< of a number; empty: it has none
    double low = 0.0;                                  ///< lowest number
    double high = 1.0;                                 ///< highest number
    int decimals = 4;                                  ///< of a number in the document
    std::span<const std::string_view> words{};         ///< that it may be, where it is a word
    Drawn drawn = Drawn::no;                           ///< numbers of Written::twice_a_second only
    std::string_view legend{};                         ///< where the panel shows several
};

/// When a row is written.
enum class Written {
    twice_a_second,   ///< as it is then
    when_it_changes,  ///< the first field, from the first hop on
    when_it_happens,  ///< at hops at which `happens`
};

/// A row: an array of the document, and a panel of the picture where one of its fields is drawn.
struct MusicRow {
    static constexpr std::size_t kMostFields = 3;  ///< in one row

    std::string_view name;   ///< of the array and the panel
    std::string_view title;  ///< in words; over the panel
    Written written = Written::twice_a_second;
    std::array<MusicField, kMostFields> fields{};  ///< those that are there come first
    double panel_height = 64.0;                    ///< as PlotSheet::PanelPlan
    bool is_of_known_songs = false;                ///< live it is never told
    /// Where Written::when_it_happens: whether it does at this hop.
    bool (*happens)(const MusicState&) = nullptr;
    /// What stands at `time`.
    StreamTime (*time)(const MusicState&) = [](const MusicState& state) { return state.time; };

    /// The fields that are there.
    [[nodiscard]] constexpr std::span<const MusicField> used() const noexcept {
        const auto end = std::find_if(fields.begin(), fields.end(), [](const MusicField& field) {
            return field.key.empty();
        });
        return std::span(fields).first(static_cast<std::size_t>(end - fields.begin()));
    }
};

/// The table, in the order of document and picture.
inline constexpr auto kMusicTable = std::to_array<MusicRow>({
    {.name = "loudness",
     .title = "Loudness",
     .fields = {{{.key = "lufs",
                  .value = [](const MusicState& s) -> MusicValue { return s.loudness_lufs; },
                  .what = "momentary, EBU R 128",
                  .unit = "LUFS",
                  .low = -120.0,
                  .high = 30.0,
                  .decimals = 1}}}},
    {.name = "energy",
     .title = "Energy",
     .fields = {{{.key = "now",
                  .value = [](const MusicState& s) -> MusicValue { return s.energy.now; },
                  .what = "of half a second, against the song's own range",
                  .drawn = Drawn::area,
                  .legend = "now"},
                 {.key = "lately",
                  .value = [](const MusicState& s) -> MusicValue { return s.energy.lately; },
                  .what = "of 4 s",
                  .drawn = Drawn::line,
                  .legend = "of 4 s"},
                 {.key = "longer",
                  .value = [](const MusicState& s) -> MusicValue { return s.energy.longer; },
                  .what = "of 30 s"}}},
     .panel_height = 84.0},
    {.name = "parts",
     .title = "What the music does",
     .written = Written::when_it_changes,
     .fields = {{{.key = "part",
                  .value =
                      [](const MusicState& s) -> MusicValue { return music_part_name(s.part); },
                  .what = "in a breakdown the rhythm section is gone",
                  .words = kMusicPartNames}}}},
    {.name = "events",
     .title = "Changes in it",
     .written = Written::when_it_happens,
     .fields = {{{.key = "event",
                  .value = [](const MusicState& s)
                      -> MusicValue { return music_event_name(s.event.kind); },
                  .words = std::span(kMusicEventNames).subspan(1)},
                 {.key = "told",
                  .value = [](const MusicState& s) -> MusicValue { return to_seconds(s.time); },
                  .what = "when it was known",
                  .high = std::numeric_limits<double>::infinity(),
                  .decimals = 6}}},
     .happens = [](const MusicState& s) { return s.event.kind != MusicEvent::Kind::none; },
     .time = [](const MusicState& s) { return s.event.time; }},
    {.name = "accents",
     .title = "Strong onsets",
     .written = Written::when_it_happens,
     .fields = {{{.key = "strength",
                  .value = [](const MusicState& s) -> MusicValue { return s.accent.strength; },
                  .what = "against the strongest of half a minute"},
                 {.key = "band",
                  .value = [](const MusicState& s)
                      -> MusicValue { return music_band_name(s.accent.band); },
                  .what = "where it is strongest",
                  .words = kMusicBandNames},
                 {.key = "on_beat",
                  .value = [](const MusicState& s) -> MusicValue { return s.accent.is_on_beat; },
                  .what = "within 70 ms of a beat"}}},
     .happens = [](const MusicState& s) { return s.accent.strength > 0.0F; },
     .time = [](const MusicState& s) { return s.accent.time; }},
    {.name = "bars",
     .title = "Bars of a song that is known",
     .written = Written::when_it_happens,
     .fields = {{{.key = "bar",
                  .value = [](const MusicState& s)
                      -> MusicValue { return static_cast<double>(s.ahead.bar); },
                  .what = "its number, from the first that can be danced to",
                  .high = 32767.0,
                  .decimals = 0},
                 {.key = "repeats",
                  .value = [](const MusicState& s)
                      -> MusicValue { return static_cast<double>(s.ahead.repeats[0]); },
                  .what =
                      "the earliest bar that it repeats, as a part that comes again; -1: it is new",
                  .low = -1.0,
                  .high = 32767.0,
                  .decimals = 0}}},
     .is_of_known_songs = true,
     .happens =
         [](const MusicState& s) {
             return s.ahead.bar >= 0 && s.has_beat && s.beat.bar_position == 1;
         },
     .time = [](const MusicState& s) { return s.beat.time; }},
});

/// A number for each field of the table: [row][field].
using MusicNumbers = std::array<std::array<double, MusicRow::kMostFields>, kMusicTable.size()>;

}  // namespace raks::apps
