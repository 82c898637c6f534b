#include "engine/setup/user_folders.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <ctime>
#include <string>
#include <system_error>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "engine/setup/settings.hpp"

#include <fmt/format.h>

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

Expected<fs::path> private_temporary_folder() {
    fs::path folder = temporary_folder() / fmt::format("raks-{}", ::geteuid());
    // Where it is there already, what it is decides.
    const bool is_made = ::mkdir(folder.c_str(), 0700) == 0;
    const std::error_code why_not(errno, std::generic_category());
    struct stat status {};
    if (::lstat(folder.c_str(), &status) != 0) {
        return fail(folder.string() + ": cannot be made: " + why_not.message());
    }
    if (!is_made && (!S_ISDIR(status.st_mode) || status.st_uid != ::geteuid() ||
                     (status.st_mode & 0777U) != 0700U)) {
        return fail(
            folder.string() +
            ": is not used: it is not a folder that only you may enter, and others may have "
            "put something there; set HOME or XDG_CACHE_HOME to a folder of yours");
    }
    return folder;
}

Expected<fs::path> kept_folder(const fs::path& name) {
    if (const fs::path cache = user_cache_path(); !cache.empty()) {
        fs::path folder = cache / name;
        if (make_folders(folder) && ::access(folder.c_str(), W_OK) == 0) {
            return folder;
        }
    }
    auto folder = private_temporary_folder();
    if (!folder) {
        return folder;
    }
    *folder /= name;
    auto made = make_folders(*folder);
    return made ? std::move(folder) : fail(std::move(made.error()));
}

namespace {

// A person's folder of one kind: as user-dirs.dirs names it, else as desktops call it.
fs::path folder_of(std::string_view name, const char* usual_name) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing calls setenv
    const char* const variable = std::getenv("HOME");
    const fs::path home = variable != nullptr && *variable == '/' ? variable : "";
    std::error_code ignored;
    const fs::path settings = user_settings_path();
    // user-dirs.dirs lies beside the folder of our settings.
    if (!settings.empty()) {
        const fs::path file = settings.parent_path().parent_path() / "user-dirs.dirs";
        const auto text = read_file(file, kMostBytes);
        fs::path folder = user_folder_in(text.value_or(""), name, home);
        if (!folder.empty() && fs::is_directory(folder, ignored)) {
            return folder;
        }
    }
    const fs::path usual = home / usual_name;
    return !home.empty() && fs::is_directory(usual, ignored) ? usual : fs::path();
}

}  // namespace

fs::path pictures_folder() { return folder_of("XDG_PICTURES_DIR", "Pictures"); }

fs::path videos_folder() { return folder_of("XDG_VIDEOS_DIR", "Videos"); }

fs::path dated_file(const fs::path& folder, std::string_view ending) {
    const std::time_t now = std::time(nullptr);
    // localtime_r: localtime() would share its result with other threads.
    std::tm local{};
    localtime_r(&now, &local);
    const std::string stem = fmt::format("raks-{:04}{:02}{:02}-{:02}{:02}{:02}",
                                         local.tm_year + 1900,
                                         local.tm_mon + 1,
                                         local.tm_mday,
                                         local.tm_hour,
                                         local.tm_min,
                                         local.tm_sec);
    fs::path path = folder / fmt::format("{}{}", stem, ending);
    std::error_code error;
    // Several within one second get -2, -3 and so on.
    for (int i = 2; fs::exists(path, error); ++i) {
        path = folder / fmt::format("{}-{}{}", stem, i, ending);
    }
    return path;
}

}  // namespace raks::engine
