#include "base/text_file.hpp"

#include <algorithm>
#include <string_view>

#include "base/file.hpp"

namespace raks {
namespace {

/// Turns "\r\n" and "\r" into "\n", in place: a "\r" before "\n" is dropped, a lone one replaced.
void unify_line_ends(std::string& text) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_pair = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (!is_pair) {
            text[kept++] = text[i] == '\r' ? '\n' : text[i];
        }
    }
    text.resize(kept);
}

}  // namespace

Expected<std::string> read_text_file(const std::filesystem::path& path, std::size_t max_bytes) {
    constexpr std::string_view kUtf8Mark = "\xef\xbb\xbf";
    auto text = read_file(path, max_bytes);
    if (!text) {
        return text;
    }
    // Before the zero byte, which UTF-16 also has, because this message helps more.
    if (text->starts_with("\xff\xfe") || text->starts_with("\xfe\xff")) {
        return fail(path.string() + ": is UTF-16 text; save it as UTF-8");
    }
    if (const std::size_t zero = text->find('\0'); zero != std::string::npos) {
        const auto line =
            1 + std::count(text->begin(), text->begin() + static_cast<std::ptrdiff_t>(zero), '\n');
        return fail(path.string() + ": line " + std::to_string(line) +
                    ": holds a zero byte: it is damaged, or no UTF-8 text");
    }
    if (text->starts_with(kUtf8Mark)) {
        text->erase(0, kUtf8Mark.size());
    }
    unify_line_ends(*text);
    return text;
}

}  // namespace raks
