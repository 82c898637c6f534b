#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Lines and words of a text format, as views into the text; independent of the locale.
namespace raks::motion {

/// One line with content.
struct Line {
    std::string_view text;   // without blanks at its ends, never empty
    std::size_t number = 0;  ///< counted from 1
};

/// Whether a character separates words.
[[nodiscard]] inline bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0';
}

/// The text without blanks at its ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

/// The text with ASCII letters in lower case.
[[nodiscard]] inline std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(), [](char c) {
        return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    return result;
}

/// Takes the first word off the text; a brace is a word of its own. Empty at the end.
inline std::string_view take_word(std::string_view& text) {
    text = trimmed(text);
    std::size_t end = 0;
    while (end < text.size() && !is_blank(text[end]) && text[end] != '{' && text[end] != '}') {
        ++end;
    }
    end = std::max<std::size_t>(end, text.empty() ? 0 : 1);
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(end);
    return word;
}

/// The lines of a text that have content; lines end with LF, CR or CRLF.
[[nodiscard]] inline std::vector<Line> split_lines(std::string_view text) {
    std::vector<Line> lines;
    std::size_t number = 1;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
        if (const std::string_view line = trimmed(text.substr(0, end)); !line.empty()) {
            lines.push_back({line, number});
        }
        const bool is_crlf = end + 1 < text.size() && text[end] == '\r' && text[end + 1] == '\n';
        text.remove_prefix(std::min(text.size(), end + (is_crlf ? 2U : 1U)));
        ++number;
    }
    return lines;
}

}  // namespace raks::motion
