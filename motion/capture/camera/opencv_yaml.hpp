// OpenCV's YAML, as far as files of cameras need it: keys with a word, a list of words or a matrix.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

/// Of OpenCV's FileStorage only what is needed is understood: keys at the outermost level, and for
/// a matrix those within. Threads: any. Real-time: no.
namespace raks::capture {

/// The value of a key at the outermost level.
struct YamlEntry {
    std::size_t line = 0;
    std::string value;                                      ///< lines that go on are joined
    std::map<std::string, std::string, std::less<>> inner;  ///< of a matrix: rows, cols, dt, data
};

/// A text as its keys, with messages that name the file and the line.
class YamlEntries {
 public:
    /// `name`: the file's, for messages. Errors: more than 1 MiB, a text that does not begin with
    /// %YAML, a key that is there twice.
    [[nodiscard]] static Expected<YamlEntries> parse(std::string_view text, std::string name);

    /// A key's entry. Errors: there is none.
    [[nodiscard]] Expected<const YamlEntry*> entry(std::string_view key) const;
    /// Whether there is such a key.
    [[nodiscard]] bool has(std::string_view key) const { return entries_.contains(key); }
    /// A size of a picture: a whole number from 1 to 65,535.
    [[nodiscard]] Expected<int> picture_size(std::string_view key) const;
    /// The numbers of a matrix, row by row. Errors: none there, without rows, cols and data, with
    /// another count of numbers than those say, numbers that are none or not finite.
    [[nodiscard]] Expected<std::vector<double>> matrix(std::string_view key) const;
    /// A list of words: one a line behind a dash, or [ a, b ]; without quotes.
    [[nodiscard]] Expected<std::vector<std::string>> words(std::string_view key) const;
    /// The file's line of an entry, and what is wrong with it.
    [[nodiscard]] std::string complaint(std::string_view key, std::string_view what) const;
    /// The file's name.
    [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
    std::map<std::string, YamlEntry, std::less<>> entries_;
    std::string name_;
};

/// What stands behind the key of a matrix.
inline constexpr std::string_view kYamlMatrixTag = "!!opencv-matrix";
/// The longest such file that is read; bytes.
inline constexpr std::size_t kLongestYaml = std::size_t{1} << 20U;

}  // namespace raks::capture
