#include "engine/players/player_message.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>
#include <system_error>

#include "base/hash.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::size_t kMostWords = 8;    // of artists and of genres
constexpr std::size_t kMostText = 1024;  // bytes of one of them that are looked at
constexpr int kMostEntries = 256;        // of a dictionary

// The sd-bus call failed.
bool has_failed(int result) { return result < 0; }

std::string_view head_of(const char* text) { return std::string_view(text).substr(0, kMostText); }

// Passes over what was not read, without which a container cannot be left.
bool leave_container(sd_bus_message* message) {
    while (sd_bus_message_at_end(message, 0) == 0) {
        if (sd_bus_message_skip(message, nullptr) <= 0) {
            return false;
        }
    }
    return sd_bus_message_exit_container(message) >= 0;
}

// The type of what stands in the variant; empty: it is none.
std::string_view enter_variant(sd_bus_message* message) {
    const char* contents = nullptr;
    char type = 0;
    if (sd_bus_message_peek_type(message, &type, &contents) <= 0 || type != SD_BUS_TYPE_VARIANT ||
        sd_bus_message_enter_container(message, type, contents) <= 0) {
        return {};
    }
    return contents;
}

// A text, also where a list of texts stands, whose words are put together.
std::string read_words(sd_bus_message* message, std::string_view type) {
    std::string words;
    const char* text = nullptr;
    if (type == "s" || type == "o") {
        if (sd_bus_message_read_basic(message, type.front(), &text) > 0) {
            words = head_of(text);
        }
    } else if (type == "as" && sd_bus_message_enter_container(message, 'a', "s") > 0) {
        for (std::size_t i = 0;
             i < kMostWords && sd_bus_message_read_basic(message, 's', &text) > 0;
             ++i) {
            words += (words.empty() ? "" : ", ") + std::string(head_of(text));
        }
        static_cast<void>(leave_container(message));
    }
    return words;
}

// A number of any type, as text for set_tag(); empty: it is none.
std::string read_number(sd_bus_message* message, std::string_view type) {
    std::int32_t i32 = 0;
    std::uint32_t u32 = 0;
    std::int64_t i64 = 0;
    std::uint64_t u64 = 0;
    double real = 0.0;
    const auto read = [&](auto& number) {
        return sd_bus_message_read_basic(message, type.front(), &number) > 0
                   ? fmt::format("{}", number)
                   : std::string();
    };
    return type == "i"   ? read(i32)
           : type == "u" ? read(u32)
           : type == "x" ? read(i64)
           : type == "t" ? read(u64)
           : type == "d" ? read(real)
                         : read_words(message, type);
}

// Calls take(name, type) at the value of each entry of a dictionary; what it leaves is skipped.
// False: it is no such dictionary.
template <typename Take>
bool read_dictionary(sd_bus_message* message, const Take& take) {
    if (sd_bus_message_enter_container(message, 'a', "{sv}") <= 0) {
        return false;
    }
    for (int i = 0; i < kMostEntries; ++i) {
        const int entry = sd_bus_message_enter_container(message, 'e', "sv");
        if (entry == 0) {
            break;
        }
        const char* name = nullptr;
        if (has_failed(entry) || sd_bus_message_read_basic(message, 's', &name) <= 0) {
            return false;
        }
        const std::string_view type = enter_variant(message);
        if (type.empty() || !take(std::string_view(name), type)) {
            return false;
        }
        if (!leave_container(message) || !leave_container(message)) {
            return false;
        }
    }
    return leave_container(message);
}

// What names the song, and what is told of it.
struct SongEntry {
    std::string_view name;
    std::string_view tag;  // empty: it names the song
};
constexpr std::array kSongEntries = std::to_array<SongEntry>({{"mpris:trackid", ""},
                                                              {"xesam:url", ""},
                                                              {"xesam:title", "title"},
                                                              {"xesam:artist", "artist"},
                                                              {"xesam:album", "album"},
                                                              {"xesam:genre", "genre"},
                                                              {"xesam:audioBPM", "bpm"}});

bool read_song(sd_bus_message* message, PlayerSong& song) {
    // In the order of the table, whatever the message's is.
    std::array<std::string, 2> names;
    const bool is_read =
        read_dictionary(message, [&](std::string_view name, std::string_view type) {
            const auto entry = std::find_if(kSongEntries.begin(),
                                            kSongEntries.end(),
                                            [&](const auto& row) { return row.name == name; });
            if (entry == kSongEntries.end()) {
                return sd_bus_message_skip(message, std::string(type).c_str()) >= 0;
            }
            const std::string value =
                entry->tag == "bpm" ? read_number(message, type) : read_words(message, type);
            if (entry->tag.empty()) {
                names[static_cast<std::size_t>(entry - kSongEntries.begin())] = value;
            } else {
                audio::set_tag(song.tags, entry->tag, value);
            }
            return true;
        });
    if (!names[0].empty() || !names[1].empty()) {
        song.key = hash_of(names[1], hash_of(names[0]));
        song.file = local_file_of(names[1]);
    }
    return is_read;
}

std::optional<char> character_of(std::string_view two_digits) {
    unsigned value = 0;
    const char* const end = two_digits.data() + two_digits.size();
    const auto [stopped, error] = std::from_chars(two_digits.data(), end, value, 16);
    return two_digits.size() == 2 && error == std::errc() && stopped == end && value != 0
               ? std::optional(static_cast<char>(value))
               : std::nullopt;
}

std::optional<PlayStatus> status_of(std::string_view word) {
    return word == "Playing"   ? std::optional(PlayStatus::playing)
           : word == "Paused"  ? std::optional(PlayStatus::paused)
           : word == "Stopped" ? std::optional(PlayStatus::stopped)
                               : std::nullopt;
}

}  // namespace

// RFC 8089 with an empty authority, or this machine's; RFC 3986 for what is percent-encoded.
std::string local_file_of(std::string_view url) {
    constexpr std::string_view kScheme = "file://";
    if (!url.starts_with(kScheme)) {
        return {};
    }
    url.remove_prefix(kScheme.size());
    if (constexpr std::string_view kHost = "localhost"; url.starts_with(kHost)) {
        url.remove_prefix(kHost.size());
    }
    if (!url.starts_with('/')) {
        return {};
    }
    std::string path;
    for (std::size_t i = 0; i < url.size(); ++i) {
        if (url[i] != '%') {
            path += url[i];
            continue;
        }
        const auto character = character_of(url.substr(i + 1, 2));
        if (!character) {
            return {};
        }
        path += *character;
        i += 2;
    }
    return path;
}

Expected<PlayerNews> read_player_properties(sd_bus_message* message) {
    PlayerNews news;
    const bool is_read =
        read_dictionary(message, [&](std::string_view name, std::string_view type) {
            if (name == "PlaybackStatus") {
                news.status = status_of(read_words(message, type));
            } else if (name == "Metadata" && type == "a{sv}") {
                return read_song(message, news.song.emplace());
            } else {
                return sd_bus_message_skip(message, std::string(type).c_str()) >= 0;
            }
            return true;
        });
    return is_read ? Expected<PlayerNews>(std::move(news))
                   : fail("its properties are no properties");
}

bool names_player_property(sd_bus_message* message) {
    bool names_it = false;
    const char* name = nullptr;
    if (sd_bus_message_enter_container(message, 'a', "s") <= 0) {
        return false;
    }
    for (int i = 0; i < kMostEntries && sd_bus_message_read_basic(message, 's', &name) > 0; ++i) {
        const std::string_view word = name;
        names_it = names_it || word == "PlaybackStatus" || word == "Metadata";
    }
    return names_it;
}

}  // namespace raks::engine
