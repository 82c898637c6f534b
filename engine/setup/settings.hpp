#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::engine {

/// What a user can set. Order of precedence: these defaults < config/default.toml as installed <
/// $XDG_CONFIG_HOME/raks/config.toml < command line. File form: docs/reference/files.md.
struct Settings {
    // [audio]
    std::string device;              ///< input for `live`; empty: chosen, with the reason said
    std::string output;              ///< output for `play`; empty: the default
    double latency_offset_ms = 0.0;  ///< added to the reported output latency; [-500, 500]
    double volume = 1.0;             ///< [0, 2]
    // [dance]
    std::string dance = "auto";              ///< a dance's name, or auto: as recognised
    std::string fallback_dance = "first";    ///< when nothing is recognised; or keep, stand
    std::string figures = "angles";          ///< learnt as angles or positions of the joints
    std::string formation = "solo";          ///< solo, couple, unison, canon or free
    std::string generator = "trajectories";  ///< or frames: the paper's
    std::int64_t seed = 1;                   ///< same seed, same dance; >= 0
    double pose_lead_ms = 0.0;  ///< pictures show the pose this much ahead; [-200, 200]
    // [picture]
    std::string theme = "stage";
    std::string camera = "wide";
    std::string size = "1280x720";  ///< WIDTHxHEIGHT
    double fps = 30.0;              ///< pictures a second, [1, 240]
    std::string quality = "auto";   ///< auto, fast or high
    std::string view = "auto";      ///< auto (stick when danced by positions), skin or stick
    bool overlay = true;
};

/// Reads one TOML file over `settings`. Errors name file, line and key; an unknown key names the
/// nearest known one; a value out of range says the range. On error `settings` is unchanged.
[[nodiscard]] Expected<void> read_settings(const std::filesystem::path& path, Settings& settings);
[[nodiscard]] Expected<void> parse_settings(std::string_view toml,
                                            const std::string& name,
                                            Settings& settings);

/// Every fault of the values (also those that came from the command line), one line each.
[[nodiscard]] std::vector<std::string> validate(const Settings& settings);

/// The settings as a TOML document with comments; reading it back gives the same settings.
[[nodiscard]] std::string to_toml(const Settings& settings);

/// Where the user's file lies: $XDG_CONFIG_HOME/raks/config.toml, or below ~/.config.
[[nodiscard]] std::filesystem::path user_settings_path();

/// The installed file and the user's file, where they exist, over the defaults.
[[nodiscard]] Expected<Settings> load_settings();

/// A file that comes with Raks (`models/trained/x.json`, `config/default.toml`): beside the
/// program's build or installation, or below $RAKS_DATA.
[[nodiscard]] Expected<std::filesystem::path> data_path(const std::filesystem::path& relative);

/// Where what can be made again is kept: $XDG_CACHE_HOME/raks, or below ~/.cache. Empty: there is
/// no home.
[[nodiscard]] std::filesystem::path user_cache_path();

struct PictureSize {
    int width = 0;
    int height = 0;
};
/// "1280x720". Both sides 16 to 7680.
[[nodiscard]] Expected<PictureSize> parse_size(std::string_view text);

}  // namespace raks::engine
