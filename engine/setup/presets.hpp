#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/setting_origins.hpp"
#include "engine/setup/settings.hpp"

namespace raks::engine {

/// How a show looks and what is danced in it, kept by a person under a name. What a preset does not
/// hold stays as it is. Names and values are those of the settings. File format:
/// docs/reference/files.md.
struct Preset {
    std::optional<std::string> theme;                   ///< picture.theme
    std::optional<std::string> camera;                  ///< picture.camera
    std::optional<std::string> backdrop;                ///< picture.backdrop
    std::optional<std::string> view;                    ///< picture.view
    std::optional<std::vector<std::string>> avatars;    ///< picture.avatar
    std::optional<std::string> dance;                   ///< dance.dance
    std::optional<std::string> formation;               ///< dance.formation
    std::optional<std::vector<std::string>> forbidden;  ///< dances that are not danced; may be none
    std::optional<std::vector<std::string>> outputs;    ///< as of `--video-out`; may be none
    /// Who is told of the music: an option and its target, "osc 127.0.0.1:9000"; may be none.
    std::optional<std::vector<std::string>> told;
    friend bool operator==(const Preset&, const Preset&) = default;
};

/// A preset that was read.
struct LoadedPreset {
    Preset preset;
    SettingOrigins origins;  ///< where each of its settings stands
    SettingsNotes notes;     ///< a line for each key that is unknown and passed over
};

/// What is wrong with a name for a preset, in one line: it must be able to name a file
/// (is_plain_name), and not begin with a dot. Empty: nothing.
[[nodiscard]] std::string fault_of_preset_name(std::string_view name);

/// $XDG_CONFIG_HOME/raks/presets, or below ~/.config. Empty: neither variable names an absolute
/// path. Threads: main.
[[nodiscard]] std::filesystem::path presets_folder();
/// The names of the person's presets, sorted; none where the folder cannot be listed. Threads:
/// main.
[[nodiscard]] std::vector<std::string> preset_names();
/// The line for a name that none of the presets has: it names the nearest one. Empty: one has it.
/// Threads: main.
[[nodiscard]] std::string why_unknown_preset(std::string_view name);

/// Errors: no TOML; another format or version; a value that the setting cannot have; more than 1
/// MiB. `name` stands for the file in lines and errors. Threads: any.
[[nodiscard]] Expected<LoadedPreset> parse_preset(std::string_view toml, const std::string& name);
/// Errors: those of the name, why_unknown_preset(), reading and parse_preset(). Threads: main.
[[nodiscard]] Expected<LoadedPreset> load_preset(std::string_view name);

/// The document; parse_preset() of it gives the same.
[[nodiscard]] std::string toml_of(const Preset& preset);
/// Keeps a preset under a name, all of it or nothing, in the place of one that has the name: ask
/// before. Returns the file. Errors: those of the name; what has the name cannot be read or holds
/// keys that are unknown here, and is left as it is; the system's. Threads: main.
[[nodiscard]] Expected<std::filesystem::path> save_preset(std::string_view name,
                                                          const Preset& preset);

/// What of these settings a preset holds: all of it but the outputs.
[[nodiscard]] Preset preset_of(const Settings& settings);
/// Puts what a preset holds over the settings; what the command line has set stays. Outputs are the
/// caller's.
void apply_preset(const LoadedPreset& loaded, Settings& settings);

}  // namespace raks::engine
