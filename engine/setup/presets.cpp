#include "engine/setup/presets.hpp"

#include <algorithm>
#include <array>
#include <system_error>
#include <utility>

#include "base/dance_list.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/plain_name.hpp"
#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "engine/setup/settings_reader.hpp"
#include "engine/setup/settings_table.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPresetFormat = "raks-preset";
constexpr std::string_view kPresetEnding = ".toml";
constexpr std::size_t kMostPresetOutputs = 16;  // far more than anybody can show
constexpr std::size_t kLongestOutput = 4096;    // bytes, as of a path

constexpr std::array<SettingField, 7> kPresetFields = {&Settings::theme,
                                                       &Settings::camera,
                                                       &Settings::backdrop,
                                                       &Settings::view,
                                                       &Settings::avatars,
                                                       &Settings::dance,
                                                       &Settings::formation};
constexpr std::array<OwnKey, 3> kPresetKeys = {
    OwnKey{"dance", "forbidden"}, OwnKey{"video", "outputs"}, OwnKey{"told", "targets"}};

// Calls `visit` with each field of a preset and the setting that it holds.
template <typename Visit>
void visit_settings(Visit visit) {
    visit(&Preset::theme, &Settings::theme);
    visit(&Preset::camera, &Settings::camera);
    visit(&Preset::backdrop, &Settings::backdrop);
    visit(&Preset::view, &Settings::view);
    visit(&Preset::avatars, &Settings::avatars);
    visit(&Preset::dance, &Settings::dance);
    visit(&Preset::formation, &Settings::formation);
}

// The settings that a preset holds, each with its origin.
Settings settings_of(const Preset& preset, const SettingOrigins& origins) {
    Settings settings;
    visit_settings([&](auto held, auto setting) {
        if (const auto& value = preset.*held) {
            const std::string name = full_name(row_of(setting));
            const SettingOrigin& origin = origins.of(name);
            settings.*setting = *value;
            settings.origins.set(name, {SettingRank::preset, origin.file, origin.line});
        }
    });
    return settings;
}

// A list of texts, which may be empty. `fault_of`: of one text; empty: none.
template <typename Fault>
std::optional<std::vector<std::string>> read_list(const toml::table& file,
                                                  const OwnKey& key,
                                                  std::size_t most,
                                                  Fault fault_of,
                                                  TomlComplaints& complaints) {
    const toml::node* const node = file[key.section][key.name].node();
    if (node == nullptr) {
        return std::nullopt;
    }
    const toml::array* const list = node->as_array();
    const std::string name = fmt::format("{}.{}", key.section, key.name);
    if (list == nullptr || list->size() > most) {
        complaints.complain(*node, fmt::format("{} must be a list of up to {} texts", name, most));
        return std::nullopt;
    }
    std::vector<std::string> texts;
    for (const toml::node& element : *list) {
        const auto text = element.value_exact<std::string>();
        if (!text) {
            complaints.complain(element, name + " must be a list of texts");
        } else if (const std::string fault = fault_of(*text); !fault.empty()) {
            complaints.complain(element, fmt::format("{}: {}", name, fault));
        } else {
            texts.push_back(*text);
        }
    }
    return texts;
}

std::string fault_of_dance(const std::string& name) {
    return is_dance_name(name) ? std::string() : why_no_dance_name(name);
}

std::string fault_of_output(const std::string& target) {
    return !target.empty() && printable(target, kLongestOutput) == target
               ? std::string()
               : "an output must be a text of printable characters";
}

fs::path path_of_preset(std::string_view name) {
    const fs::path folder = presets_folder();
    return folder.empty() ? folder : folder / fmt::format("{}{}", name, kPresetEnding);
}

Expected<LoadedPreset> read_preset(const fs::path& file) {
    const auto text = read_text_file(file, kLongestSettings);
    return text ? parse_preset(*text, file.string()) : fail(text.error());
}

// Errors: a file that has the name would be lost.
Expected<void> check_may_be_replaced(const fs::path& file) {
    if (!is_there(file)) {
        return {};
    }
    const auto old = read_preset(file);
    const std::string why = !old                 ? old.error().message
                            : old->notes.empty() ? std::string()
                                                 : old->notes.front();
    return why.empty() ? Expected<void>()
                       : fail(why + "; it is left as it is: save under another name");
}

}  // namespace

std::string fault_of_preset_name(std::string_view name) {
    if (!is_plain_name(name)) {
        return why_no_plain_name(name);
    }
    return name.front() == '.' ? fmt::format("\"{}\" cannot be a name: it begins with a dot", name)
                               : std::string();
}

fs::path presets_folder() {
    const fs::path folder = xdg_folder("XDG_CONFIG_HOME", ".config");
    return folder.empty() ? folder : folder / "presets";
}

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    const fs::path folder = presets_folder();
    const auto files = folder.empty() ? std::vector<fs::path>()
                                      : list_folder(folder).value_or(std::vector<fs::path>());
    for (const fs::path& file : files) {
        std::error_code ignored;
        std::string name = file.stem().string();
        if (file.extension() == kPresetEnding && fault_of_preset_name(name).empty() &&
            fs::is_regular_file(file, ignored)) {
            names.push_back(std::move(name));
        }
    }
    return names;
}

std::string why_unknown_preset(std::string_view name) {
    if (std::string fault = fault_of_preset_name(name); !fault.empty()) {
        return fault;
    }
    const fs::path file = path_of_preset(name);
    if (!file.empty() && is_there(file)) {
        return {};
    }
    const std::vector<std::string> names = preset_names();
    const std::vector<std::string_view> known(names.begin(), names.end());
    if (known.empty()) {
        const std::string folder = printable(presets_folder().string());
        return fmt::format("preset \"{}\" is unknown: there are none yet{}",
                           name,
                           folder.empty() ? "" : " in " + folder);
    }
    return unknown_name("preset", name, known);
}

Expected<LoadedPreset> parse_preset(std::string_view text, const std::string& name) {
    const auto file = parse_toml(text, name);
    if (!file) {
        return fail(file.error());
    }
    Settings settings;
    auto notes = read_settings_table(*file,
                                     name,
                                     {.format = kPresetFormat,
                                      .rank = SettingRank::preset,
                                      .fields = kPresetFields,
                                      .own_keys = kPresetKeys},
                                     settings);
    if (!notes) {
        return fail(std::move(notes.error()));
    }
    if (const auto faults = validate(settings); !faults.empty()) {
        return fail(name + ": " + faults.front());
    }
    TomlComplaints complaints(name);
    LoadedPreset loaded;
    loaded.preset.forbidden =
        read_list(*file, kPresetKeys[0], kMostDances, fault_of_dance, complaints);
    loaded.preset.outputs =
        read_list(*file, kPresetKeys[1], kMostPresetOutputs, fault_of_output, complaints);
    loaded.preset.told =
        read_list(*file, kPresetKeys[2], kMostPresetOutputs, fault_of_output, complaints);
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    visit_settings([&](auto held, auto setting) {
        if (origin_of(settings, setting).rank == SettingRank::preset) {
            loaded.preset.*held = settings.*setting;
        }
    });
    loaded.origins = std::move(settings.origins);
    loaded.notes = std::move(*notes);
    return loaded;
}

Expected<LoadedPreset> load_preset(std::string_view name) {
    if (std::string unknown = why_unknown_preset(name); !unknown.empty()) {
        return fail(std::move(unknown));
    }
    return read_preset(path_of_preset(name));
}

std::string toml_of(const Preset& preset) {
    TomlSections sections;
    const Settings settings = settings_of(preset, {});
    for (const SettingRow& row : setting_rows()) {
        if (origin_of(settings, row.field).rank == SettingRank::preset) {
            sections.add(row, settings);
        }
    }
    if (preset.forbidden) {
        sections.add("dance", "forbidden", toml_list(*preset.forbidden));
    }
    if (preset.outputs) {
        sections.add("video", "outputs", toml_list(*preset.outputs));
    }
    if (preset.told) {
        sections.add("told", "targets", toml_list(*preset.told));
    }
    return fmt::format(
        "# A preset of Raks (--preset). What it does not name stays as it is.\n"
        "format = \"{}\"\nversion = {}\n{}",
        kPresetFormat,
        kSettingsVersion,
        sections.text());
}

Expected<fs::path> save_preset(std::string_view name, const Preset& preset) {
    if (std::string fault = fault_of_preset_name(name); !fault.empty()) {
        return fail(std::move(fault));
    }
    const fs::path file = path_of_preset(name);
    if (file.empty()) {
        return fail("there is no folder to keep presets in: set HOME or XDG_CONFIG_HOME");
    }
    if (auto checked = check_may_be_replaced(file); !checked) {
        return fail(std::move(checked.error()));
    }
    // Names of files may be any bytes; a document is text.
    const std::string text = toml_of(preset);
    if (auto read = parse_preset(text, file.string()); !read) {
        return fail(std::move(read.error()));
    }
    if (auto made = make_folders(file.parent_path()); !made) {
        return fail(std::move(made.error()));
    }
    auto written = write_file(file, text);
    return written ? Expected<fs::path>(file) : fail(std::move(written.error()));
}

Preset preset_of(const Settings& settings) {
    Preset preset;
    visit_settings([&](auto held, auto setting) { preset.*held = settings.*setting; });
    preset.forbidden = settings.forbidden_dances;
    return preset;
}

void apply_preset(const LoadedPreset& loaded, Settings& settings) {
    const Settings held = settings_of(loaded.preset, loaded.origins);
    for (const SettingField field : kPresetFields) {
        if (origin_of(held, field).rank == SettingRank::preset) {
            take_setting(field, held, settings);
        }
    }
    if (loaded.preset.forbidden) {
        settings.forbidden_dances = *loaded.preset.forbidden;
    }
}

}  // namespace raks::engine
