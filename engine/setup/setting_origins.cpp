#include "engine/setup/setting_origins.hpp"

#include <utility>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::engine {

std::string in_words(const SettingOrigin& origin) {
    std::string place =
        fmt::format("{}:{}", printable(origin.file, std::string::npos), origin.line);
    switch (origin.rank) {
        case SettingRank::built_in:
            return "default";
        case SettingRank::installed:
        case SettingRank::config:
            return place;
        case SettingRank::window:
            return "window " + place;
        case SettingRank::preset:
            return "preset " + place;
        case SettingRank::option:
            break;
    }
    return "option";
}

const SettingOrigin& SettingOrigins::of(std::string_view name) const {
    static const SettingOrigin built_in;
    const auto found = by_name_.find(name);
    return found != by_name_.end() ? found->second : built_in;
}

void SettingOrigins::set(std::string_view name, SettingOrigin origin) {
    by_name_.insert_or_assign(std::string(name), std::move(origin));
}

}  // namespace raks::engine
