#include "motion/choreography/body_reader.hpp"

#include <algorithm>
#include <utility>

namespace raks::motion {
namespace {

using Names = std::vector<std::string_view>;

constexpr std::size_t kMostKeys = 1024;  // of one track

/// Follows a chain of dotted names to the value written there, so that a message can give the name
/// in full.
std::pair<const toml::node&, std::string> first_value(const toml::node& node,
                                                      const std::string& name) {
    const toml::table* const table = node.as_table();
    constexpr std::size_t kLongest = 100;  // characters; a deeper chain is not followed
    if (table == nullptr || table->size() != 1 || table->is_inline() || name.size() > kLongest) {
        return {node, name};
    }
    const auto entry = table->begin();
    return first_value(entry->second, name + "." + std::string(entry->first.str()));
}

// Whether a control's name begins with `name` and a dot: then a table there holds controls.
bool is_prefix(const std::string& name) {
    const std::string start = name + ".";
    const auto names = control_names();
    return std::any_of(names.begin(), names.end(), [&](std::string_view one) {
        return one.substr(0, start.size()) == start;
    });
}

// [[beat, value], ...]; beats must rise.
void read_keys(const toml::node& node,
               TomlComplaints& complaints,
               const std::string& name,
               Track& track) {
    const toml::array* const array = node.as_array();
    if (array == nullptr || array->empty() || array->size() > kMostKeys) {
        complaints.complain(node, fmt::format("keys of {} must be [[beat, value], ...]", name));
        return;
    }
    for (const toml::node& one : *array) {
        const auto key =
            complaints.numbers<2>(one, "a key of " + name, kAnyControl, "[beat, value]");
        if (!track.keys.empty() && !(key[0] > track.keys.back().beat)) {
            complaints.complain(one,
                                fmt::format("beat {}: keys of {} must rise, the one before is "
                                            "at beat {}",
                                            key[0],
                                            name,
                                            track.keys.back().beat));
        }
        track.keys.push_back({key[0], key[1]});
    }
}

// A number is a constant track; a table is keys or a wave, and knows only the keys of its kind.
Track read_track(const toml::node& node, TomlComplaints& complaints, const std::string& name) {
    Track track;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        track.rest = complaints.number(node, name, kAnyControl);
        return track;
    }
    const bool has_keys = table->contains("keys");
    const Names known = has_keys ? Names{"keys", "snap", "over", "lag", "vary"}
                                 : Names{"wave", "every", "peak", "rest", "skew", "lag", "vary"};
    complaints.check_keys(*table, known);
    if (has_keys) {
        read_keys(*table->get("keys"), complaints, name, track);
    } else if (!table->contains("wave") || !table->contains("every")) {
        complaints.complain(node, name + " needs keys = [...], or wave and every");
    }
    complaints.read(*table, "snap", {0, 0.9}, track.snap);
    complaints.read(*table, "over", {0, 0.5}, track.over);
    complaints.read(*table, "wave", kAnyControl, track.wave);
    complaints.read(*table, "every", {0.125, 64}, track.every);
    complaints.read(*table, "peak", {-64, 64}, track.peak);
    complaints.read(*table, "rest", kAnyControl, track.rest);
    complaints.read(*table, "skew", {-0.9, 0.9}, track.skew);
    complaints.read(*table, "lag", {-1, 1}, track.lag);
    complaints.read(*table, "vary", {0, 10}, track.vary);
    return track;
}

// One track, or a list of tracks that add up.
std::vector<Track> read_tracks(const toml::node& node,
                               TomlComplaints& complaints,
                               const std::string& name) {
    std::vector<Track> tracks;
    if (const toml::array* const array = node.as_array()) {
        constexpr std::size_t kMostTracks = 8;
        if (array->empty() || array->size() > kMostTracks) {
            complaints.complain(node, fmt::format("{} needs 1 to {} tracks", name, kMostTracks));
            return tracks;
        }
        for (const toml::node& one : *array) {
            tracks.push_back(read_track(one, complaints, name));
        }
    } else {
        tracks.push_back(read_track(node, complaints, name));
    }
    return tracks;
}

// Recurses into tables: TOML turns the dots of "arm.l.up" into nested tables.
void read_controls(const toml::table& table,
                   TomlComplaints& complaints,
                   const std::string& path,
                   WrittenBody& body) {
    for (const auto& [key, node] : table) {
        const std::string name =
            path.empty() ? std::string(key.str()) : path + "." + std::string(key.str());
        if (controls_named(name).count > 0) {
            body.entries.push_back(
                {name, read_tracks(node, complaints, name), node.source().begin.line});
        } else if (is_prefix(name) && node.is_table()) {
            read_controls(*node.as_table(), complaints, name, body);
        } else {
            complaints.complain(
                first_value(node, name).first,
                unknown_name("control", first_value(node, name).second, control_names()));
        }
    }
}

}  // namespace

void read_body(const toml::table& table, TomlComplaints& complaints, WrittenBody& body) {
    read_controls(table, complaints, "", body);
}

}  // namespace raks::motion
