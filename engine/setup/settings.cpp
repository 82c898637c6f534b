#include "engine/setup/settings.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <span>
#include <system_error>
#include <variant>

#include "base/file.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "base/toml_reader.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Version of the file format that this program reads.
constexpr std::int64_t kVersion = 1;

// A value that is one text, or several.
using Texts = std::vector<std::string>;

// A pointer to the member that a key sets: one of five types of value.
using Member = std::variant<std::string Settings::*,
                            Texts Settings::*,
                            double Settings::*,
                            std::int64_t Settings::*,
                            bool Settings::*>;

// One key of the file: where it stands, which member it sets, the range of a number (0, 0 for other
// types) and the comment that to_toml() writes behind it.
struct Key {
    std::string_view section;
    std::string_view name;
    Member member;
    double low = 0.0;
    double high = 0.0;
    std::string_view help;
};

// The order is that of the file that to_toml() writes, section by section.
const std::array kKeys = std::to_array<Key>({
    {"audio", "device", &Settings::device, 0, 0, "input of `raks live`; empty: chosen"},
    {"audio", "output", &Settings::output, 0, 0, "loudspeaker of `raks play`; empty: the default"},
    {"audio", "audio_system", &Settings::audio_system, 0, 0, "auto, portaudio, jack or pulse"},
    {"audio",
     "buffer_ms",
     &Settings::buffer_ms,
     0,
     2000,
     "of the device's buffer; 0: 40 for a loudspeaker, longer after a gap"},
    {"audio",
     "latency_offset_ms",
     &Settings::latency_offset_ms,
     -500,
     500,
     "added to the latency that the device reports"},
    {"audio", "volume", &Settings::volume, 0, 2, "1 is the file's own level"},
    {"dance", "dance", &Settings::dance, 0, 0, "auto, or the dance to keep to"},
    {"dance",
     "fallback_dance",
     &Settings::fallback_dance,
     0,
     0,
     "danced when nothing is recognised: a dance, keep (the dance that is on) or stand"},
    {"dance", "figures", &Settings::figures, 0, 0, "learnt as angles or positions of the joints"},
    {"dance",
     "formation",
     &Settings::formation,
     0,
     0,
     "solo, couple, unison, canon, free, grid, ring or v"},
    {"dance",
     "dancers",
     &Settings::dancers,
     0,
     kMostAvatars,
     "0: as many as the formation has, and one for each avatar; solo and couple have their own"},
    {"dance", "generator", &Settings::generator, 0, 0, "trajectories, or frames: the paper's"},
    {"dance",
     "dynamics",
     &Settings::dynamics,
     0,
     0,
     "on, or off: nothing but the beat is followed"},
    // 9e15: below 2^53, so that a seed survives the comparison in double.
    {"dance", "seed", &Settings::seed, 0, 9e15, "same seed, same dance"},
    {"dance",
     "pose_lead_ms",
     &Settings::pose_lead_ms,
     -200,
     200,
     "pictures show the pose this much ahead"},
    {"picture",
     "avatar",
     &Settings::avatars,
     0,
     0,
     "mannequin, a file (.vrm, .glb, .gltf, .3ds, .fbx, .dae, .obj), or a name in the folder of "
     "avatars; or a list of them, worn in turn"},
    {"picture", "avatar_height", &Settings::avatar_height, 0, 10, "metres; 0: its own"},
    {"picture",
     "avatar_labels",
     &Settings::avatar_labels,
     0,
     0,
     "file that says which nodes of the avatar are its bones; empty: they are found"},
    {"picture", "theme", &Settings::theme, 0, 0, "stage, workshop_dark, studio_light or plain"},
    {"picture",
     "dress",
     &Settings::dress,
     0,
     0,
     "what the mannequin wears, in every theme: dancer or mannequin"},
    {"picture",
     "camera",
     &Settings::camera,
     0,
     0,
     "director, or still: wide, portrait, front or side"},
    {"picture",
     "calm",
     &Settings::calm,
     0,
     0,
     "calmer pictures: fewer cuts, and light that changes slowly and little"},
    {"picture", "size", &Settings::size, 0, 0, "WIDTHxHEIGHT"},
    {"picture", "fps", &Settings::fps, 1, 240, "pictures a second"},
    {"picture", "quality", &Settings::quality, 0, 0, "auto, fast or high"},
    {"picture",
     "view",
     &Settings::view,
     0,
     0,
     "skin, stick, or auto: stick when danced by positions"},
    {"picture", "face_blink", &Settings::face_blink, 0, 0, "eyes blink by themselves"},
    {"picture", "face_mouth", &Settings::face_mouth, 0, 0, "the mouth opens with the music"},
    {"picture",
     "face_gaze",
     &Settings::face_gaze,
     0,
     0,
     "eyes look at the camera, in a couple at each other"},
    {"picture", "overlay", &Settings::overlay, 0, 0, "beat, tempo and levels over the picture"},
});

// "audio.volume": how errors name a key.
std::string full_name(const Key& key) { return fmt::format("{}.{}", key.section, key.name); }

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

// Puts one value of the file into its member; returns the error's message, or nothing.
std::string assign(const Key& key, const toml::node& node, Settings& settings) {
    return std::visit(
        [&](auto member) -> std::string {
            using T = std::remove_reference_t<decltype(settings.*member)>;
            if constexpr (std::is_same_v<T, Texts>) {
                auto texts = texts_of(node);
                if (!texts) {
                    return full_name(key) + " must be a text, or a list of texts";
                }
                settings.*member = std::move(*texts);
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
                    return fmt::format("{} must be {}", full_name(key), kind);
                }
                settings.*member = *value;
                return {};
            }
        },
        key.member);
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

// Reads one section, such as [audio].
Expected<void> read_section(const std::string& name,
                            std::string_view section,
                            const toml::table& table,
                            Settings& settings,
                            UnknownKeys& unknown) {
    for (const auto& entry : table) {
        const std::string_view name_in_file = entry.first.str();
        const toml::node& node = entry.second;
        const auto key = std::find_if(kKeys.begin(), kKeys.end(), [&](const Key& k) {
            return k.section == section && k.name == name_in_file;
        });
        // The suggestion is looked for among the names of all sections: a key may stand in a wrong
        // one.
        if (key == kKeys.end()) {
            std::vector<std::string> names;
            std::transform(kKeys.begin(), kKeys.end(), std::back_inserter(names), full_name);
            const std::vector<std::string_view> known(names.begin(), names.end());
            unknown.add(node, fmt::format("{}.{}", section, name_in_file), known);
            continue;
        }
        const std::string fault = assign(*key, node, settings);
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
        const bool is_section =
            std::any_of(kKeys.begin(), kKeys.end(), [&](const Key& k) { return k.section == key; });
        if (is_section && !node.is_table()) {
            return fail(fmt::format("{}: {} must be a section", where(name, node.source()), key));
        }
        if (!is_section) {
            constexpr std::array<std::string_view, 5> kKnown = {
                "audio", "dance", "picture", "format", "version"};
            unknown.add(node, std::string(key), kKnown);
            continue;
        }
        if (auto read = read_section(name, key, *node.as_table(), settings, unknown); !read) {
            return read;
        }
    }
    return {};
}

// A setting whose value must be one of a few names.
struct Name {
    std::string_view key;
    std::string Settings::*member;
    std::span<const std::string_view> known;
};

constexpr std::array<std::string_view, 4> kAudioSystems = {"auto", "portaudio", "jack", "pulse"};
constexpr std::array<std::string_view, 2> kGenerators = {"trajectories", "frames"};
constexpr std::array<std::string_view, 2> kOnOff = {"on", "off"};
constexpr std::array<std::string_view, 3> kQualities = {"auto", "fast", "high"};
constexpr std::array<std::string_view, 3> kViews = {"auto", "skin", "stick"};
constexpr std::array<std::string_view, 2> kFigures = {"angles", "positions"};
constexpr std::array<std::string_view, 2> kDresses = {"dancer", "mannequin"};

// Themes, cameras, dances and formations are checked where their tables are.
const std::array kNames = std::to_array<Name>({
    {"audio.audio_system", &Settings::audio_system, kAudioSystems},
    {"dance.generator", &Settings::generator, kGenerators},
    {"dance.dynamics", &Settings::dynamics, kOnOff},
    {"picture.quality", &Settings::quality, kQualities},
    {"picture.view", &Settings::view, kViews},
    {"picture.dress", &Settings::dress, kDresses},
    {"dance.figures", &Settings::figures, kFigures},
});

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
    for (const Key& key : kKeys) {
        // Every number against its range; the texts have their own checks below.
        double value = 0.0;
        if (const auto* real = std::get_if<double Settings::*>(&key.member)) {
            value = settings.**real;
        } else if (const auto* whole = std::get_if<std::int64_t Settings::*>(&key.member)) {
            value = static_cast<double>(settings.**whole);
        } else {
            continue;
        }
        // Written so that NaN is a fault.
        if (!(value >= key.low && value <= key.high)) {
            faults.push_back(fmt::format(
                "{} is {}, must be {} to {}", full_name(key), value, key.low, key.high));
        }
    }
    if (settings.avatars.size() > kMostAvatars) {
        faults.push_back(fmt::format(
            "picture.avatar names {} avatars, at most {}", settings.avatars.size(), kMostAvatars));
    }
    if (const auto size = parse_size(settings.size); !size) {
        faults.push_back("picture.size: " + size.error().message);
    }
    for (const Name& name : kNames) {
        const std::string& value = settings.*name.member;
        if (std::find(name.known.begin(), name.known.end(), value) == name.known.end()) {
            faults.push_back(unknown_name(name.key, value, name.known));
        }
    }
    return faults;
}

std::string to_toml(const Settings& settings) {
    std::string text = fmt::format(
        "# Settings of Raks. Command line options win over this file.\n"
        "format = \"raks-config\"\nversion = {}\n",
        kVersion);
    std::string_view section;
    for (const Key& key : kKeys) {
        if (key.section != section) {
            section = key.section;
            text += fmt::format("\n[{}]\n", section);
        }
        const std::string value = std::visit(
            [&](auto member) -> std::string {
                using T = std::decay_t<decltype(settings.*member)>;
                if constexpr (std::is_same_v<T, std::string>) {
                    return toml_quoted(settings.*member);
                } else if constexpr (std::is_same_v<T, Texts>) {
                    return toml_texts(settings.*member);
                } else if constexpr (std::is_same_v<T, double>) {
                    const std::string number = fmt::format("{}", settings.*member);
                    // A decimal point, so that TOML reads the number back as a decimal.
                    return number.find_first_of(".e") == std::string::npos ? number + ".0" : number;
                } else {
                    return fmt::format("{}", settings.*member);
                }
            },
            key.member);
        text += fmt::format("{} = {}  # {}\n", key.name, value, key.help);
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

}  // namespace raks::engine
