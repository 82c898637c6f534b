#include "engine/show/themes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kThemeEnding = ".toml";
constexpr std::size_t kLongestTheme = std::size_t{256} << 10U;  // bytes

// Where themes lie; the first that has a name wins.
std::vector<fs::path> theme_folders() {
    std::vector<fs::path> folders;
    if (fs::path own = own_themes_folder(); !own.empty()) {
        folders.push_back(std::move(own));
    }
    if (const auto shipped = data_path(fs::path("config") / "themes")) {
        folders.push_back(*shipped);
    }
    return folders;
}

// The file of a theme; empty: it has none.
fs::path file_of_theme(std::string_view name) {
    if (name.ends_with(kThemeEnding)) {
        return fs::path(name);
    }
    if (is_plain_name(name)) {
        for (const fs::path& folder : theme_folders()) {
            fs::path file = folder / fmt::format("{}{}", name, kThemeEnding);
            if (is_there(file)) {
                return file;
            }
        }
    }
    return {};
}

// Nodes of a map stay where they are.
std::map<std::string, render::Theme, std::less<>>& kept_themes() {
    static std::map<std::string, render::Theme, std::less<>> kept;
    return kept;
}

}  // namespace

fs::path own_themes_folder() {
    const fs::path folder = xdg_folder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "themes";
}

std::vector<std::string> theme_names() {
    std::vector<std::string> names;
    for (const fs::path& folder : theme_folders()) {
        for (const fs::path& file : list_folder(folder).value_or(std::vector<fs::path>())) {
            std::error_code ignored;
            std::string name = file.stem().string();
            if (file.extension() == kThemeEnding && is_plain_name(name) &&
                fs::is_regular_file(file, ignored)) {
                names.push_back(std::move(name));
            }
        }
    }
    const std::string first = render::default_theme().name;
    std::erase(names, first);
    std::sort(names.begin(), names.end());
    names.erase(std::unique(names.begin(), names.end()), names.end());
    names.insert(names.begin(), first);
    return names;
}

Expected<const render::Theme*> find_theme(std::string_view name) {
    auto& kept = kept_themes();
    if (const auto known = kept.find(name); known != kept.end()) {
        return &known->second;
    }
    const fs::path file = file_of_theme(name);
    if (file.empty()) {
        if (name == render::default_theme().name) {
            return &render::default_theme();
        }
        const std::vector<std::string> names = theme_names();
        const std::vector<std::string_view> known(names.begin(), names.end());
        return fail(unknown_name("theme", name, known));
    }
    const auto text = read_text_file(file, kLongestTheme);
    if (!text) {
        return fail(text.error());
    }
    auto theme = render::parse_theme(*text, printable(name), printable(file.string()));
    if (!theme) {
        return fail(std::move(theme.error()));
    }
    return &kept.emplace(name, std::move(*theme)).first->second;
}

const render::Theme& theme_after(std::string_view name, std::vector<std::string>& lines) {
    std::vector<std::string> names = theme_names();
    const auto at = std::find(names.begin(), names.end(), name);
    if (at != names.end()) {
        std::rotate(names.begin(), at + 1, names.end());
    }
    for (const std::string& next : names) {
        const auto theme = find_theme(next);
        if (theme && (*theme)->is_listed) {
            return **theme;
        }
        if (!theme) {
            lines.push_back(theme.error().message);
        }
    }
    return render::default_theme();
}

}  // namespace raks::engine
