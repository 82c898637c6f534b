#include "audio/genre/genre_words.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "base/file.hpp"
#include "base/toml_reader.hpp"
#include "base/utf8.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr std::size_t kMostTableBytes = std::size_t{1} << 20U;
constexpr std::int64_t kGenreWordsVersion = 1;
// In the order of GenreWords::Place.
constexpr std::array<std::string_view, GenreWords::kPlaces> kPlaceNames = {
    "genre", "title", "number"};

// Letters of U+00C0 to U+017F without their accents; '.' is no letter.
constexpr std::string_view kPlainLatin =
    "aaaaaaaceeeeiiiidnooooo.ouuuuytsaaaaaaaceeeeiiiidnooooo.ouuuuyty"
    "aaaaaaccccccccddddeeeeeeeeeegggggggghhhhiiiiiiiiiiiijjkkkllllllllllnnnnnnnnnoooooooo"
    "rrrrrrssssssssttttttuuuuuuuuuuuuwwyyyzzzzzzs";
static_assert(kPlainLatin.size() == 0x180 - 0xC0);

// Where a row stands, and its words.
using Line = std::pair<std::size_t, std::string>;

// What a character does to the words around it.
enum class Sign { letter, gap, left_out, end_of_part };

char32_t code_of(std::string_view character) {
    constexpr std::array<unsigned, 5> kFirstBits = {0, 0x7FU, 0x1FU, 0x0FU, 0x07U};
    char32_t code = static_cast<unsigned char>(character.front()) & kFirstBits[character.size()];
    for (const char next : character.substr(1)) {
        code = (code << 6U) | (static_cast<unsigned char>(next) & 0x3FU);
    }
    return code;
}

// Small Greek and Cyrillic letters are their large ones moved.
char32_t small_letter(char32_t code) {
    const bool is_moved = (code >= 0x391 && code <= 0x3A9) || (code >= 0x410 && code <= 0x42F);
    return is_moved ? code + 0x20 : code >= 0x400 && code <= 0x40F ? code + 0x50 : code;
}

std::string utf8_of_two_bytes(char32_t code) {
    return {static_cast<char>(0xC0U | (code >> 6U)), static_cast<char>(0x80U | (code & 0x3FU))};
}

Sign sign_of_ascii(char c) {
    constexpr std::string_view kEnds = ";,/|\\?()[]{}<>:\n\r";
    const bool is_letter =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
    return is_letter                                                           ? Sign::letter
           : c == '.'                                                          ? Sign::left_out
           : kEnds.find(c) != std::string_view::npos || c < ' ' || c == '\x7F' ? Sign::end_of_part
                                                                               : Sign::gap;
}

Sign sign_of(char32_t code) {
    constexpr char32_t kFullSlash = 0xFF0F;
    constexpr char32_t kFullSemicolon = 0xFF1B;
    constexpr char32_t kIdeographicComma = 0x3001;
    if (code == kFullSlash || code == kFullSemicolon || code == kIdeographicComma) {
        return Sign::end_of_part;
    }
    // Accents that stand behind their letter.
    if (code >= 0x300 && code <= 0x36F) {
        return Sign::left_out;
    }
    const bool is_gap = code < 0xC0 || code == 0xD7 || code == 0xF7 ||
                        (code >= 0x2000 && code <= 0x206F) || (code >= 0x3000 && code <= 0x303F) ||
                        code == 0x30FB || code == 0xFEFF;
    return is_gap ? Sign::gap : Sign::letter;
}

// Gathers words and parts.
class Parts {
 public:
    void add(std::string_view letters) { word_ += letters; }
    void end_word() {
        if (!word_.empty()) {
            part_.push_back(std::move(word_));
            word_.clear();
        }
    }
    void end_part() {
        end_word();
        if (!part_.empty()) {
            parts_.push_back(std::move(part_));
            part_.clear();
        }
    }
    [[nodiscard]] std::vector<std::vector<std::string>> take() {
        end_part();
        return std::move(parts_);
    }

 private:
    std::string word_;
    std::vector<std::string> part_;
    std::vector<std::vector<std::string>> parts_;
};

void add_ascii(char c, Parts& parts) {
    if (c == '&') {
        parts.end_word();
        parts.add("and");
        parts.end_word();
        return;
    }
    switch (sign_of_ascii(c)) {
        case Sign::letter: {
            const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
            parts.add({&small, 1});
            break;
        }
        case Sign::gap:
            parts.end_word();
            break;
        case Sign::end_of_part:
            parts.end_part();
            break;
        case Sign::left_out:
            break;
    }
}

void add_beyond_ascii(std::string_view character, Parts& parts) {
    const char32_t code = code_of(character);
    const Sign sign = sign_of(code);
    if (sign == Sign::end_of_part) {
        parts.end_part();
    } else if (sign == Sign::gap) {
        parts.end_word();
    } else if (sign == Sign::left_out) {
        return;
    } else if (code < 0x180) {
        parts.add(kPlainLatin.substr(code - 0xC0, 1));
    } else if (character.size() == 2) {
        parts.add(utf8_of_two_bytes(small_letter(code)));
    } else {
        parts.add(character);
    }
}

// A row's words as they are compared; empty: it has none, or is more than one part.
std::string key_of(std::string_view words) {
    const auto parts = parts_of(words);
    return parts.size() == 1 ? fmt::format("{}", fmt::join(parts.front(), " ")) : std::string();
}

// A row as the file has it.
struct TableRow {
    std::string key;  // its words as they are compared
    std::string words;
    std::string dance;
};

// `known`: what a row may say.
std::vector<TableRow> rows_of_table(const toml::table& table,
                                    std::span<const std::string_view> known,
                                    TomlComplaints& complaints) {
    std::vector<TableRow> rows;
    std::map<std::string, Line> lines;
    for (const auto& [words, value] : table) {
        const Line here{words.source().begin.line, printable(words.str(), 60)};
        complaints.enter(fmt::format("\"{}\"", here.second));
        std::string key = key_of(words.str());
        if (key.empty()) {
            complaints.complain(here.first, "must be one word or phrase");
            continue;
        }
        // TOML itself refuses the same letters twice. Its tables are sorted by their keys.
        if (const auto [twin, is_new] = lines.emplace(key, here); !is_new) {
            const auto [first, second] = std::minmax({twin->second, here});
            complaints.enter(fmt::format("\"{}\"", second.second));
            complaints.complain(second.first,
                                fmt::format("is the same as the row of line {}", first.first));
        }
        const std::string_view dance = known[complaints.word(value, "dance", known)];
        rows.push_back({std::move(key), std::string(words.str()), std::string(dance)});
    }
    complaints.enter("");
    return rows;
}

}  // namespace

std::vector<std::vector<std::string>> parts_of(std::string_view text) {
    Parts parts;
    while (!text.empty()) {
        const std::size_t size = utf8_size(text);
        if (size == 0) {
            parts.end_word();
        } else if (size == 1) {
            add_ascii(text.front(), parts);
        } else {
            add_beyond_ascii(text.substr(0, size), parts);
        }
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return parts.take();
}

GenreWords::Found GenreWords::longest(Place place,
                                      std::span<const std::string> words,
                                      std::size_t first) const {
    const Rows& rows = rows_of(place);
    Found found;
    std::string key;
    for (std::size_t count = 1; count <= most_words_ && first + count <= words.size(); ++count) {
        key += (count > 1 ? " " : "") + words[first + count - 1];
        if (const auto row = rows.find(key); row != rows.end()) {
            found = {row->second.words, row->second.dance, count};
        }
    }
    return found;
}

Expected<GenreWords> parse_genre_words(std::string_view toml,
                                       const std::string& file,
                                       std::span<const std::string_view> dances,
                                       GenreWords under) {
    const auto root = parse_toml(toml, file);
    if (!root) {
        return fail(root.error());
    }
    TomlComplaints complaints(file);
    complaints.check_head(*root, "raks-genres", kGenreWordsVersion);
    std::vector<std::string_view> keys = {"format", "version"};
    keys.insert(keys.end(), kPlaceNames.begin(), kPlaceNames.end());
    complaints.check_keys(*root, keys);
    std::vector<std::string_view> known(dances.begin(), dances.end());
    known.insert(known.end(), {GenreWords::kFallback, GenreWords::kNothing});
    for (std::size_t place = 0; place < kPlaceNames.size(); ++place) {
        const toml::node* const node = root->get(kPlaceNames[place]);
        if (node != nullptr && !node->is_table()) {
            complaints.complain(*node, fmt::format("{} must be a table", kPlaceNames[place]));
        } else if (node != nullptr) {
            for (TableRow& row : rows_of_table(*node->as_table(), known, complaints)) {
                const auto words = std::count(row.key.begin(), row.key.end(), ' ') + 1;
                under.most_words_ = std::max(under.most_words_, static_cast<std::size_t>(words));
                under.rows_[place][row.key] = {std::move(row.words), std::move(row.dance)};
            }
        }
    }
    return complaints.is_sound() ? Expected<GenreWords>(std::move(under))
                                 : fail(complaints.fault());
}

Expected<GenreWords> load_genre_words(const std::filesystem::path& file,
                                      std::span<const std::string_view> dances,
                                      GenreWords under) {
    const auto text = read_text_file(file, kMostTableBytes);
    return text ? parse_genre_words(*text, file.string(), dances, std::move(under))
                : fail(text.error());
}

}  // namespace raks::audio
