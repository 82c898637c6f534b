#include "engine/setup/window_memory.hpp"

#include <array>
#include <utility>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/printable.hpp"
#include "engine/setup/settings_reader.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kWindowFormat = "raks-window";
constexpr std::string_view kWindowSection = "window";
// No desktop is larger, to either side of its origin.
constexpr NumberRange kScreen{-1e6, 1e6};
constexpr NumberRange kSide{1.0, 1e5};      // of a window, in screen coordinates
constexpr std::size_t kLongestName = 1000;  // bytes, of a monitor or a device

constexpr std::array<SettingField, 3> kWindowFields = {
    &Settings::device, &Settings::output, &Settings::avatars};
constexpr std::array kWindowKeys = {OwnKey{kWindowSection, "x"},
                                    OwnKey{kWindowSection, "y"},
                                    OwnKey{kWindowSection, "monitor"},
                                    OwnKey{kWindowSection, "monitor_x"},
                                    OwnKey{kWindowSection, "monitor_y"},
                                    OwnKey{kWindowSection, "width"},
                                    OwnKey{kWindowSection, "height"}};

// A whole number of [window]; nothing where it is not there.
std::optional<int> read_whole(const toml::table& window,
                              std::string_view key,
                              NumberRange range,
                              TomlComplaints& complaints) {
    const toml::node* const node = window.get(key);
    return node != nullptr ? std::optional(complaints.whole(*node, key, range)) : std::nullopt;
}

void read_window(const toml::table& window, WindowMemory& memory, TomlComplaints& complaints) {
    const auto x = read_whole(window, "x", kScreen, complaints);
    const auto y = read_whole(window, "y", kScreen, complaints);
    if (x && y) {
        memory.place = WindowMemory::Place{
            .x = *x,
            .y = *y,
            .monitor = complaints.text(window, "monitor"),
            .monitor_x = read_whole(window, "monitor_x", kScreen, complaints).value_or(0),
            .monitor_y = read_whole(window, "monitor_y", kScreen, complaints).value_or(0)};
    }
    const auto width = read_whole(window, "width", kSide, complaints);
    const auto height = read_whole(window, "height", kSide, complaints);
    if (width && height) {
        memory.size = PictureSize{*width, *height};
    }
}

// Names of systems and files may be any bytes; a document is text.
std::string plain_text(const std::string& text) { return printable(text, kLongestName); }

// Calls `visit` with each choice of a memory and the setting that it is.
template <typename Visit>
void visit_choices(Visit visit) {
    visit(&WindowMemory::device, &Settings::device);
    visit(&WindowMemory::output, &Settings::output);
    visit(&WindowMemory::avatars, &Settings::avatars);
}

}  // namespace

Expected<LoadedWindowMemory> parse_window_memory(std::string_view text, const std::string& name) {
    const auto file = parse_toml(text, name);
    if (!file) {
        return fail(file.error());
    }
    Settings settings;
    auto notes = read_settings_table(*file,
                                     name,
                                     {.format = kWindowFormat,
                                      .rank = SettingRank::window,
                                      .fields = kWindowFields,
                                      .own_keys = kWindowKeys},
                                     settings);
    if (!notes) {
        return fail(std::move(notes.error()));
    }
    if (const auto faults = validate(settings); !faults.empty()) {
        return fail(name + ": " + faults.front());
    }
    LoadedWindowMemory loaded;
    if (const toml::table* const window = (*file)[kWindowSection].as_table()) {
        TomlComplaints complaints(name);
        read_window(*window, loaded.memory, complaints);
        if (!complaints.is_sound()) {
            return fail(complaints.fault());
        }
    }
    visit_choices([&](auto held, auto setting) {
        if (origin_of(settings, setting).rank == SettingRank::window) {
            loaded.memory.*held = settings.*setting;
        }
    });
    loaded.origins = std::move(settings.origins);
    loaded.notes = std::move(*notes);
    return loaded;
}

std::string toml_of(const WindowMemory& memory) {
    TomlSections sections;
    const auto add_whole = [&](std::string_view key, int value) {
        sections.add(kWindowSection, key, fmt::format("{}", value));
    };
    if (const auto& place = memory.place) {
        add_whole("x", place->x);
        add_whole("y", place->y);
        sections.add(kWindowSection, "monitor", toml_quoted(plain_text(place->monitor)));
        add_whole("monitor_x", place->monitor_x);
        add_whole("monitor_y", place->monitor_y);
    }
    if (memory.size) {
        add_whole("width", memory.size->width);
        add_whole("height", memory.size->height);
    }
    if (memory.device) {
        sections.add("audio", "device", toml_quoted(plain_text(*memory.device)));
    }
    if (memory.output) {
        sections.add("audio", "output", toml_quoted(plain_text(*memory.output)));
    }
    if (memory.avatars && !memory.avatars->empty()) {
        sections.add("picture", "avatar", toml_texts(*memory.avatars));
    }
    return fmt::format(
        "# What the window of Raks was when it closed last: written by the program.\n"
        "format = \"{}\"\nversion = {}\n{}",
        kWindowFormat,
        kSettingsVersion,
        sections.text());
}

fs::path window_memory_path() {
    const fs::path folder = xdg_folder("XDG_STATE_HOME", ".local/state");
    return folder.empty() ? folder : folder / "window.toml";
}

Expected<LoadedWindowMemory> load_window_memory() {
    const fs::path file = window_memory_path();
    if (file.empty() || !is_there(file)) {
        return LoadedWindowMemory();
    }
    const auto text = read_text_file(file, kLongestSettings);
    return text ? parse_window_memory(*text, file.string()) : fail(text.error());
}

Expected<void> save_window_memory(const WindowMemory& memory) {
    const fs::path file = window_memory_path();
    if (file.empty()) {
        return fail("there is no folder to keep the window's place in: set HOME or XDG_STATE_HOME");
    }
    auto made = make_folders(file.parent_path());
    return made ? write_file(file, toml_of(memory)) : made;
}

void apply_window_memory(const LoadedWindowMemory& loaded, Settings& settings) {
    Settings held;
    visit_choices([&](auto remembered, auto setting) {
        if (const auto& value = loaded.memory.*remembered) {
            const std::string name = full_name(row_of(setting));
            held.*setting = *value;
            const SettingOrigin& origin = loaded.origins.of(name);
            held.origins.set(name, {SettingRank::window, origin.file, origin.line});
            take_setting(setting, held, settings);
        }
    });
}

}  // namespace raks::engine
