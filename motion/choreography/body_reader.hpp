#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/toml_reader.hpp"
#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

/// What a control allows is checked with its tracks.
inline constexpr NumberRange kAnyControl{-1000.0, 1000.0};

/// Tracks as written under [body] or a figure's body, before they are checked against a figure.
struct WrittenBody {
    struct Entry {
        std::string name;
        std::vector<Track> tracks;
        std::size_t line = 0;
    };
    std::vector<Entry> entries;

    [[nodiscard]] const Entry* find(std::string_view name) const noexcept {
        const auto found = std::find_if(
            entries.begin(), entries.end(), [&](const Entry& one) { return one.name == name; });
        return found != entries.end() ? &*found : nullptr;
    }
};

/// Reads a [body] table: controls by dotted names, each a number, a track or several.
void read_body(const toml::table& table, TomlComplaints& complaints, WrittenBody& body);

}  // namespace raks::motion
