#include "motion/figures/couple_form_reader.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "base/suggest.hpp"

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::size_t kMostHeld = 32;     // of one figure
constexpr std::size_t kMostContacts = 4;  // hands of two
constexpr double kLongestHold = 64.0;     // beats of a figure
constexpr double kFarthestApart = 10.0;   // metres
constexpr double kFarthestHips = 1.0;     // metres
constexpr double kMostClasp = 1.5;        // heights of the eyes
constexpr double kMostTurn = 60.0;        // degrees of a head
constexpr double kRadiansPerDegree = M_PI / 180.0;
constexpr std::array<std::string_view, 2> kHandNames = {"left", "right"};  // by Side
constexpr std::array<std::string_view, 2> kWhoNames = {"lead", "follow"};

/// The number; of anything else none, which every range refuses.
double number_in(const toml::node_view<const toml::node>& value) {
    return value.value<double>().value_or(std::nan(""));
}

/// Whether all keys are known; complains of the first that is not.
bool has_known_keys(const toml::table& table,
                    std::span<const std::string_view> known,
                    HoldComplaints& complaints) {
    for (const auto& entry : table) {
        if (std::find(known.begin(), known.end(), entry.first.str()) == known.end()) {
            complaints.add(entry.second,
                           unknown_name("key", entry.first.str(), known) + "; it is ignored");
            return false;
        }
    }
    return true;
}

/// The place of a key's text among names; none, with a complaint, where it is no such name.
std::optional<std::size_t> named_in(const toml::table& table,
                                    std::string_view key,
                                    std::span<const std::string_view> names,
                                    std::string_view instead,
                                    HoldComplaints& complaints) {
    const toml::node* const node = table.get(key);
    const std::string text = table[key].value_or(std::string());
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) {
        complaints.add(node != nullptr ? *node : static_cast<const toml::node&>(table),
                       unknown_name(key, text, names) + "; " + std::string(instead));
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - names.begin());
}

/// A pair of numbers up to `most`; none, with a complaint, where it is something else.
std::optional<glm::dvec2> pair_in(const toml::table& table,
                                  std::string_view key,
                                  double most,
                                  std::string_view what,
                                  HoldComplaints& complaints) {
    if (!table.contains(key)) {
        return std::nullopt;
    }
    const auto value = table[key];
    const glm::dvec2 pair(number_in(value[0]), number_in(value[1]));
    if (!(std::abs(pair.x) <= most && std::abs(pair.y) <= most)) {
        complaints.add(*table.get(key),
                       fmt::format("{} must be {}, each up to {}; it is ignored", key, what, most));
        return std::nullopt;
    }
    return pair;
}

void read_contact(const toml::node& node, ClosedFrame& frame, HoldComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {"who", "hand", "on", "side"};
    constexpr std::string_view kWithout = "the couple dances without this contact";
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        complaints.add(node,
                       fmt::format("a contact must be {{ who, hand, on, side }}; {}", kWithout));
        return;
    }
    if (!has_known_keys(*table, kKeys, complaints)) {
        return;
    }
    const auto who = named_in(*table, "who", kWhoNames, kWithout, complaints);
    const auto hand = who ? named_in(*table, "hand", kHandNames, kWithout, complaints) : who;
    const auto place = hand ? named_in(*table, "on", kHoldPlaceNames, kWithout, complaints) : hand;
    const auto side = place ? named_in(*table, "side", kHandNames, kWithout, complaints) : place;
    if (side) {
        frame.laid[*who][*hand] =
            LaidHand{static_cast<HoldPlace>(*place), static_cast<Side>(*side)};
    }
}

void read_frame(const toml::table& table, ClosedFrame& frame, HoldComplaints& complaints) {
    frame.hips = pair_in(table, "hips", kFarthestHips, "[left, forward] in metres", complaints);
    if (const auto look =
            pair_in(table, "look", kMostTurn, "[lead, follow] in degrees", complaints)) {
        frame.look = {kRadiansPerDegree * look->x, kRadiansPerDegree * look->y};
    }
    if (const toml::node* const node = table.get("clasp")) {
        const double clasp = number_in(table["clasp"]);
        if (clasp > 0.0 && clasp <= kMostClasp) {
            frame.clasp = clasp;
        } else {
            complaints.add(
                *node,
                fmt::format("clasp must be a number over 0, up to {}; it is ignored", kMostClasp));
        }
    }
    if (const toml::node* const node = table.get("contacts")) {
        const toml::array* const contacts = node->as_array();
        if (contacts == nullptr || contacts->size() > kMostContacts) {
            complaints.add(
                *node,
                fmt::format("contacts must be a list of at most {} tables; it is ignored",
                            kMostContacts));
            return;
        }
        frame.laid = {};
        for (const toml::node& one : *contacts) {
            read_contact(one, frame, complaints);
        }
    }
}

}  // namespace

void HoldComplaints::add(const toml::node& node, std::string_view what) {
    lines_.push_back(fmt::format("{}: line {}: {}", name_, node.source().begin.line, what));
}

CoupleForm read_couple_form(const toml::node& node, HoldComplaints& complaints) {
    constexpr std::array<std::string_view, 6> kKeys = {
        "hold", "apart", "hips", "clasp", "look", "contacts"};
    CoupleForm form;
    const toml::table* const table = node.as_table();
    if (table == nullptr) {
        complaints.add(node, "couple must be a table; the couple dances without a hold");
        return form;
    }
    // An unknown key is ignored, whatever else is read.
    static_cast<void>(has_known_keys(*table, kKeys, complaints));
    if (const auto hold = named_in(
            *table, "hold", kCoupleHoldNames, "the couple dances without a hold", complaints)) {
        form.hold = static_cast<CoupleHold>(*hold);
    }
    form.apart = pair_in(*table, "apart", kFarthestApart, "[left, forward] in metres", complaints);
    read_frame(*table, form.frame, complaints);
    return form;
}

std::vector<HeldHands> read_held_hands(const toml::node& node, HoldComplaints& complaints) {
    constexpr std::array<std::string_view, 4> kKeys = {"lead", "follow", "from", "to"};
    std::vector<HeldHands> holds;
    const toml::array* const array = node.as_array();
    if (array == nullptr || array->size() > kMostHeld) {
        complaints.add(
            node,
            fmt::format("holds must be a list of at most {} tables; the figure is danced without",
                        kMostHeld));
        return holds;
    }
    for (const toml::node& one : *array) {
        const toml::table* const hold = one.as_table();
        if (hold != nullptr && !has_known_keys(*hold, kKeys, complaints)) {
            continue;
        }
        const auto hand = [&](std::string_view key) {
            const std::string name = hold ? (*hold)[key].value_or(std::string()) : std::string();
            return std::find(kHandNames.begin(), kHandNames.end(), name) - kHandNames.begin();
        };
        const std::ptrdiff_t lead = hand("lead");
        const std::ptrdiff_t follow = hand("follow");
        const double from = hold != nullptr ? number_in((*hold)["from"]) : 0.0;
        const double to = hold != nullptr ? number_in((*hold)["to"]) : 0.0;
        if (std::max(lead, follow) > 1 || !(from >= 0.0 && from < to && to <= kLongestHold)) {
            complaints.add(one,
                           fmt::format("a hold needs lead and follow, \"left\" or \"right\", and "
                                       "from < to, beats from 0 to {}; the figure is danced "
                                       "without it",
                                       kLongestHold));
            continue;
        }
        holds.push_back({static_cast<Side>(lead), static_cast<Side>(follow), from, to});
    }
    return holds;
}

}  // namespace raks::motion
