#include "motion/choreography/figure_reader.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

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

namespace {

using Names = std::vector<std::string_view>;

constexpr std::size_t kMostSteps = 512;  // of one figure

// -1 in the file stands for "no change", which an absent key cannot: absent means 1.
void read_weight(const toml::table& table, TomlComplaints& complaints, FootStep& step) {
    constexpr double kNoChange = -1.0;
    double weight = 1.0;
    complaints.read(table, "weight", {kNoChange, 1}, weight);
    if (weight < 0.0 && weight != kNoChange) {
        complaints.complain(
            *table.get("weight"),
            fmt::format("weight is {}, must be 0 to 1, or -1 for no change", weight));
    }
    step.weight = weight == kNoChange ? std::nullopt : std::optional<double>(weight);
}

// The names are in the order of FootLanding.
void read_landing(const toml::table& table, TomlComplaints& complaints, FootStep& step) {
    static constexpr std::array<std::string_view, 5> kLandings = {
        "ball", "flat", "heel", "touch", "heeltouch"};
    const std::string on = complaints.text(table, "on");
    if (on.empty()) {
        return;
    }
    const auto found = std::find(kLandings.begin(), kLandings.end(), on);
    if (found == kLandings.end()) {
        complaints.complain(*table.get("on"), unknown_name("part of the foot", on, kLandings));
        return;
    }
    step.on = static_cast<FootLanding>(found - kLandings.begin());
}

// A landing may be written up to a beat before the figure, where the step begins in the repeat
// before.
FootStep read_step(const toml::table& table,
                   TomlComplaints& complaints,
                   const AuthoredFigure& figure) {
    complaints.check_keys(table,
                          Names{"foot", "at", "to", "air", "lift", "on", "turn", "weight", "land"});
    FootStep step;
    step.line = table.source().begin.line;
    const std::string foot = complaints.text(table, "foot");
    if (foot != "l" && foot != "r") {
        complaints.complain(table, "a step needs foot = \"l\" or \"r\"");
    }
    step.foot = foot == "r" ? Side::right : Side::left;
    if (!table.contains("at")) {
        complaints.complain(table, "a step needs at = BEAT, when it lands");
    }
    complaints.read(table, "at", {-1, static_cast<double>(figure.beats)}, step.at);
    if (const toml::node* const node = table.get("to")) {
        const auto to = complaints.numbers<2>(*node, "to", {-200, 200}, "[left, forward] cm");
        step.to = glm::dvec2(to[0], to[1]);
    }
    step.air = figure.style.air;
    complaints.read(table, "air", {0.05, 4}, step.air);
    complaints.read(table, "lift", {0, 80}, step.lift);
    complaints.read(table, "turn", {-400, 400}, step.turn);
    complaints.read(table, "land", {-0.5, 0.5}, step.land);
    read_weight(table, complaints, step);
    read_landing(table, complaints, step);
    return step;
}

}  // namespace

std::vector<FootStep> read_steps(const toml::table& table,
                                 std::string_view key,
                                 TomlComplaints& complaints,
                                 const AuthoredFigure& figure) {
    std::vector<FootStep> steps;
    const toml::node* const node = table.get(key);
    if (node == nullptr) {
        return steps;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->size() > kMostSteps) {
        complaints.complain(*node,
                            fmt::format("{} must be a list of at most {} steps", key, kMostSteps));
        return steps;
    }
    for (const toml::node& one : *array) {
        const toml::table* const step = one.as_table();
        if (step == nullptr) {
            complaints.complain(one, "a step must be { foot = ..., at = ..., ... }");
            return steps;
        }
        steps.push_back(read_step(*step, complaints, figure));
    }
    // Stable: of two steps at the same beat the written order decides.
    std::stable_sort(steps.begin(), steps.end(), [](const FootStep& a, const FootStep& b) {
        return a.at < b.at;
    });
    return steps;
}

}  // namespace raks::motion
