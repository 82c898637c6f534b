#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::audio {

/// A text as it is compared with others: parts, each a list of words. Letters are small and without
/// accents, "&" is "and", full stops are left out; blanks, hyphens and other signs part words;
/// ";", ",", "/", "|", "\", "?" (what stands for a control character), brackets and control
/// characters end a part. Bytes that are not UTF-8 count as signs.
///
///     parts_of("Hip-Hop/R&B") == {{"hip", "hop"}, {"r", "and", "b"}}
[[nodiscard]] std::vector<std::vector<std::string>> parts_of(std::string_view text);

/// What words in a file's tags say of its dance: a table that people can edit. Immutable once read.
/// Threads: any may read. Real-time: no.
class GenreWords {
 public:
    /// Which tag a word stands in: some words mean a dance as a genre and anything in a title.
    enum class Place { genre, title, number };
    static constexpr std::size_t kPlaces = 3;
    /// What a row can say besides a dance: music of none of the dances; nothing at all.
    static constexpr std::string_view kFallback = "fallback";
    static constexpr std::string_view kNothing = "none";  ///< see kFallback

    GenreWords() = default;  ///< no words

    /// A row that a text holds.
    struct Found {
        std::string words;       ///< as the row has them
        std::string_view dance;  ///< or kFallback or kNothing; lives as long as the table
        std::size_t count = 0;   ///< words of the text that it covers
    };
    /// The longest row that begins at `words[first]`; count 0: there is none.
    [[nodiscard]] Found longest(Place place,
                                std::span<const std::string> words,
                                std::size_t first) const;

    /// Rows of one place.
    [[nodiscard]] std::size_t size(Place place) const noexcept { return rows_of(place).size(); }

 private:
    friend Expected<GenreWords> parse_genre_words(std::string_view toml,
                                                  const std::string& file,
                                                  std::span<const std::string_view> dances,
                                                  GenreWords under);
    struct Row {
        std::string words;  // as written
        std::string dance;
    };
    // By the words as they are compared, with one blank between two.
    using Rows = std::map<std::string, Row, std::less<>>;
    [[nodiscard]] const Rows& rows_of(Place place) const noexcept {
        return rows_[static_cast<std::size_t>(place)];
    }

    std::array<Rows, kPlaces> rows_;
    std::size_t most_words_ = 0;  // of a row
};

/// Reads TOML: format = "raks-genres", version = 1, and the tables [genre], [title] and [number],
/// in which each row is a word or a phrase (a number of ID3) and the dance that it says, "fallback"
/// or "none". Its rows win over those of `under`. `dances`: the names that rows may say. Errors,
/// one line with file and line: not TOML, another format, a newer version, an unknown table, a row
/// that names no dance, one without a word, one that stands there twice, if only by other letters.
[[nodiscard]] Expected<GenreWords> parse_genre_words(std::string_view toml,
                                                     const std::string& file,
                                                     std::span<const std::string_view> dances,
                                                     GenreWords under = {});
/// Reads and parses a file. Errors: as parse_genre_words and read_text_file.
[[nodiscard]] Expected<GenreWords> load_genre_words(const std::filesystem::path& file,
                                                    std::span<const std::string_view> dances,
                                                    GenreWords under = {});

}  // namespace raks::audio
