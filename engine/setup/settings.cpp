#include "engine/setup/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/toml_reader.hpp"
#include "engine/setup/settings_reader.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestShown = 60;  // bytes of a wrong value in an error

// The installed file names every setting: of those that are as they are built in it says nothing.
std::string origin_in_words(const SettingRow& row, const Settings& settings) {
    const SettingOrigin& origin = origin_of(settings, row.field);
    const bool is_default = origin.rank == SettingRank::installed &&
                            toml_value(row, settings) == toml_value(row, Settings{});
    return in_words(is_default ? SettingOrigin{} : origin);
}

}  // namespace

Expected<SettingsNotes> parse_settings(std::string_view text,
                                       const std::string& name,
                                       Settings& settings,
                                       SettingRank rank) {
    const auto table = parse_toml(text, name);
    if (!table) {
        return fail(table.error());
    }
    // Read into a copy, so that an error leaves the caller's settings as they were.
    Settings result = settings;
    auto notes = read_settings_table(*table, name, {.rank = rank}, result);
    if (!notes) {
        return notes;
    }
    if (const std::vector<std::string> faults = validate(result); !faults.empty()) {
        return fail(name + ": " + faults.front());
    }
    settings = std::move(result);
    return notes;
}

Expected<SettingsNotes> read_settings(const fs::path& path, Settings& settings, SettingRank rank) {
    // A wrong file is refused before it fills the memory.
    const auto text = read_text_file(path, kLongestSettings);
    if (!text) {
        return fail(text.error());
    }
    return parse_settings(*text, path.string(), settings, rank);
}

std::vector<std::string> validate(const Settings& settings) {
    std::vector<std::string> faults;
    for (const SettingRow& row : setting_rows()) {
        if (std::string fault = fault_of(row, settings); !fault.empty()) {
            faults.push_back(std::move(fault));
        }
    }
    if (settings.avatars.size() > kMostAvatars) {
        faults.push_back(fmt::format(
            "picture.avatar names {} avatars, at most {}", settings.avatars.size(), kMostAvatars));
    }
    if (const auto size = parse_size(settings.size); !size) {
        faults.push_back("picture.size: " + size.error().message);
    }
    if (const auto backdrop = parse_backdrop(settings.backdrop); !backdrop) {
        faults.push_back("picture.backdrop: " + backdrop.error().message);
    }
    return faults;
}

std::string to_toml(const Settings& settings, TomlComments comments) {
    std::string text = fmt::format(
        "# Settings of Raks. Command line options win over this file.\n"
        "format = \"raks-config\"\nversion = {}\n",
        kSettingsVersion);
    std::string_view section;
    for (const SettingRow& row : setting_rows()) {
        if (row.section != section) {
            section = row.section;
            text += fmt::format("\n[{}]\n", section);
        }
        text += fmt::format(
            "{} = {}  # {}\n",
            row.name,
            toml_value(row, settings),
            comments == TomlComments::help ? help_of(row) : origin_in_words(row, settings));
    }
    return text;
}

fs::path user_settings_path() {
    const fs::path folder = xdg_folder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "config.toml";
}

fs::path user_cache_path() { return xdg_folder("XDG_CACHE_HOME", ".cache"); }

Expected<LoadedSettings> load_settings() {
    LoadedSettings loaded;
    std::vector<std::pair<fs::path, SettingRank>> files;
    if (const auto installed = data_path("config/default.toml")) {
        files.emplace_back(*installed, SettingRank::installed);
    }
    // The user's file last: it wins.
    files.emplace_back(user_settings_path(), SettingRank::config);
    for (const auto& [file, rank] : files) {
        std::error_code ignored;
        if (file.empty() || !fs::exists(file, ignored)) {
            continue;
        }
        auto read = read_settings(file, loaded.settings, rank);
        if (!read) {
            return fail(read.error());
        }
        loaded.notes.insert(loaded.notes.end(), read->begin(), read->end());
    }
    return loaded;
}

Expected<fs::path> data_path(const fs::path& relative) {
    std::vector<fs::path> roots;
    // The search order: what the person names, the installation, the source tree of a build.
    if (const char* root = std::getenv("RAKS_DATA");  // NOLINT(concurrency-mt-unsafe): see above
        root != nullptr && *root != '\0') {
        roots.emplace_back(root);
    }
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
    if (!error) {
        // As installed: PREFIX/bin/raks and PREFIX/share/raks.
        roots.push_back(program / ".." / "share" / "raks");
        // From a build folder: each folder above it, up to the root of the source tree.
        for (fs::path folder = program; folder.has_relative_path(); folder = folder.parent_path()) {
            roots.push_back(folder);
        }
    }
    for (const fs::path& root : roots) {
        if (fs::exists(root / relative, error)) {
            // Without "bin/../share" in it, for error messages.
            return (root / relative).lexically_normal();
        }
    }
    return fail(relative.string() +
                ": is not installed beside the program; set RAKS_DATA to the folder that holds it");
}

Expected<PictureSize> parse_size(std::string_view text) {
    PictureSize size;
    const std::size_t x = text.find('x');
    const char* const end = text.data() + text.size();
    const auto is_side = [](int pixels) { return pixels >= 16 && pixels <= 7680; };
    // Both numbers must use up their text: "1280x720p" is refused.
    if (x != std::string_view::npos) {
        const auto width = std::from_chars(text.data(), text.data() + x, size.width);
        const auto height = std::from_chars(text.data() + x + 1, end, size.height);
        if (width.ptr == text.data() + x && height.ptr == end && is_side(size.width) &&
            is_side(size.height)) {
            return size;
        }
    }
    return fail(
        fmt::format("\"{}\" is not a picture size; write WIDTHxHEIGHT, 16 to 7680 each, "
                    "such as 1280x720",
                    printable(text, kLongestShown)));
}

Expected<AskedBackdrop> parse_backdrop(std::string_view text) {
    if (text == "stage") {
        return AskedBackdrop{};
    }
    if (text == "transparent") {
        return AskedBackdrop{.is_stage = false};
    }
    constexpr std::size_t kColour = 7;  // characters, as "#00ff00"
    std::uint32_t rgb = 0;
    if (text.size() == kColour && text.front() == '#') {
        const auto [read, error] = std::from_chars(text.data() + 1, text.data() + kColour, rgb, 16);
        if (error == std::errc() && read == text.data() + kColour) {
            const auto part = [rgb](unsigned shift) {
                return static_cast<std::uint8_t>(rgb >> shift & 0xFFU);
            };
            return AskedBackdrop{.is_stage = false, .key = {{part(16), part(8), part(0)}}};
        }
    }
    return fail(
        fmt::format("\"{}\" is no backdrop; write stage, transparent, or a colour such as #00ff00",
                    printable(text, kLongestShown)));
}

}  // namespace raks::engine
