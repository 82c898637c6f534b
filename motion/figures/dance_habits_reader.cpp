#include "motion/figures/dance_habits_reader.hpp"

#include <algorithm>
#include <string>

#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

Expected<void> read_share(const toml::table& root, std::string_view key, double& share) {
    const double read = root[key].value_or(root.contains(key) ? -1.0 : share);
    if (!(read >= 0.0 && read <= 1.0)) {
        return fail(fmt::format("{} must be a number from 0 to 1", key));
    }
    share = read;
    return {};
}

Expected<void> read_places(const toml::table& root, std::vector<HandPlace>& places) {
    if (!root.contains("rest_at")) {
        return {};
    }
    const toml::array* const names = root["rest_at"].as_array();
    if (names == nullptr || names->empty() || names->size() > kHandPlaceNames.size()) {
        return fail("rest_at must be a list of one or more places for a hand");
    }
    places.clear();
    for (const toml::node& node : *names) {
        const auto name = node.value<std::string>().value_or("");
        const auto known = std::find(kHandPlaceNames.begin(), kHandPlaceNames.end(), name);
        if (known == kHandPlaceNames.end()) {
            return fail(unknown_name("rest_at", name, kHandPlaceNames));
        }
        places.push_back(static_cast<HandPlace>(known - kHandPlaceNames.begin()));
    }
    return {};
}

/// Reads a list of names whose faults leave the dance as it is: an unknown name is left out, and
/// a list that is none is not read. Each is a line of `notes`.
template <typename Value, std::size_t kCount>
void read_names(const toml::table& root,
                std::string_view key,
                const std::array<std::string_view, kCount>& known,
                std::vector<Value>& values,
                std::vector<std::string>& notes) {
    if (!root.contains(key)) {
        return;
    }
    const toml::array* const names = root[key].as_array();
    if (names == nullptr) {
        notes.push_back(fmt::format("{} must be a list of names; it is left out", key));
        return;
    }
    values.clear();
    for (const toml::node& node : *names) {
        const auto name = node.value<std::string>().value_or("");
        const auto found = std::find(known.begin(), known.end(), name);
        const auto value = static_cast<Value>(found - known.begin());
        if (found == known.end()) {
            notes.push_back(unknown_name(key, name, known) + "; it is left out");
        } else if (std::find(values.begin(), values.end(), value) == values.end()) {
            values.push_back(value);
        }
    }
}

}  // namespace

Expected<void> read_habits(const toml::table& root, DanceHabits& habits) {
    if (auto ok = read_share(root, "pauses", habits.pauses); !ok) {
        return ok;
    }
    if (auto ok = read_share(root, "rests", habits.rests); !ok) {
        return ok;
    }
    if (auto ok = read_share(root, "mirror", habits.mirror); !ok) {
        return ok;
    }
    read_names(root, "endings", kEndingNames, habits.endings, habits.notes);
    read_names(root, "idle", kIdleMoveNames, habits.idle, habits.notes);
    return read_places(root, habits.rest_at);
}

}  // namespace raks::motion
