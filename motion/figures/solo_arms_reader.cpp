#include "motion/figures/solo_arms_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::size_t kMostPatterns = 64;
constexpr std::size_t kMostKeys = 64;     // of one hand
constexpr double kLongestPattern = 64.0;  // beats
constexpr double kFarthestWrist = 1.2;    // lengths of the arm

/// Three numbers from the `first` element of an array on; none where one is missing or too large.
std::optional<glm::vec3> vector_in(const toml::array& array, std::size_t first, double most) {
    glm::dvec3 vector(0.0);
    for (std::size_t i = 0; i < 3; ++i) {
        const toml::node* const node = array.get(first + i);
        const auto number = node != nullptr ? node->value<double>() : std::nullopt;
        if (!number || !(std::abs(*number) <= most)) {
            return std::nullopt;
        }
        vector[static_cast<glm::dvec3::length_type>(i)] = *number;
    }
    return glm::vec3(vector);
}

/// The keys of one hand; none at all where one of them is no key.
std::vector<ArmPattern::Key> keys_in(const toml::node* node, double beats) {
    std::vector<ArmPattern::Key> keys;
    const toml::array* const list = node != nullptr ? node->as_array() : nullptr;
    if (list == nullptr || list->size() > kMostKeys) {
        return keys;
    }
    for (const toml::node& one : *list) {
        const toml::array* const key = one.as_array();
        const auto wrist =
            key != nullptr && key->size() == 4 ? vector_in(*key, 1, kFarthestWrist) : std::nullopt;
        const double beat = wrist ? key->get(0)->value<double>().value_or(-1.0) : -1.0;
        const double after = keys.empty() ? 0.0 : keys.back().beat;
        if (!(beat > after && beat < beats)) {
            return {};
        }
        keys.push_back({beat, *wrist});
    }
    return keys;
}

/// One pattern; none where something of it is wrong.
std::optional<ArmPattern> pattern_in(const toml::node& node, double beats) {
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        return std::nullopt;
    }
    constexpr std::array<std::string_view, 4> kKeys = {
        "left", "right", "elbow_left", "elbow_right"};
    for (const auto& entry : *table) {
        if (std::find(kKeys.begin(), kKeys.end(), entry.first.str()) == kKeys.end()) {
            return std::nullopt;
        }
    }
    ArmPattern pattern;
    for (std::size_t side = 0; side < 2; ++side) {
        pattern.keys[side] = keys_in(table->get(kKeys[side]), beats);
        if (pattern.keys[side].empty()) {
            return std::nullopt;
        }
        if (const toml::node* const elbow = table->get(kKeys[2 + side])) {
            const toml::array* const array = elbow->as_array();
            const auto read = array != nullptr ? vector_in(*array, 0, 1.0) : std::nullopt;
            if (!read) {
                return std::nullopt;
            }
            pattern.elbow[side] = *read;
        }
    }
    return pattern;
}

}  // namespace

SoloArms read_solo_arms(const toml::node& node, HoldComplaints& complaints) {
    SoloArms solo;
    const toml::table* const table = node.as_table();
    const toml::node* const arms = table != nullptr ? table->get("arms") : nullptr;
    const toml::array* const list = arms != nullptr ? arms->as_array() : nullptr;
    if (list == nullptr || list->size() > kMostPatterns) {
        complaints.add(node,
                       fmt::format("solo must be a table with a list arms of at most {} tables; "
                                   "the arms dance as the figures have them",
                                   kMostPatterns));
        return solo;
    }
    constexpr std::array<std::string_view, 3> kKeys = {"beats", "home", "arms"};
    for (const auto& entry : *table) {
        if (std::find(kKeys.begin(), kKeys.end(), entry.first.str()) == kKeys.end()) {
            complaints.add(entry.second,
                           unknown_name("key", entry.first.str(), kKeys) + "; it is ignored");
        }
    }
    if (const toml::node* const beats = table->get("beats")) {
        const double read = beats->value<double>().value_or(0.0);
        if (read >= 1.0 && read <= kLongestPattern) {
            solo.beats = read;
        } else {
            complaints.add(
                *beats,
                fmt::format("beats must be a number from 1 to {}; it is ignored", kLongestPattern));
        }
    }
    if (const toml::node* const home = table->get("home")) {
        const toml::array* const array = home->as_array();
        const auto read = array != nullptr ? vector_in(*array, 0, kFarthestWrist) : std::nullopt;
        if (!read) {
            complaints.add(*home, "home must be [outward, up, ahead]; it is ignored");
        }
        solo.home = read.value_or(solo.home);
    }
    for (const toml::node& one : *list) {
        if (auto pattern = pattern_in(one, solo.beats)) {
            solo.patterns.push_back(std::move(*pattern));
        } else {
            complaints.add(
                one,
                fmt::format("arms need left and right = [[beat, outward, up, ahead], ...], beats "
                            "rising between 0 and {}, lengths up to {}; danced without them",
                            solo.beats,
                            kFarthestWrist));
        }
    }
    return solo;
}

}  // namespace raks::motion
