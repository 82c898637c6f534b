#include "engine/setup/list_forms.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <map>
#include <pugixml.hpp>
#include <utility>

#include "base/utf8.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

char lower(char letter) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
}

std::string lower_case(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), lower);
    return result;
}

// Without blanks at both ends.
std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string_view::npos
               ? std::string_view{}
               : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

// Appends a character as UTF-8.
void append_utf8(std::string& text, std::uint32_t character) {
    const auto continuation = [&](unsigned shift) {
        text += static_cast<char>(0x80U | ((character >> shift) & 0x3FU));
    };
    if (character < 0x80U) {
        text += static_cast<char>(character);
    } else if (character < 0x800U) {
        text += static_cast<char>(0xC0U | (character >> 6U));
        continuation(0);
    } else if (character < 0x10000U) {
        text += static_cast<char>(0xE0U | (character >> 12U));
        continuation(6);
        continuation(0);
    } else {
        text += static_cast<char>(0xF0U | (character >> 18U));
        continuation(12);
        continuation(6);
        continuation(0);
    }
}

// What Windows-1252 has between 0x80 and 0x9F; the rest of it is Latin-1. Places without a
// character stay what they are in Latin-1.
constexpr std::array<std::uint16_t, 32> kWindows1252 = {
    0x20AC, 0x81,   0x201A, 0x0192, 0x201E, 0x2026, 0x2020, 0x2021, 0x02C6, 0x2030, 0x0160,
    0x2039, 0x0152, 0x8D,   0x017D, 0x8F,   0x90,   0x2018, 0x2019, 0x201C, 0x201D, 0x2022,
    0x2013, 0x2014, 0x02DC, 0x2122, 0x0161, 0x203A, 0x0153, 0x9D,   0x017E, 0x0178};

std::string from_windows_1252(std::string_view text) {
    std::string result;
    for (const char letter : text) {
        const auto byte = static_cast<unsigned char>(letter);
        append_utf8(result, byte >= 0x80U && byte < 0xA0U ? kWindows1252[byte - 0x80U] : byte);
    }
    return result;
}

// UTF-16 as UTF-8; halves of pairs without their other half become U+FFFD.
std::string from_utf16(std::string_view bytes, bool is_big_endian) {
    const auto unit = [&](std::size_t i) {
        const auto first = static_cast<unsigned char>(bytes[i]);
        const auto second = static_cast<unsigned char>(bytes[i + 1]);
        return static_cast<std::uint32_t>(is_big_endian ? first << 8U | second
                                                        : second << 8U | first);
    };
    constexpr std::uint32_t kReplacement = 0xFFFD;
    std::string result;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) {
        std::uint32_t character = unit(i);
        const bool is_high = character >= 0xD800U && character < 0xDC00U;
        const bool has_low =
            is_high && i + 3 < bytes.size() && unit(i + 2) >= 0xDC00U && unit(i + 2) < 0xE000U;
        if (has_low) {
            character = 0x10000U + ((character - 0xD800U) << 10U) + (unit(i + 2) - 0xDC00U);
            i += 2;
        } else if (character >= 0xD800U && character < 0xE000U) {
            character = kReplacement;
        }
        append_utf8(result, character);
    }
    return result;
}

// The text behind its byte-order mark, UTF-16 as UTF-8. Errors: a zero byte, which no text has.
Expected<std::string> as_text(std::string_view bytes) {
    std::string text;
    if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff")) {
        text = from_utf16(bytes.substr(2), bytes[0] == '\xfe');
    } else {
        text = bytes.substr(bytes.starts_with("\xef\xbb\xbf") ? 3 : 0);
    }
    if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
        const auto end = text.begin() + static_cast<std::ptrdiff_t>(zero);
        return fail(fmt::format("line {}: holds a zero byte: it is damaged, or not a playlist",
                                1 + std::count(text.begin(), end, '\n')));
    }
    return text;
}

// Calls take(line, number) for each line, whatever ends it, until it returns false. Blanks at both
// ends of a line are cut off.
template <typename Take>
void for_each_line(std::string_view text, Take take) {
    std::size_t number = 0;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        ++number;
        if (!take(trimmed(text.substr(0, end)), number)) {
            return;
        }
        const bool is_pair = text.substr(end).starts_with("\r\n");
        text.remove_prefix(std::min(text.size(), end + (is_pair ? 2U : 1U)));
    }
}

// A name as it is and, where it is no UTF-8, as an older program may have meant it.
ListEntry entry_of(std::string_view name) {
    ListEntry entry = {std::string(name)};
    if (!is_utf8(name)) {
        entry.push_back(from_windows_1252(name));
    }
    return entry;
}

// Appends an entry; false when there is no room for more.
bool add_entry(ListEntries& list, ListEntry entry) {
    list.is_cut = list.entries.size() >= kMostListEntries;
    if (!list.is_cut) {
        list.entries.push_back(std::move(entry));
    }
    return !list.is_cut;
}

Expected<ListEntries> parse_m3u(std::string_view text) {
    ListEntries list;
    bool is_of_pieces = false;
    for_each_line(text, [&](std::string_view line, std::size_t) {
        is_of_pieces = is_of_pieces || line.starts_with("#EXT-X-");
        if (line.empty() || line.starts_with('#')) {
            return true;
        }
        return add_entry(list, entry_of(line));
    });
    if (is_of_pieces) {
        return fail("lists the pieces of a stream (HLS), not songs; save the stream as a file");
    }
    return list;
}

Expected<ListEntries> parse_pls(std::string_view text) {
    // By their numbers: the lines may stand in any order.
    std::map<std::uint64_t, ListEntry> files;
    bool is_list = false;
    std::size_t wrong_line = 0;
    bool is_cut = false;
    for_each_line(text, [&](std::string_view line, std::size_t number) {
        if (line.empty() || line.starts_with(';') || line.starts_with('#')) {
            return true;
        }
        if (!is_list) {
            // The head comes first, or it is another kind of file.
            is_list = lower_case(line) == "[playlist]";
            wrong_line = is_list ? 0 : number;
            return is_list;
        }
        const std::size_t equals = line.find('=');
        const std::string key = lower_case(trimmed(line.substr(0, equals)));
        std::uint64_t index = 0;
        const char* const end = key.data() + key.size();
        const bool is_file = equals != std::string_view::npos && key.starts_with("file") &&
                             std::from_chars(key.data() + 4, end, index).ptr == end &&
                             key.size() > 4;
        const std::string_view name = is_file ? trimmed(line.substr(equals + 1)) : "";
        if (!name.empty()) {
            is_cut = files.size() >= kMostListEntries;
            files.insert_or_assign(index, entry_of(name));
        }
        return !is_cut;
    });
    if (!is_list) {
        return fail(fmt::format("line {}: does not say [playlist]: it is not a .pls playlist",
                                std::max<std::size_t>(1, wrong_line)));
    }
    ListEntries list;
    list.is_cut = is_cut;
    for (auto& [index, entry] : files) {
        list.entries.push_back(std::move(entry));
    }
    return list;
}

// The name of an element without its namespace: "location" of "x:location".
std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
}

// The first child of that name, whatever its namespace.
pugi::xml_node child_of(const pugi::xml_node& parent, std::string_view name) {
    return parent.find_child(
        [name](const pugi::xml_node& node) { return local_name(node) == name; });
}

// The places of one track, as file names: its addresses are percent-encoded.
ListEntry places_of(const pugi::xml_node& track) {
    ListEntry places;
    for (const pugi::xml_node& node : track.children()) {
        const std::string_view text = trimmed(node.text().get());
        if (local_name(node) != "location" || text.empty()) {
            continue;
        }
        // Others wrote plain names there: both readings are tried.
        if (scheme_of(text).empty() && !lower_case(text).starts_with("file:")) {
            const std::string decoded = percent_decoded(text);
            if (decoded != text && decoded.find('\0') == std::string::npos) {
                places.push_back(decoded);
            }
        }
        places.emplace_back(text);
    }
    return places;
}

// pugixml reads no document types, entities of one's own or other files.
Expected<ListEntries> parse_xspf(std::string_view text) {
    pugi::xml_document document;
    const auto encoding = is_utf8(text) ? pugi::encoding_utf8 : pugi::encoding_latin1;
    const pugi::xml_parse_result parsed =
        document.load_buffer(text.data(), text.size(), pugi::parse_default, encoding);
    if (!parsed) {
        const auto at = std::min(
            static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, parsed.offset)), text.size());
        return fail(fmt::format(
            "line {}: is not the XML of a playlist: {}",
            1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'),
            lower_case(parsed.description())));
    }
    const pugi::xml_node tracks = child_of(child_of(document, "playlist"), "trackList");
    if (!tracks) {
        return fail("has no <trackList> in a <playlist>: it is not an .xspf playlist");
    }
    ListEntries list;
    for (const pugi::xml_node& track : tracks.children()) {
        if (local_name(track) != "track") {
            continue;
        }
        ListEntry places = places_of(track);
        const bool has_room = places.empty() || add_entry(list, std::move(places));
        if (!has_room) {
            break;
        }
    }
    return list;
}

}  // namespace

std::optional<ListForm> list_form_of(const std::filesystem::path& path) {
    const std::string ending = lower_case(path.extension().string());
    if (ending == ".m3u" || ending == ".m3u8") {
        return ListForm::m3u;
    }
    if (ending == ".pls") {
        return ListForm::pls;
    }
    return ending == ".xspf" ? std::optional(ListForm::xspf) : std::nullopt;
}

Expected<ListEntries> parse_list(std::string_view bytes, ListForm form) {
    const auto text = as_text(bytes);
    if (!text) {
        return fail(text.error());
    }
    switch (form) {
        case ListForm::m3u:
            return parse_m3u(*text);
        case ListForm::pls:
            return parse_pls(*text);
        case ListForm::xspf:
            break;
    }
    return parse_xspf(*text);
}

std::string_view scheme_of(std::string_view name) {
    const std::size_t colon = name.find("://");
    if (colon == std::string_view::npos || colon < 2) {  // one letter is a drive
        return {};
    }
    const std::string_view scheme = name.substr(0, colon);
    const bool is_scheme = std::isalpha(static_cast<unsigned char>(scheme.front())) != 0 &&
                           std::all_of(scheme.begin(), scheme.end(), [](char letter) {
                               return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
                                      letter == '+' || letter == '-' || letter == '.';
                           });
    return is_scheme && lower_case(scheme) != "file" ? scheme : std::string_view{};
}

std::string percent_decoded(std::string_view text) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned byte = 0;
        const char* const first = text.data() + i + 1;
        const bool is_code = text[i] == '%' && i + 2 < text.size() &&
                             std::from_chars(first, first + 2, byte, 16).ptr == first + 2;
        result += is_code ? static_cast<char>(byte) : text[i];
        i += is_code ? 2U : 0U;
    }
    return result;
}

std::string file_of_address(std::string_view name) {
    constexpr std::string_view kFile = "file:";
    if (name.size() < kFile.size() || lower_case(name.substr(0, kFile.size())) != kFile) {
        return std::string(name);
    }
    std::string_view path = name.substr(kFile.size());
    // "//host/path": of the hosts only this one is read.
    if (path.starts_with("//")) {
        const std::size_t slash = path.find('/', 2);
        path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash);
    }
    std::string decoded = percent_decoded(path);
    return decoded.find('\0') == std::string::npos && !decoded.empty() ? decoded
                                                                       : std::string(name);
}

}  // namespace raks::engine
