#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "audio/music/styles/style_book.hpp"
#include "base/expected.hpp"

namespace raks::audio {

inline constexpr std::string_view kStylesFormat = "raks-styles";
inline constexpr int kStylesVersion = 1;

/// A file of styles that was read already.
struct StyleText {
    std::string name;  ///< for errors
    std::string text;  ///< TOML; its form: docs/reference/files.md, raks-styles
};

/// Reads all .toml files of a folder as one book. Any of them may hold rhythms, palettes and corpus
/// styles. The book has the files by their `order = N`, those without one last, files of one
/// number by their names; rhythms as they stand in their file.
/// Errors, of the first fault, one line with file and line: no such folder, or no .toml file in it;
/// what cannot be read; another format, a newer version; an unknown key or name (with the nearest
/// known one); a number out of range; a pattern that does not fit its cell; two rhythms of one
/// name, two palettes of one dance; a dance without a palette, no palette for none.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<StyleBook> load_styles(const std::filesystem::path& folder);

/// The same of texts; those of one number stay in the order that they are given in. `name`: what
/// the whole is called in errors that are of no one file.
[[nodiscard]] Expected<StyleBook> parse_styles(std::span<const StyleText> files,
                                               const std::string& name);

}  // namespace raks::audio
