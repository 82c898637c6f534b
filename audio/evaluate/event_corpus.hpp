#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "base/music_state.hpp"

/// Songs with what happens in them, annotated by ear or by eye: NAME.events beside the sound. Lines
/// may end in CRLF, empty lines and lines that start with '#' are skipped. Every error is one line,
/// such as `x/song.events: line 3: event is "dropp", must be stop, entry, ...`.
/// Threads: any. Real-time: no.
namespace raks::audio {

/// Events, one a line: seconds from 0 to 1e6, a blank or tab, and a name of kMusicEventNames but
/// "none"; further words are ignored. Sorted by time. Errors: any other line.
[[nodiscard]] Expected<std::vector<MusicEvent>> parse_events(std::string_view text,
                                                             const std::string& file);

/// The text that parse_events reads: seconds to the microsecond, a tab, and the name.
[[nodiscard]] std::string events_text(std::span<const MusicEvent> events);

/// One annotated song.
struct EventExcerpt {
    std::string name;                ///< of its files, without extension
    std::vector<MusicEvent> events;  ///< at least one, ascending
    std::filesystem::path audio;     ///< as find_sound()
};

/// The songs of a folder, by name. All annotations are read and checked; of the sound only its
/// existence. Errors: as parse_events; a song without events or without sound; no songs.
[[nodiscard]] Expected<std::vector<EventExcerpt>> load_event_corpus(
    const std::filesystem::path& folder);

}  // namespace raks::audio
