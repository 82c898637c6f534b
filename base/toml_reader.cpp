#include "base/toml_reader.hpp"

#include <algorithm>

namespace raks {
namespace {

constexpr std::string_view kBlank = " \t";
constexpr std::string_view kNameStarters =  // characters that can begin a key
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-\"'";

bool is_any(char c, std::string_view of) noexcept { return of.find(c) != of.npos; }
bool is_ascii(char c) noexcept { return static_cast<unsigned char>(c) < 128; }

/// Walks over a text line by line and keeps track of strings, comments and brackets.
class HeaderSearch {
 public:
    explicit HeaderSearch(std::string_view text) noexcept : text_(text) {}

    std::size_t line() noexcept {
        std::size_t line = 1;
        while (at_ < text_.size()) {
            // Within a string or brackets a line's "[" is no header.
            if (depth_ == 0 && quote_.empty() && is_nameless_header()) {
                return line;
            }
            skip_line();
            ++line;
        }
        return 0;
    }

 private:
    // Beyond the end: a line end, so that loops stop.
    [[nodiscard]] char peek(std::size_t at) const noexcept {
        return at < text_.size() ? text_[at] : '\n';
    }
    [[nodiscard]] std::size_t after_blank(std::size_t at) const noexcept {
        while (is_any(peek(at), kBlank)) {
            ++at;
        }
        return at;
    }

    /// Does this line begin with brackets and no name? A line with a valid header is skipped to its
    /// end, so that its brackets do not count as open.
    bool is_nameless_header() noexcept {
        std::size_t at = at_;
        // Bytes that are not ASCII may be blanks of Unicode, which the parser skips.
        while (is_any(peek(at), kBlank) || !is_ascii(peek(at))) {
            ++at;
        }
        if (peek(at) != '[') {
            return false;
        }
        at += peek(at + 1) == '[' ? std::size_t{2} : std::size_t{1};
        if (!is_any(peek(after_blank(at)), kNameStarters)) {
            return true;
        }
        at_ = std::min(text_.find('\n', at), text_.size());
        return false;
    }

    // To the start of the next line, with strings and brackets followed.
    void skip_line() noexcept {
        while (at_ < text_.size() && text_[at_] != '\n') {
            if (quote_.empty()) {
                skip_plain();
            } else {
                skip_quoted();
            }
        }
        // Only strings in three quotes go on over the end of a line.
        if (quote_.size() == 1) {
            quote_ = {};  // such a string ends with its line: a fault that the reader names
        }
        ++at_;
    }

    // One character outside strings, or a whole comment.
    void skip_plain() noexcept {
        const char c = text_[at_];
        if (c == '#') {
            at_ = std::min(text_.find('\n', at_), text_.size());
            return;
        }
        if (c == '"' || c == '\'') {
            // Three quotes open a string over several lines.
            const bool is_long = peek(at_ + 1) == c && peek(at_ + 2) == c;
            quote_ = text_.substr(at_, is_long ? 3 : 1);
            at_ += quote_.size();
            return;
        }
        if (is_any(c, "[{")) {
            ++depth_;
        } else if (is_any(c, "]}") && depth_ > 0) {
            --depth_;
        }
        ++at_;
    }

    // Backslashes escape in basic strings ("), not in literal ones (').
    void skip_quoted() noexcept {
        if (text_[at_] == '\\' && quote_.front() == '"' && peek(at_ + 1) != '\n') {
            at_ += 2;
        } else if (text_.substr(at_, quote_.size()) == quote_) {
            at_ += quote_.size();
            quote_ = {};
        } else {
            ++at_;
        }
    }

    std::string_view text_;
    std::string_view quote_;  // of the string that is open; empty: none
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
};

}  // namespace

std::size_t line_of_nameless_header(std::string_view toml) noexcept {
    return HeaderSearch(toml).line();
}

std::string toml_quoted(std::string_view text) {
    std::string quoted = "\"";
    for (const char letter : text) {
        if (static_cast<unsigned char>(letter) < 0x20U || letter == 0x7f) {
            quoted += fmt::format("\\u{:04x}", static_cast<unsigned>(letter));
            continue;
        }
        if (letter == '"' || letter == '\\') {
            quoted += '\\';
        }
        quoted += letter;
    }
    return quoted + '"';
}

}  // namespace raks
