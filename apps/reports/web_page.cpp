#include "apps/reports/web_page.hpp"

#include <algorithm>

#include "base/utf8.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// The style sheet of all reports. The widths of `.three`, `.row` and `.take` fit the charts.
constexpr std::string_view kStyle =
    "body{margin:0;background:#fff;color:#334155;"
    "font:15px/1.5 Inter,Helvetica,Arial,sans-serif}\n"
    "main{width:1200px;margin:0 auto;padding:36px 20px 60px}\n"
    "h1{font-size:30px;line-height:1.2;margin:0 0 6px;color:#0f172a;font-weight:650}\n"
    "h2{font-size:22px;margin:56px 0 2px;color:#0f172a;border-top:1px solid #cbd5e1;"
    "padding-top:26px;font-weight:650}\n"
    "h3{font-size:16px;margin:28px 0 2px;color:#0f172a;font-weight:650}\n"
    "h4{font-size:13px;margin:0 0 2px;font-weight:650}\n"
    "p{margin:2px 0 12px;max-width:860px}\n"
    ".sub{color:#64748b}\n"
    ".three{display:grid;grid-template-columns:repeat(3,380px);gap:10px 30px}\n"
    ".row{display:flex;gap:13px}\n"
    ".over{font-size:12px;color:#64748b;margin:2px 0 0 46px}\n"
    ".feature{font-size:13px;color:#334155;margin:10px 0 2px 40px}\n"
    ".take{font-size:12px;color:#64748b;width:250px;padding-left:40px}\n"
    "svg{display:block}\n"
    "svg .frame{fill:#f8fafc;stroke:#cbd5e1}\n"
    "svg .grid{stroke:#e2e8f0;fill:none}\n"
    "svg text{font-size:11px;fill:#64748b}\n"
    "svg .label{text-anchor:middle;font-size:12px}\n"
    "svg .mark{text-anchor:middle;font-size:10px}\n"
    "table{border-collapse:collapse;font-variant-numeric:tabular-nums;font-size:14px}\n"
    "th{font-weight:600;color:#475569;text-align:right;padding:4px 12px;font-size:13px}\n"
    "td{text-align:right;padding:4px 12px}\n"
    "th:first-child,td:first-child{text-align:left;padding-left:0}\n"
    "tbody tr{border-top:1px solid #e2e8f0}\n"
    ".tables{display:flex;flex-wrap:wrap;gap:28px 44px;align-items:flex-start}\n"
    ".own{background:#dcfce7;color:#14532d;font-weight:600}\n"
    ".wrong{background:#fee2e2;color:#7f1d1d}\n"
    ".none{color:#cbd5e1}\n"
    "caption{text-align:left;font-weight:650;color:#0f172a;font-size:14px;padding-bottom:4px}\n";

// Bytes of the character at the start of `text`; 0 where there is none of UTF-8, and for U+FFFE and
// U+FFFF, which XML forbids.
std::size_t character_size(std::string_view text) noexcept {
    const std::size_t size = utf8_size(text);
    const std::string_view character = text.substr(0, size);
    return character == "\xEF\xBF\xBE" || character == "\xEF\xBF\xBF" ? 0 : size;
}

}  // namespace

// Byte by byte where the text is invalid, so that one bad byte costs one replacement character.
std::string xml_text(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const std::size_t length = character_size(text);
        const char first = text.front();
        if (length == 0) {
            out += "\xEF\xBF\xBD";
        } else if (first == '&') {
            out += "&amp;";
        } else if (first == '<') {
            out += "&lt;";
        } else if (first == '>') {
            out += "&gt;";
        } else if (first == '"') {
            out += "&quot;";
        } else if (length == 1 && (first < ' ' || first == '\x7F')) {
            out += ' ';
        } else {
            out += text.substr(0, length);
        }
        text.remove_prefix(std::max<std::size_t>(1, length));
    }
    return out;
}

std::string web_page(std::string_view title, std::string_view body) {
    const std::string text = xml_text(title);
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<title>{}</title>\n<style>\n{}</style>\n</head>\n<body>\n<main>\n<h1>{}</h1>\n{}"
        "</main>\n</body>\n</html>\n",
        text,
        kStyle,
        text,
        body);
}

}  // namespace raks::apps
