#pragma once

#include <string>
#include <string_view>

/// Text in the language of manual pages.
namespace raks::apps {

/// Plain text as it is: no sign of it means anything to roff. "--out" stays two hyphens.
[[nodiscard]] std::string roff_text(std::string_view text);

/// A paragraph of our documents, which are Markdown: code is bold, of a link its text stays.
[[nodiscard]] std::string roff_of_markdown(std::string_view paragraph);

/// In bold, and in italics.
[[nodiscard]] std::string roff_bold(std::string_view text);
[[nodiscard]] std::string roff_italic(std::string_view text);

}  // namespace raks::apps
