#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/setup/settings.hpp"

/// All settings as a table. A new setting is a field of Settings and a row of settings_table.cpp:
/// the keys of the file, the checks of their values, the options of the commands and the reference
/// in the manual are made from the rows.
namespace raks::engine {

/// The field that a row is about: one of five types of value.
using SettingField = std::variant<std::string Settings::*,
                                  std::vector<std::string> Settings::*,
                                  double Settings::*,
                                  std::int64_t Settings::*,
                                  bool Settings::*>;

/// The words that a text may be.
class Words {
 public:
    /// None: any text.
    constexpr Words() = default;
    template <typename... Word>
    constexpr explicit Words(Word... words) : words_{words...}, count_(sizeof...(words)) {}

    [[nodiscard]] constexpr std::span<const std::string_view> all() const noexcept {
        return std::span(words_).first(count_);
    }

 private:
    std::array<std::string_view, 12> words_{};
    std::size_t count_ = 0;
};

/// What a number may be, both ends included.
struct Range {
    double low = 0.0;
    double high = 0.0;
    bool has_zero = false;  ///< 0 besides, below `low`
};

/// The commands whose option a setting is, as bits. Commands that measure name the few that they
/// take themselves.
enum SettingCommands : unsigned {
    kPlay = 1U,
    kLive = 2U,
    kRender = 4U,
    kDance = 8U,
    kSheet = 16U,
    kShows = kPlay | kLive | kRender,
};

/// An option of the command line.
struct SettingOption {
    std::string_view name;    ///< "--theme"; of a truth value there is "--no-..." too; empty: none
    unsigned commands = 0;    ///< SettingCommands
    std::string_view help{};  ///< empty: as of the row
};

/// One setting. `help` is the comment in the file, and what --help says of the option; where it is
/// empty the words say enough.
struct SettingRow {
    std::string_view section;  ///< of the file
    std::string_view name;     ///< of the key in it
    SettingField field;
    Range range{};  ///< of a number
    Words words{};  ///< of a text
    std::string_view help{};
    SettingOption option{};
    std::string_view manual{};  ///< in Markdown, for the reference; empty: as `help`
};

/// All settings, section by section: the order of the file, and of the options in a section.
[[nodiscard]] std::span<const SettingRow> setting_rows() noexcept;

/// The row of a field. Precondition: it has one.
[[nodiscard]] const SettingRow& row_of(SettingField field);

/// Where the value of a setting comes from.
[[nodiscard]] const SettingOrigin& origin_of(const Settings& settings, SettingField field);

/// Copies the value of a setting with its origin, unless a higher rank has set it in `to`: so that
/// it does not matter in which order they come.
void take_setting(SettingField field, const Settings& from, Settings& to);

/// "picture.theme": how errors name a setting.
[[nodiscard]] std::string full_name(const SettingRow& row);

/// What a person is told of the setting: its help, else its words: "auto, fast or high".
[[nodiscard]] std::string help_of(const SettingRow& row);

/// What is wrong with a value, in one line: a number out of its range, a text that is none of the
/// words (the nearest is named). Empty: nothing.
[[nodiscard]] std::string fault_of(const SettingRow& row, const Settings& settings);

}  // namespace raks::engine
