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

/// What a window was when it closed, and what was chosen in it: kept by the program, and read where
/// the next one opens. Choices of a person's files and of the command line rank higher. File
/// format: docs/reference/files.md.
struct WindowMemory {
    /// Where it was, in screen coordinates: of what lies within its frame.
    struct Place {
        int x = 0;
        int y = 0;
        std::string monitor;  ///< its name
        int monitor_x = 0;    ///< where that monitor was
        int monitor_y = 0;
        friend bool operator==(const Place&, const Place&) = default;
    };
    std::optional<Place> place;
    std::optional<PictureSize> size;                  ///< as place
    std::optional<std::string> device;                ///< input of `live`, by its name
    std::optional<std::string> output;                ///< loudspeaker of `play`, by its name
    std::optional<std::vector<std::string>> avatars;  ///< as of picture.avatar
    friend bool operator==(const WindowMemory&, const WindowMemory&) = default;
};

/// A memory that was read.
struct LoadedWindowMemory {
    WindowMemory memory;
    SettingOrigins origins;  ///< where each of its settings stands
    SettingsNotes notes;     ///< a line for each key that is unknown and passed over
};

/// Errors: no TOML; another format or version; a value out of its range; more than 1 MiB. `name`
/// stands for the file in lines and errors. Threads: any.
[[nodiscard]] Expected<LoadedWindowMemory> parse_window_memory(std::string_view toml,
                                                               const std::string& name);
/// The document; parse_window_memory() of it gives the same. Of names that are no text for one line
/// what is printable.
[[nodiscard]] std::string toml_of(const WindowMemory& memory);

/// Where the person's file lies: $XDG_STATE_HOME/raks/window.toml, or below ~/.local/state. Empty:
/// neither variable names an absolute path. Threads: main.
[[nodiscard]] std::filesystem::path window_memory_path();
/// The person's file; empty where there is none. Errors: those of reading and of
/// parse_window_memory(). Threads: main.
[[nodiscard]] Expected<LoadedWindowMemory> load_window_memory();
/// Writes the person's file, all of it or nothing; makes its folder. Errors: there is no place for
/// it; the system's. Threads: main.
[[nodiscard]] Expected<void> save_window_memory(const WindowMemory& memory);

/// Puts devices and avatars under the settings: what a person's file or option has set stays.
void apply_window_memory(const LoadedWindowMemory& loaded, Settings& settings);

}  // namespace raks::engine
