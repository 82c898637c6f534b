#include "engine/setup/settings.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <span>
#include <system_error>
#include <variant>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "base/toml_reader.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Version of the file format that this program reads.
constexpr std::int64_t kVersion = 1;

// A value that is one text, or several.
using Texts = std::vector<std::string>;

// One text stands for itself, several as a list.
std::string toml_texts(const Texts& texts) {
    if (texts.size() == 1) {
        return toml_quoted(texts.front());
    }
    std::string list;
    for (const std::string& text : texts) {
        list += (list.empty() ? "" : ", ") + toml_quoted(text);
    }
    return "[" + list + "]";
}

// "FILE: line N": how errors name a place.
std::string where(const std::string& name, const toml::source_region& source) {
    return fmt::format("{}: line {}", name, source.begin.line);
}

// A text, or a list of texts that is not empty; none: it is something else.
std::optional<Texts> texts_of(const toml::node& node) {
    if (const auto* const text = node.as_string()) {
        return Texts{text->get()};
    }
    const toml::array* const list = node.as_array();
    if (list == nullptr || list->empty()) {
        return std::nullopt;
    }
    Texts texts;
    for (const toml::node& element : *list) {
        const auto* const text = element.as_string();
        if (text == nullptr) {
            return std::nullopt;
        }
        texts.push_back(text->get());
    }
    return texts;
}

// Puts one value of the file into its field; returns the error's message, or nothing.
std::string assign(const SettingRow& row, const toml::node& node, Settings& settings) {
    return std::visit(
        [&](auto field) -> std::string {
            using T = std::remove_reference_t<decltype(settings.*field)>;
            if constexpr (std::is_same_v<T, Texts>) {
                auto texts = texts_of(node);
                if (!texts) {
                    return full_name(row) + " must be a text, or a list of texts";
                }
                settings.*field = std::move(*texts);
                return {};
            } else {
                const std::optional<T> value = node.value<T>();
                // node.value() converts between whole numbers, decimals and truth values; a file
                // must not mean one by another. A whole number for a decimal is fine.
                if (!value || (std::is_same_v<T, std::int64_t> && !node.is_integer()) ||
                    (std::is_same_v<T, bool> && !node.is_boolean())) {
                    constexpr std::string_view kind = std::is_same_v<T, std::string> ? "a text"
                                                      : std::is_same_v<T, bool> ? "true or false"
                                                                                : "a number";
                    return fmt::format("{} must be {}", full_name(row), kind);
                }
                settings.*field = *value;
                return {};
            }
        },
        row.field);
}

// The keys of a file that are unknown: a newer version may have written it, and what it says of
// others holds.
class UnknownKeys {
 public:
    explicit UnknownKeys(std::string file) : file_(std::move(file)) {}

    // The nearest is looked for among `known`.
    void add(const toml::node& node,
             const std::string& key,
             std::span<const std::string_view> known) {
        constexpr std::size_t kMostLines = 5;
        if (++count_ <= kMostLines) {
            const std::string name = printable(key, 60);
            lines_.push_back(fmt::format("{}: key \"{}\" is unknown and ignored{}",
                                         where(file_, node.source()),
                                         name,
                                         suggestion(name, known)));
        }
    }
    [[nodiscard]] SettingsNotes lines() && {
        if (count_ > lines_.size()) {
            lines_.push_back(
                fmt::format("{}: {} more keys are unknown", file_, count_ - lines_.size()));
        }
        return std::move(lines_);
    }

 private:
    std::string file_;
    SettingsNotes lines_;
    std::size_t count_ = 0;
};

// Of the file, in its order.
std::vector<std::string_view> section_names() {
    std::vector<std::string_view> names;
    for (const SettingRow& row : setting_rows()) {
        if (names.empty() || names.back() != row.section) {
            names.push_back(row.section);
        }
    }
    return names;
}

// Reads one section, such as [audio].
Expected<void> read_section(const std::string& name,
                            std::string_view section,
                            const toml::table& table,
                            Settings& settings,
                            UnknownKeys& unknown) {
    const auto rows = setting_rows();
    for (const auto& entry : table) {
        const std::string_view name_in_file = entry.first.str();
        const toml::node& node = entry.second;
        const auto row = std::find_if(rows.begin(), rows.end(), [&](const SettingRow& each) {
            return each.section == section && each.name == name_in_file;
        });
        // The suggestion is looked for among the names of all sections: a key may stand in a wrong
        // one.
        if (row == rows.end()) {
            std::vector<std::string> names;
            std::transform(rows.begin(), rows.end(), std::back_inserter(names), full_name);
            const std::vector<std::string_view> known(names.begin(), names.end());
            unknown.add(node, fmt::format("{}.{}", section, name_in_file), known);
            continue;
        }
        const std::string fault = assign(*row, node, settings);
        if (!fault.empty()) {
            return fail(where(name, node.source()) + ": " + fault);
        }
    }
    return {};
}

// Reads a whole document over `settings`.
Expected<void> read_table(const std::string& name,
                          const toml::table& table,
                          Settings& settings,
                          UnknownKeys& unknown) {
    // Both are optional: a file written by hand may consist of keys alone. They are checked before
    // the keys, so that a newer file is told from one with a mistake.
    const std::int64_t version = table["version"].value_or(kVersion);
    if (table["format"].value_or(std::string("raks-config")) != "raks-config") {
        return fail(name + ": format is not \"raks-config\"; this is another kind of file");
    }
    if (version != kVersion) {
        return fail(fmt::format("{}: version {} is not known to this Raks (it reads version {})",
                                name,
                                version,
                                kVersion));
    }
    for (const auto& entry : table) {
        const std::string_view key = entry.first.str();
        const toml::node& node = entry.second;
        if (key == "format" || key == "version") {
            continue;
        }
        const auto sections = section_names();
        const bool is_section = std::find(sections.begin(), sections.end(), key) != sections.end();
        if (is_section && !node.is_table()) {
            return fail(fmt::format("{}: {} must be a section", where(name, node.source()), key));
        }
        if (!is_section) {
            std::vector<std::string_view> known = sections;
            known.insert(known.end(), {"format", "version"});
            unknown.add(node, std::string(key), known);
            continue;
        }
        if (auto read = read_section(name, key, *node.as_table(), settings, unknown); !read) {
            return read;
        }
    }
    return {};
}

}  // namespace

Expected<SettingsNotes> parse_settings(std::string_view text,
                                       const std::string& name,
                                       Settings& settings) {
    const auto table = parse_toml(text, name);
    if (!table) {
        return fail(table.error());
    }
    // Read into a copy, so that an error leaves the caller's settings as they were.
    Settings result = settings;
    UnknownKeys unknown(name);
    if (auto read = read_table(name, *table, result, unknown); !read) {
        return fail(std::move(read.error()));
    }
    if (const std::vector<std::string> faults = validate(result); !faults.empty()) {
        return fail(name + ": " + faults.front());
    }
    settings = result;
    return std::move(unknown).lines();
}

Expected<SettingsNotes> read_settings(const fs::path& path, Settings& settings) {
    // 1 MiB at most: a wrong file is refused before it fills the memory.
    const auto text = read_text_file(path, std::size_t{1} << 20U);
    if (!text) {
        return fail(text.error());
    }
    return parse_settings(*text, path.string(), settings);
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

std::string to_toml(const Settings& settings) {
    std::string text = fmt::format(
        "# Settings of Raks. Command line options win over this file.\n"
        "format = \"raks-config\"\nversion = {}\n",
        kVersion);
    std::string_view section;
    for (const SettingRow& row : setting_rows()) {
        if (row.section != section) {
            section = row.section;
            text += fmt::format("\n[{}]\n", section);
        }
        const std::string value = std::visit(
            [&](auto field) -> std::string {
                using T = std::decay_t<decltype(settings.*field)>;
                if constexpr (std::is_same_v<T, std::string>) {
                    return toml_quoted(settings.*field);
                } else if constexpr (std::is_same_v<T, Texts>) {
                    return toml_texts(settings.*field);
                } else if constexpr (std::is_same_v<T, double>) {
                    const std::string number = fmt::format("{}", settings.*field);
                    // A decimal point, so that TOML reads the number back as a decimal.
                    return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
                } else {
                    return fmt::format("{}", settings.*field);
                }
            },
            row.field);
        text += fmt::format("{} = {}  # {}\n", row.name, value, help_of(row));
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
    std::vector<fs::path> files;
    if (const auto installed = data_path("config/default.toml")) {
        files.push_back(*installed);
    }
    files.push_back(user_settings_path());
    // The user's file last: it wins.
    for (const fs::path& file : files) {
        std::error_code ignored;
        if (file.empty() || !fs::exists(file, ignored)) {
            continue;
        }
        auto read = read_settings(file, loaded.settings);
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
                    text));
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
    return fail(fmt::format(
        "\"{}\" is no backdrop; write stage, transparent, or a colour such as #00ff00", text));
}

}  // namespace raks::engine
