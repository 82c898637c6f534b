#include "engine/setup/user_folders.hpp"

#include <cstdlib>
#include <string>
#include <system_error>

#include "base/file.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Larger files are no list of a few folders.
constexpr std::size_t kMostBytes = 65'536;

// Takes the value of a shell's assignment in double quotes: a backslash stands before what is meant
// as it is.
std::string unquoted(std::string_view text) {
    std::string value;
    for (std::size_t i = 1; i < text.size() && text[i] != '"'; ++i) {
        i += text[i] == '\\' && i + 1 < text.size() ? 1U : 0U;
        value += text[i];
    }
    return value;
}

}  // namespace

fs::path user_folder_in(std::string_view user_dirs, std::string_view name, const fs::path& home) {
    const std::string key = std::string(name) + "=\"";
    fs::path folder;
    while (!user_dirs.empty()) {
        const std::size_t end = std::min(user_dirs.find('\n'), user_dirs.size());
        const std::string_view line = user_dirs.substr(0, end);
        user_dirs.remove_prefix(std::min(end + 1, user_dirs.size()));
        if (!line.starts_with(key)) {
            continue;
        }
        const std::string value = unquoted(line.substr(key.size() - 1));
        constexpr std::string_view kHome = "$HOME";
        const bool is_below_home = value.starts_with("$HOME/") || value == kHome;
        if (is_below_home && !home.empty()) {
            folder = home / fs::path(value.substr(kHome.size())).relative_path();
        } else {
            folder = value.starts_with('/') ? fs::path(value) : fs::path();
        }
    }
    return folder;
}

fs::path xdg_folder(const char* variable, const fs::path& below_home) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): see the header
    if (const char* const folder = std::getenv(variable); folder != nullptr && *folder == '/') {
        return fs::path(folder) / "raks";
    }
    // NOLINTNEXTLINE(concurrency-mt-unsafe)
    if (const char* const home = std::getenv("HOME"); home != nullptr && *home == '/') {
        return home / below_home / "raks";
    }
    return {};
}

fs::path pictures_folder() {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing calls setenv
    const char* const variable = std::getenv("HOME");
    const fs::path home = variable != nullptr && *variable == '/' ? variable : "";
    std::error_code ignored;
    const fs::path settings = user_settings_path();
    // user-dirs.dirs lies beside the folder of our settings.
    if (!settings.empty()) {
        const fs::path file = settings.parent_path().parent_path() / "user-dirs.dirs";
        const auto text = read_file(file, kMostBytes);
        fs::path folder = user_folder_in(text.value_or(""), "XDG_PICTURES_DIR", home);
        if (!folder.empty() && fs::is_directory(folder, ignored)) {
            return folder;
        }
    }
    const fs::path usual = home / "Pictures";
    return !home.empty() && fs::is_directory(usual, ignored) ? usual : fs::path();
}

}  // namespace raks::engine
