#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// What `format` must say in a file of styles.
inline constexpr std::string_view kStylesFormat = "raks-styles";
/// Highest `version` that this reader knows.
inline constexpr int kStylesVersion = 1;

/// The text of one file of styles.
struct StyleText {
    std::string name;  ///< for errors
    std::string text;  ///< TOML; its form: docs/reference/files.md, raks-styles
};

/// Reads all .toml files of a folder as one book. Each may hold rhythms, palettes and corpus
/// styles. Files are taken in the order of their `order = N`, those without one last, those of one
/// number by name; rhythms in the order of their file.
///
/// Errors, of the first fault, one line with file and line: no such folder, or no .toml file in it;
/// a file that cannot be read; another format, a newer version; an unknown key or name (with the
/// nearest known one); a number out of range; a pattern that does not fit its cell; two rhythms of
/// one name, two palettes of one dance; a dance without a palette, no palette for none. Threads:
/// any. Real-time: no.
[[nodiscard]] Expected<StyleBook> load_styles(const std::filesystem::path& folder);

/// The same for texts in memory; those of one number stay in the order given. `name`: what errors
/// that belong to no single file call the whole.
[[nodiscard]] Expected<StyleBook> parse_styles(std::span<const StyleText> files,
                                               const std::string& name);

}  // namespace raks::audio
