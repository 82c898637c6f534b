// Figure reader: the body and the steps of a figure in a dance file.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/toml_reader.hpp"
#include "motion/choreography/authored_dance.hpp"

namespace raks::motion {

// Body reader: the [body] tables of a dance file.

/// Range for any number in a body; the limits of each control are checked later, by the sum of its
/// tracks.
inline constexpr NumberRange kAnyControl{-1000.0, 1000.0};

/// Tracks as written under [body] or a figure's body, before figure and file are merged.
struct WrittenBody {
    /// One control or pair of controls with its tracks.
    struct Entry {
        std::string name;           ///< as written
        std::vector<Track> tracks;  ///< at least one
        std::size_t line = 0;       ///< in the file
    };
    std::vector<Entry> entries;  ///< in the file's order

    /// The entry of that name; null: none.
    [[nodiscard]] const Entry* find(std::string_view name) const noexcept {
        const auto found = std::find_if(
            entries.begin(), entries.end(), [&](const Entry& one) { return one.name == name; });
        return found != entries.end() ? &*found : nullptr;
    }
};

/// Reads a [body] table: controls by dotted names, each a number, a track or a list of tracks.
/// Faults go to `complaints`.
void read_body(const toml::table& table, TomlComplaints& complaints, WrittenBody& body);

// Step reader: the steps of a figure in a dance file.

/// Reads a figure's steps = [{ foot, at, ... }, ...], or those under another key, sorted by the
/// beat of landing; none where the key is missing. The figure's beats and style must be known
/// already. Faults go to `complaints`.
[[nodiscard]] std::vector<FootStep> read_steps(const toml::table& table,
                                               std::string_view key,
                                               TomlComplaints& complaints,
                                               const AuthoredFigure& figure);

}  // namespace raks::motion
