#include "base/toml_reader.hpp"

#include <algorithm>

#include "base/printable.hpp"

namespace raks {
namespace {

constexpr std::size_t kLongestMessage = 200;  // bytes of the library's own words

bool is_any(char c, std::string_view of) noexcept { return of.find(c) != of.npos; }

/// Looks for what must not reach the parser: a key of too many parts, on which it would build a
/// tree as deep; letters that are not ASCII outside of strings and comments, where TOML has none
/// and some of which toml++ 3.3 takes for impossible (undefined behaviour). Walks over a text and
/// keeps track of strings and comments, in which dots mean nothing.
class TrapSearch {
 public:
    explicit TrapSearch(std::string_view text) noexcept : text_(text) {
        constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
        at_ = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
    }

    /// Where the first is; npos: there is none.
    std::size_t place() noexcept {
        while (at_ < text_.size()) {
            if (!quote_.empty()) {
                skip_quoted();
            } else if (!is_foreign(text_[at_]) && !is_dot_too_many()) {
                skip_plain();
            } else {
                return at_;
            }
        }
        return std::string_view::npos;
    }
    static bool is_foreign(char c) noexcept { return (static_cast<unsigned char>(c) & 0x80U) != 0; }

 private:
    // Beyond the end: a line end, so that loops stop.
    [[nodiscard]] char peek(std::size_t at) const noexcept {
        return at < text_.size() ? text_[at] : '\n';
    }

    // A key ends with its line, and where a value, a list or another key begins.
    bool is_dot_too_many() noexcept {
        if (text_[at_] == '.') {
            return ++dots_ >= kMostKeyParts;
        }
        dots_ = is_any(text_[at_], "\n=[]{},") ? 0 : dots_;
        return false;
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
        ++at_;
    }

    // Backslashes escape in basic strings ("), not in literal ones ('). A string in single quotes
    // that its line leaves open is a fault that the parser names.
    void skip_quoted() noexcept {
        if (text_[at_] == '\n' && quote_.size() == 1) {
            quote_ = {};
        } else if (text_[at_] == '\\' && quote_.front() == '"' && peek(at_ + 1) != '\n') {
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
    std::size_t dots_ = 0;  // of the key that is being walked over
};

/// The line and column of a byte, from 1.
std::string place_of(std::string_view text, std::size_t at) {
    const std::string_view before = text.substr(0, at);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    return fmt::format("line {}, column {}", line, at - (before.rfind('\n') + 1) + 1);
}

/// What to say of a place at which the parser lost its way.
std::string message_of(const TomlSurprise& surprise, std::string_view text) {
    if (surprise.line == 0) {
        return place_of(text, text.size()) + ": the file ends in the middle";
    }
    const std::string place = fmt::format("line {}, column {}", surprise.line, surprise.column);
    const bool is_shown = surprise.found > U' ' && surprise.found < 127;
    return is_shown
               ? fmt::format("{}: '{}' cannot stand here", place, static_cast<char>(surprise.found))
               : place + ": something is missing here";
}

}  // namespace

Expected<toml::table> parse_toml(std::string_view text, const std::string& name) {
    if (text.size() > kLongestToml) {
        return fail(fmt::format("{}: has {} bytes, more than {}", name, text.size(), kLongestToml));
    }
    if (const std::size_t at = TrapSearch(text).place(); at != std::string_view::npos) {
        const std::string what =
            TrapSearch::is_foreign(text[at])
                ? std::string("letters beyond ASCII stand only in quotes and comments")
                : fmt::format("a key of more than {} parts", kMostKeyParts);
        return fail(fmt::format("{}: {}: {}", name, place_of(text, at), what));
    }
    // toml++ reports faults by exceptions, which end here.
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        const toml::source_position at = error.source().begin;
        // The library quotes what it found, which may be anything.
        return fail(fmt::format("{}: line {}, column {}: {}",
                                name,
                                at.line,
                                at.column,
                                printable(error.description(), kLongestMessage)));
    } catch (const TomlSurprise& surprise) {
        return fail(fmt::format("{}: {}", name, message_of(surprise, text)));
    }
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
