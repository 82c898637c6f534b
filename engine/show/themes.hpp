#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "render/scene/theme.hpp"

/// Themes by name: files of the person's own folder, then those that come with Raks.
namespace raks::engine {

/// $XDG_CONFIG_HOME/raks/themes, or below ~/.config. Empty: neither variable names an absolute
/// path. Threads: main.
[[nodiscard]] std::filesystem::path own_themes_folder();

/// The names of all themes whose files there are, the default first, the others sorted.
/// Threads: main. Real-time: no.
[[nodiscard]] std::vector<std::string> theme_names();

/// A theme by its name or, for a text that ends with ".toml", its file. Never null; lives as long
/// as the program. A file is read once. Errors: an unknown name, with the nearest known one; those
/// of reading and of render::parse_theme(). Threads: main. Real-time: no.
[[nodiscard]] Expected<const render::Theme*> find_theme(std::string_view name);

/// The one that a key goes to from a theme: the next of theme_names() that is listed. What cannot
/// be read on the way is passed over and told in `lines`. Threads: main. Real-time: no.
[[nodiscard]] const render::Theme& theme_after(std::string_view name,
                                               std::vector<std::string>& lines);

}  // namespace raks::engine
