#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/setting_origins.hpp"

namespace raks::engine {

/// Avatars that can be worn in turn, and dancers, at most.
inline constexpr std::size_t kMostAvatars = 32;

/// What a user can set. Precedence, lowest first: these defaults, the installed
/// config/default.toml, what the window was last (where one opens),
/// $XDG_CONFIG_HOME/raks/config.toml, a preset, the command line. File format:
/// docs/reference/files.md.
struct Settings {
    // [audio]
    std::string device;                 ///< input for `live`; empty: chosen, and the reason printed
    std::string output;                 ///< output for `play`; empty: the default
    std::string audio_system = "auto";  ///< auto, portaudio, jack or pulse
    double buffer_ms = 0.0;             ///< of the device; 0: its own choice; [0, 2000]
    double latency_offset_ms = 0.0;     ///< added to the reported output latency; [-500, 500]
    double volume = 1.0;                ///< [0, 2]
    // [dance]
    std::string dance = "auto";              ///< a dance's name, or auto: as recognised
    std::string fallback_dance = "auto";     ///< when nothing is recognised; or first, keep, stand
    std::string figures = "angles";          ///< learnt as angles or positions of the joints
    std::string material = "people";         ///< of a dance with both; or written, both
    std::string formation = "solo";          ///< solo, couple, unison, canon, free, grid, ring or v
    std::int64_t dancers = 0;                ///< 0: as many as a formation has; [0, 32]
    std::string generator = "trajectories";  ///< or frames: the paper's
    std::string dynamics = "on";             ///< or off: the dance follows nothing but the beat
    std::string tagger = "on";               ///< or off: no tagger listens along
    bool ignore_tags = false;                ///< what a file says of its own dance does not count
    std::int64_t seed = 1;                   ///< same seed, same dance; >= 0
    double pose_lead_ms = 0.0;  ///< pictures show the pose this much ahead; [-200, 200]
    // [picture]
    /// What dancers wear in turn: "mannequin", a file, or a name in the person's folder of avatars.
    std::vector<std::string> avatars = {"mannequin"};
    double avatar_height = 0.0;  ///< metres; 0: its own; [0, 10]
    std::string avatar_labels;   ///< file that says which nodes are its bones; empty: none
    std::int64_t avatar_pictures_mb = 128;  ///< memory of the pictures on it; [1, 4096]
    std::string theme = "stage";            ///< a name, or a file X.toml
    std::string backdrop = "stage";         ///< stage, transparent, or a key colour: #RRGGBB
    bool shadow = true;                     ///< dancers throw one on the floor
    bool rings = true;                      ///< rings of light on the floor show the beat
    std::string dress = "auto";             ///< of the mannequin: auto, mannequin or a costume
    std::string camera = "director";        ///< or a preset: wide, portrait, front or side
    bool calm = false;                 ///< fewer cuts; light changes slowly, little, with no accent
    std::string size = "1280x720";     ///< WIDTHxHEIGHT
    double fps = 30.0;                 ///< pictures a second, [1, 240]; 0: the monitor's
    std::string quality = "auto";      ///< auto, fast or high
    std::string view = "auto";         ///< auto (stick when danced by positions), skin or stick
    bool face_blink = true;            ///< eyes blink by themselves
    bool face_mouth = true;            ///< the mouth opens with the music
    bool face_gaze = true;             ///< eyes look at the camera, or at the partner
    std::string face_mood = "normal";  ///< how much faces feel: off, calm, normal or stage
    bool overlay = true;               ///< tempo, bar, dance and levels over the picture
    // Not in the table: no key of config.toml, and no option.
    std::vector<std::string> forbidden_dances;  ///< that a preset forbids: they are not loaded
    SettingOrigins origins;                     ///< where each of the table has its value from
};

/// Lines for people.
using SettingsNotes = std::vector<std::string>;
/// Reads a TOML file over `settings`: keys that it lacks keep their value. Returns a line for each
/// key that is unknown (that of a newer version, or misspelt: it names the nearest known one), up
/// to six; such keys are passed over. Errors name file, line and key; a value out of range the
/// range. On error `settings` is unchanged. `rank`: of the file, noted in `settings.origins`.
[[nodiscard]] Expected<SettingsNotes> read_settings(const std::filesystem::path& path,
                                                    Settings& settings,
                                                    SettingRank rank = SettingRank::config);
/// The same from a text; `name` stands for the file in lines and errors.
[[nodiscard]] Expected<SettingsNotes> parse_settings(std::string_view toml,
                                                     const std::string& name,
                                                     Settings& settings,
                                                     SettingRank rank = SettingRank::config);

/// Every fault of the values, one line each; for those of the command line too. Empty: none.
[[nodiscard]] std::vector<std::string> validate(const Settings& settings);

/// What to_toml() says of each value: what it is for, or who has set it.
enum class TomlComments : std::uint8_t { help, origins };
/// The settings as a TOML document with comments; reading it back gives the same settings.
[[nodiscard]] std::string to_toml(const Settings& settings,
                                  TomlComments comments = TomlComments::help);

/// Where the user's file lies: $XDG_CONFIG_HOME/raks/config.toml, or below ~/.config. Empty:
/// neither variable names an absolute path.
[[nodiscard]] std::filesystem::path user_settings_path();

/// What load_settings() has read.
struct LoadedSettings {
    Settings settings;    ///< of all files
    SettingsNotes notes;  ///< of read_settings
};
/// The installed and the user's file, where they exist, read over the defaults in this order.
/// Errors: as read_settings.
[[nodiscard]] Expected<LoadedSettings> load_settings();

/// A file that comes with Raks (`models/trained/x.json`, `config/default.toml`): below $RAKS_DATA,
/// or beside the program's installation or build, searched in this order. Errors: it is in none.
[[nodiscard]] Expected<std::filesystem::path> data_path(const std::filesystem::path& relative);

/// Where files that can be made again are kept: $XDG_CACHE_HOME/raks, or below ~/.cache. Empty:
/// neither variable names an absolute path.
[[nodiscard]] std::filesystem::path user_cache_path();

/// Size of a picture.
struct PictureSize {
    int width = 0;   ///< pixels
    int height = 0;  ///< pixels
    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};
/// Parses "1280x720". Errors: not of this form; a side outside 16 to 7680 pixels.
[[nodiscard]] Expected<PictureSize> parse_size(std::string_view text);

/// Pictures a second of what is no window, a film or an output: 30 where those of a window are the
/// monitor's.
[[nodiscard]] inline double film_fps(const Settings& settings) noexcept {
    return settings.fps > 0.0 ? settings.fps : Settings{}.fps;
}

/// What lies behind the dancers, as asked for.
struct AskedBackdrop {
    bool is_stage = true;  ///< the theme's; else what follows
    std::optional<std::array<std::uint8_t, 3>> key = std::nullopt;  ///< none: nothing at all
};
/// Parses "stage", "transparent" or a colour, "#00ff00" (red, green and blue in hexadecimal).
/// Errors: none of them.
[[nodiscard]] Expected<AskedBackdrop> parse_backdrop(std::string_view text);

}  // namespace raks::engine
