#include "audio/evaluate/event_corpus.hpp"

#include <algorithm>
#include <utility>

#include "audio/evaluate/text_lines.hpp"
#include "base/file.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

// No annotation comes near this; a wrong file is refused before it fills the memory.
constexpr std::size_t kMostEventBytes = std::size_t{1} << 20U;
constexpr double kLatestEvent = 1e6;  // seconds

// One line; the error does not name it, which the caller adds.
Expected<MusicEvent> parse_event(std::string_view line) {
    const std::string_view time = take_word(line);
    const auto seconds = number_of(time);
    if (!seconds || *seconds < 0.0 || *seconds > kLatestEvent) {
        return fail(
            fmt::format("time is \"{}\", must be seconds from 0 to {}", shown(time), kLatestEvent));
    }
    const auto names = std::span(kMusicEventNames).subspan(1);
    const std::string_view name = take_word(line);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        return fail(
            fmt::format("event is \"{}\", must be {}", shown(name), fmt::join(names, ", ")));
    }
    return MusicEvent{static_cast<MusicEvent::Kind>(found - names.begin() + 1),
                      stream_time_from_seconds(*seconds)};
}

Expected<EventExcerpt> load_event_excerpt(const std::filesystem::path& path) {
    const auto text = read_text_file(path, kMostEventBytes);
    auto events = text ? parse_events(*text, path.string()) : fail(text.error());
    if (!events) {
        return fail(std::move(events.error()));
    }
    if (events->empty()) {
        return fail(path.string() + ": has no events; a song has its entry and its end");
    }
    const std::string name = path.stem().string();
    auto audio = find_sound(path.parent_path(), name);
    if (!audio) {
        return fail(std::move(audio.error()));
    }
    return EventExcerpt{name, std::move(*events), std::move(*audio)};
}

}  // namespace

Expected<std::vector<MusicEvent>> parse_events(std::string_view text, const std::string& file) {
    std::vector<MusicEvent> events;
    TextLines lines(text);
    while (lines.next()) {
        auto event = parse_event(lines.line());
        if (!event) {
            return fail(std::move(event.error()).in(lines.place_in(file)));
        }
        events.push_back(*event);
    }
    std::stable_sort(events.begin(), events.end(), [](const MusicEvent& a, const MusicEvent& b) {
        return a.time < b.time;
    });
    return events;
}

std::string events_text(std::span<const MusicEvent> events) {
    std::string text;
    for (const MusicEvent& event : events) {
        text += fmt::format("{:.6f}\t{}\n", to_seconds(event.time), music_event_name(event.kind));
    }
    return text;
}

Expected<std::vector<EventExcerpt>> load_event_corpus(const std::filesystem::path& folder) {
    auto listed = list_folder(folder);
    if (!listed) {
        return fail(std::move(listed.error()));
    }
    std::vector<EventExcerpt> excerpts;
    for (const std::filesystem::path& path : *listed) {
        if (path.extension() != ".events") {
            continue;
        }
        auto excerpt = load_event_excerpt(path);
        if (!excerpt) {
            return fail(std::move(excerpt.error()));
        }
        excerpts.push_back(std::move(*excerpt));
    }
    if (excerpts.empty()) {
        return fail(folder.string() +
                    ": holds no song with its events: NAME.events beside NAME.ogg");
    }
    return excerpts;
}

}  // namespace raks::audio
