#include "motion/figures/dance_habits_reader.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "base/file.hpp"
#include "base/suggest.hpp"
#include "base/toml_reader.hpp"
#include "motion/figures/dance_mood_reader.hpp"

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

std::optional<HandPlace> place_of(std::string_view name) {
    const auto known = std::find(kHandPlaceNames.begin(), kHandPlaceNames.end(), name);
    return known != kHandPlaceNames.end()
               ? std::optional(static_cast<HandPlace>(known - kHandPlaceNames.begin()))
               : std::nullopt;
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
        const auto place = place_of(name);
        if (!place) {
            return fail(unknown_name("rest_at", name, kHandPlaceNames));
        }
        places.push_back(*place);
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

constexpr double kLargestShare = 1e6;     // of a shape
constexpr std::int64_t kMostCounts = 64;  // before another shape may be taken

// "line N: hands: ...", for messages.
std::string fault_at(const toml::node& node, std::string_view what) {
    return fmt::format("line {}: hands: {}", node.source().begin.line, what);
}

/// [hands] of the head; may be absent.
void read_hands(const toml::table& root, HandHabits& hands, std::vector<std::string>& faults) {
    const toml::node* const node = root.get("hands");
    if (node == nullptr) {
        return;
    }
    const toml::table* const table = node->as_table();
    if (table == nullptr) {
        faults.push_back(fault_at(*node, "must be a table"));
        return;
    }
    constexpr std::array<std::string_view, 3> kKeys = {"shapes", "every", "keep"};
    for (const auto& entry : *table) {
        if (entry.first.str() == "shapes") {
            read_shapes(entry.second, hands.shapes, faults);
        } else if (entry.first.str() == "every") {
            const auto every = entry.second.value_exact<std::int64_t>().value_or(0);
            if (every >= 1 && every <= kMostCounts) {
                hands.every = static_cast<int>(every);
            } else {
                faults.push_back(fault_at(
                    entry.second, fmt::format("every must be a number from 1 to {}", kMostCounts)));
            }
        } else if (entry.first.str() == "keep") {
            const std::string name = entry.second.value<std::string>().value_or("");
            if (const auto place = place_of(name)) {
                hands.keep = place;
            } else {
                faults.push_back(
                    fault_at(entry.second, unknown_name("keep", name, kHandPlaceNames)));
            }
        } else {
            faults.push_back(fault_at(entry.second, unknown_name("key", entry.first.str(), kKeys)));
        }
    }
}

}  // namespace

bool read_shapes(const toml::node& node,
                 HandShapeWeights& shapes,
                 std::vector<std::string>& faults) {
    HandShapeWeights read{};
    float sum = 0.0F;
    const auto add = [&](const toml::node& at, std::string_view name, double weight) {
        const auto known = std::find(kHandShapeNames.begin(), kHandShapeNames.end(), name);
        if (known == kHandShapeNames.end()) {
            faults.push_back(fault_at(at, unknown_name("shape", name, kHandShapeNames)));
        } else if (!(weight >= 0.0 && weight <= kLargestShare)) {
            faults.push_back(
                fault_at(at, fmt::format("the weight of \"{}\" must be a number >= 0", name)));
        } else {
            read[static_cast<std::size_t>(known - kHandShapeNames.begin())] =
                static_cast<float>(weight);
            sum += static_cast<float>(weight);
        }
    };
    if (const toml::table* const weights = node.as_table()) {
        for (const auto& entry : *weights) {
            add(entry.second, entry.first.str(), entry.second.value<double>().value_or(-1.0));
        }
    } else if (const auto name = node.value<std::string>()) {
        add(node, *name, 1.0);
    } else {
        faults.push_back(fault_at(node, "shapes must be a name or { name = weight, ... }"));
    }
    if (sum > 0.0F) {
        shapes = read;
    }
    return sum > 0.0F;
}

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
    read_hands(root, habits.hands, habits.notes);
    return read_places(root, habits.rest_at);
}

Expected<WrittenHabits> habits_of_file(const std::filesystem::path& path) {
    const auto text = read_text_file(path, kLongestToml);
    if (!text) {
        return fail(text.error());
    }
    const auto root = parse_toml(*text, path.string());
    if (!root) {
        return fail(root.error());
    }
    WrittenHabits written;
    std::vector<std::string>& notes = written.habits.notes;
    if (auto ok = read_habits(*root, written.habits); !ok) {
        return fail(fmt::format("{}: {}", path.string(), ok.error().message));
    }
    if (const toml::array* const figures = (*root)["figure"].as_array()) {
        written.has_figures = !figures->empty();
        for (const toml::node& figure : *figures) {
            const toml::table* const table = figure.as_table();
            if (const toml::node* const hands = table ? table->get("hands") : nullptr) {
                HandShapeWeights read{};
                read_shapes(*hands, read, notes);
            }
        }
    }
    for (std::string& note : notes) {
        note = fmt::format("{}: {}", path.string(), note);
    }
    const auto mood = parse_mood(*text, path.string());
    if (!mood) {
        notes.push_back(mood.error().message + "; faces go without it");
    }
    written.mood = mood.value_or(DanceMood());
    return written;
}

}  // namespace raks::motion
