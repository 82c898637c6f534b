#include "render/import/wanted_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "base/printable.hpp"
#include "render/import/characters.hpp"

namespace raks::render {
namespace {

constexpr std::string_view kMaterials = ".mtl";
constexpr std::array<std::string_view, 8> kEndings = {
    ".png", ".jpg", ".jpeg", ".webp", ".bmp", ".tga", kMaterials, ".bin"};
constexpr unsigned kBeyondAscii = 0x80;  // stands for all that are

/// In small letters, with its dot; empty: none.
std::string ending_of(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    std::string ending(dot == std::string_view::npos ? "" : name.substr(dot));
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return ending;
}

/// A character as a text spells it.
struct Spelt {
    unsigned character = 0;  ///< kBeyondAscii at most
    std::size_t size = 1;    ///< bytes of the text
};

/// The character itself.
Spelt itself(std::string_view text) {
    return {.character = std::min<unsigned>(static_cast<unsigned char>(text[0]), kBeyondAscii)};
}

/// What a number with so many hexadecimal digits after `start` bytes stands for.
Spelt by_digits(std::string_view text, std::size_t start, std::size_t digits) {
    const std::string_view number = text.substr(start, digits);
    unsigned code = 0;
    const char* const end = number.data() + number.size();
    const auto read = std::from_chars(number.data(), end, code, 16);
    const bool is_whole = read.ec == std::errc() && read.ptr == end && number.size() == digits;
    return is_whole ? Spelt{.character = std::min(code, kBeyondAscii), .size = start + digits}
                    : itself(text);
}

/// What "&amp;" or "&#233;" stands for.
Spelt by_entity(std::string_view text) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kEntities = {
        {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
    constexpr std::size_t kLongest = 10;
    const std::size_t end = text.substr(0, kLongest).find(';');
    if (end == std::string_view::npos) {
        return itself(text);
    }
    const std::string_view name = text.substr(1, end - 1);
    for (const auto& [entity, character] : kEntities) {
        if (name == entity) {
            return {.character = static_cast<unsigned char>(character), .size = end + 1};
        }
    }
    // Names of files are not written in ASCII by number.
    return name.substr(0, 1) == "#" ? Spelt{.character = kBeyondAscii, .size = end + 1}
                                    : itself(text);
}

/// The first character of a text that is not empty.
Spelt first_spelt(std::string_view text) {
    if (text[0] == '%') {
        return by_digits(text, 1, 2);
    }
    if (text[0] == '\\' && text.substr(1, 1) == "u") {
        return by_digits(text, 2, 4);
    }
    return text[0] == '&' ? by_entity(text) : itself(text);
}

/// Whether a text begins with a name.
bool begins_with_name(std::string_view text, std::string_view name) {
    while (!name.empty() && !text.empty()) {
        const unsigned wanted =
            std::min<unsigned>(static_cast<unsigned char>(name[0]), kBeyondAscii);
        const Spelt spelt = first_spelt(text);
        if (spelt.character != wanted) {
            return false;
        }
        name.remove_prefix(1);
        text.remove_prefix(spelt.size);
        // As many bytes as there are: "\u00e9" is one here and two in the name.
        while (wanted == kBeyondAscii && !name.empty() &&
               static_cast<unsigned char>(name[0]) >= kBeyondAscii) {
            name.remove_prefix(1);
        }
        while (wanted == kBeyondAscii && !text.empty() &&
               first_spelt(text).character == kBeyondAscii) {
            text.remove_prefix(first_spelt(text).size);
        }
    }
    return name.empty();
}

/// Of UTF-16 every other byte, as a name in it would be spelt without.
std::string without_zeros(std::string_view text) {
    std::string kept;
    std::copy_if(
        text.begin(), text.end(), std::back_inserter(kept), [](char c) { return c != '\0'; });
    return kept;
}

bool is_utf16(std::string_view text) {
    const std::string_view mark = text.substr(0, 2);
    return mark == "\xFF\xFE" || mark == "\xFE\xFF";
}

}  // namespace

bool spells_name(std::string_view text, std::string_view name) {
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (begins_with_name(text.substr(at), name)) {
            return true;
        }
    }
    return false;
}

WantedFiles::WantedFiles(std::span<const std::byte> model, const SideFiles& side)
    : side_(side), model_(model) {
    if (is_utf16(characters_of(model))) {
        texts_.push_back(without_zeros(characters_of(model)));
    }
}

bool WantedFiles::is_named(std::string_view name) const {
    return spells_name(characters_of(model_), name) ||
           std::any_of(texts_.begin(), texts_.end(), [name](const std::string& text) {
               return spells_name(text, name);
           });
}

Expected<std::vector<std::byte>> WantedFiles::read(std::string_view uri, std::size_t max_bytes) {
    if (is_data_uri(uri)) {
        return read_data_uri(uri, max_bytes);
    }
    const auto names = side_path(uri);
    if (!names) {
        return fail(names.error());
    }
    const std::string& name = names->back();
    const std::string ending = ending_of(name);
    if (std::find(kEndings.begin(), kEndings.end(), ending) == kEndings.end()) {
        return fail(
            fmt::format("\"{}\" is not a picture of a kind that Raks reads", printable(uri, 80)));
    }
    if (!is_named(name)) {
        return fail(fmt::format("\"{}\" is not a file that the model names", printable(uri, 80)));
    }
    auto bytes = side_.read(uri, max_bytes);
    if (bytes && ending == kMaterials) {
        texts_.emplace_back(characters_of(*bytes));
    }
    return bytes;
}

}  // namespace raks::render
