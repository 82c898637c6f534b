#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

/// What the readers of annotations have in common. Threads: any. Real-time: no.
namespace raks::audio {

/// Steps through the lines of a text that have content: lines may end in CRLF, empty lines and
/// lines that start with '#' are skipped. The text outlives it.
class TextLines {
 public:
    /// Before the first line.
    explicit TextLines(std::string_view text) : rest_(text) {}

    /// Goes to the next line with content; false: there is none.
    bool next();
    /// The line, without its end.
    [[nodiscard]] std::string_view line() const noexcept { return line_; }
    /// Where an error occurred: "x.beats: line 7".
    [[nodiscard]] std::string place_in(const std::string& file) const;

 private:
    std::string_view rest_;
    std::string_view line_;
    std::size_t number_ = 0;
};

/// Text of a file as an error shows it: at most 20 characters, all but printable ASCII as '?'.
[[nodiscard]] std::string shown(std::string_view text);

/// Removes the first word (up to a blank or tab) from the start of `line` and returns it; empty at
/// the end of the line.
[[nodiscard]] std::string_view take_word(std::string_view& line);

/// The finite number that a whole word spells, in any locale.
[[nodiscard]] std::optional<double> number_of(std::string_view word);

/// The sound of an annotated piece: NAME.ogg, .wav, .flac, .mp3, .opus or .m4a, the first that
/// exists. Errors: there is none (names them all).
[[nodiscard]] Expected<std::filesystem::path> find_sound(const std::filesystem::path& folder,
                                                         const std::string& name);

}  // namespace raks::audio
