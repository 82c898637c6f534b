#pragma once

#include "base/toml_reader.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/expected.hpp"
#include "engine/setup/setting_origins.hpp"
#include "engine/setup/settings.hpp"
#include "engine/setup/settings_table.hpp"

/// How files that hold settings are read and written: config.toml holds all of them, others some
/// beside keys of their own. Include it in source files only, as base/toml_reader.hpp.
namespace raks::engine {

/// A key that the reader of one kind of file reads by itself.
struct OwnKey {
    std::string_view section;
    std::string_view name;
};

/// A kind of file that holds settings.
struct SettingsForm {
    std::string_view format = "raks-config";    ///< the value of its key `format`
    SettingRank rank = SettingRank::config;     ///< of what it says
    std::span<const SettingField> fields = {};  ///< that it may hold; none: all
    std::span<const OwnKey> own_keys = {};      ///< that are not settings
};

inline constexpr std::int64_t kSettingsVersion = 1;  ///< of these formats, that is read
inline constexpr std::size_t kLongestSettings = std::size_t{1} << 20U;  ///< bytes: 1 MiB

/// Reads the settings of a document over `settings`, with their origins. `name`: the file's. Own
/// keys are passed over; of unknown ones a line each is returned. Errors: as parse_settings; then
/// `settings` may hold a part of them.
[[nodiscard]] Expected<SettingsNotes> read_settings_table(const toml::table& table,
                                                          const std::string& name,
                                                          const SettingsForm& form,
                                                          Settings& settings);

/// One text stands for itself, several as a list: how a file holds texts.
[[nodiscard]] std::string toml_texts(const std::vector<std::string>& texts);
/// The same, always as a list.
[[nodiscard]] std::string toml_list(const std::vector<std::string>& texts);
/// The value of a setting as a file holds it.
[[nodiscard]] std::string toml_value(const SettingRow& row, const Settings& settings);

/// Values of a document that is being written, each under its section.
class TomlSections {
 public:
    /// Puts a value behind those of its section. `value`: as the document shall hold it.
    void add(std::string_view section, std::string_view name, const std::string& value);
    /// The value of a setting.
    void add(const SettingRow& row, const Settings& settings) {
        add(row.section, row.name, toml_value(row, settings));
    }
    /// The sections in the order in which they came first.
    [[nodiscard]] std::string text() const;

 private:
    std::vector<std::pair<std::string, std::string>> sections_;  // name and lines
};

}  // namespace raks::engine
