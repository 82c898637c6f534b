#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>

namespace raks::engine {

/// Who has set a value. A later one wins, in whatever order they are read.
enum class SettingRank : std::uint8_t {
    built_in,   ///< the program's own value
    installed,  ///< config/default.toml as it came with the program
    window,     ///< what the window was when it closed last (WindowMemory)
    config,     ///< the person's config.toml
    preset,     ///< what `--preset` names (Preset)
    option,     ///< the command line
};

/// Where a value comes from.
struct SettingOrigin {
    SettingRank rank = SettingRank::built_in;
    std::string file = {};  ///< as it was named when it was read; empty: no file
    std::size_t line = 0;   ///< in the file, from 1; 0: no file
    friend bool operator==(const SettingOrigin&, const SettingOrigin&) = default;
};

/// "default", "/home/anna/.config/raks/config.toml:12", "preset FILE:LINE", "window FILE:LINE",
/// "option"; on one line whatever the file's name is.
[[nodiscard]] std::string in_words(const SettingOrigin& origin);

/// Where each setting has its value from, by its name in errors ("picture.theme"). Threads: one at
/// a time.
class SettingOrigins {
 public:
    /// Of a setting that nobody has set: built in.
    [[nodiscard]] const SettingOrigin& of(std::string_view name) const;
    /// Notes who has set it now.
    void set(std::string_view name, SettingOrigin origin);

 private:
    std::map<std::string, SettingOrigin, std::less<>> by_name_;
};

}  // namespace raks::engine
