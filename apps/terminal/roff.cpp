#include "apps/terminal/roff.hpp"

#include <algorithm>
#include <cstddef>
#include <regex>

namespace raks::apps {

std::string roff_text(std::string_view text) {
    std::string roff;
    bool begins_line = true;
    for (const char c : text) {
        // A dot or an apostrophe that begins a line would be a request.
        if (begins_line && (c == '.' || c == '\'')) {
            roff += "\\&";
        }
        begins_line = c == '\n';
        if (c == '\\') {
            roff += "\\e";
        } else if (c == '-') {
            roff += "\\-";
        } else {
            roff += c;
        }
    }
    return roff;
}

std::string roff_bold(std::string_view text) { return "\\fB" + roff_text(text) + "\\fP"; }
std::string roff_italic(std::string_view text) { return "\\fI" + roff_text(text) + "\\fP"; }

std::string roff_of_markdown(std::string_view paragraph) {
    static const std::regex kLink("\\[([^\\]]*)\\]\\([^)]*\\)");
    const std::string text = std::regex_replace(std::string(paragraph), kLink, "$1");
    std::string roff;
    // Every second piece between backticks is code.
    bool is_code = false;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t end = std::min(text.find('`', at), text.size());
        const std::string piece = text.substr(at, end - at);
        if (is_code && !piece.empty()) {
            roff += roff_bold(piece);
        } else if (!is_code) {
            roff += roff.empty() || roff.ends_with('\n') ? roff_text(piece)
                                                         : roff_text(" " + piece).substr(1);
        }
        is_code = !is_code;
        at = end + 1;
    }
    return roff;
}

}  // namespace raks::apps
