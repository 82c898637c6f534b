#include "apps/reports/eval_avatar_report.hpp"

#include <cmath>

#include "apps/reports/text_table.hpp"
#include "base/json.hpp"
#include "motion/skeleton/skeleton.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {
using Value = std::optional<double>;
using Limit = std::optional<Bound>;

// Hips of the people whose feet the bounds were measured on, metres.
constexpr double kPeoplesHips = 0.892;

Limit no_bound(const AvatarDance& /*dance*/) { return std::nullopt; }

// From the mannequin's size, at which dances are solved, to the avatar's own.
double own_size(const AvatarDance& dance) {
    return dance.pelvis_height / static_cast<double>(motion::mannequin_skeleton().hips_height());
}

double by_hips(const AvatarDance& dance) { return dance.pelvis_height / kPeoplesHips; }

// A row gives: id, title, decimals, how the value is read and which bound applies.
constexpr AvatarQuantity kAvatarQuantities[] = {
    {"slip_p90_cm",
     "slip cm",
     2,
     [](const AvatarDance& d) {
         return Value(1e2 * own_size(d) * d.trial.measures.contacts.slip_p90);
     },
     [](const AvatarDance& d) { return Limit({.highest = 2.7 * by_hips(d)}); }},
    {"lowest_sole_cm",
     "lowest cm",
     2,
     [](const AvatarDance& d) { return Value(1e2 * d.mesh.lowest_sole); },
     [](const AvatarDance& d) { return Limit({.lowest = -0.5 * by_hips(d)}); }},
    {"planted_p99_cm",
     "planted cm",
     2,
     [](const AvatarDance& d) { return Value(1e2 * d.mesh.planted_p99); },
     [](const AvatarDance&) { return Limit({.highest = 1.0}); }},
    {"planted_share",
     "in 1 cm",
     3,
     [](const AvatarDance& d) { return Value(d.mesh.planted_share); },
     no_bound},
    {"landing_mean_ms",
     "land ms",
     1,
     [](const AvatarDance& d) { return Value(1e3 * d.trial.landing.mean); },
     [](const AvatarDance&) {
         return Limit({-15.0, 15.0});
     }},
    {"landing_deviation_ms",
     "sd ms",
     1,
     [](const AvatarDance& d) { return Value(1e3 * d.trial.landing.deviation); },
     [](const AvatarDance&) { return Limit({.highest = 25.0}); }},
    {"hands_inside_share",
     "hands in",
     3,
     [](const AvatarDance& d) { return Value(d.mesh.hands.inside_share); },
     [](const AvatarDance&) { return Limit({.highest = 0.01}); }},
    {"hands_deepest_cm",
     "deepest cm",
     1,
     [](const AvatarDance& d) { return Value(1e2 * d.mesh.hands.deepest); },
     no_bound},
    {"stretch_p995",
     "skin x",
     2,
     [](const AvatarDance& d) { return Value(d.mesh.stretch_p995); },
     [](const AvatarDance&) { return Limit({.highest = 3.0}); }},
    {"mirrored_p99_cm",
     "mirror cm",
     2,
     [](const AvatarDance& d) {
         return d.mesh.mirrored_p99 ? Value(1e2 * *d.mesh.mirrored_p99) : std::nullopt;
     },
     [](const AvatarDance&) { return Limit({.highest = 1.0}); }},
    {"tails_lost",
     "tails lost",
     0,
     [](const AvatarDance& d) {
         return d.mesh.tails ? Value(d.mesh.tails->is_finite ? 0.0 : 1.0) : std::nullopt;
     },
     [](const AvatarDance&) { return Limit({.highest = 0.0}); }},
    {"tails_stretch",
     "tails x",
     4,
     [](const AvatarDance& d) {
         return d.mesh.tails ? Value(d.mesh.tails->stretch) : std::nullopt;
     },
     [](const AvatarDance&) { return Limit({.highest = 0.01}); }},
    {"tails_inside_ms",
     "tails in ms",
     0,
     [](const AvatarDance& d) {
         return d.mesh.tails ? Value(1e3 * d.mesh.tails->longest_inside) : std::nullopt;
     },
     [](const AvatarDance&) { return Limit({.highest = 100.0}); }},
};

// What an avatar does not have keeps every bound.
bool is_outside(const AvatarQuantity& quantity, const AvatarDance& dance) {
    const Value value = quantity.value(dance);
    const Limit bound = quantity.bound(dance);
    return value && bound && !bound->holds(*value);
}

std::string cell(const AvatarQuantity& quantity, const AvatarDance& dance) {
    const Value value = quantity.value(dance);
    return value ? fmt::format(
                       "{:.{}f}{}", *value, quantity.digits, is_outside(quantity, dance) ? "!" : "")
                 : "-";
}

Json document_of(const AvatarDance& dance) {
    Json values = Json::object();
    Json bounds = Json::object();
    // JSON has no infinity: an open end of a bound is null.
    const auto finite = [](double end) { return std::isfinite(end) ? Json(end) : Json(nullptr); };
    for (const AvatarQuantity& quantity : kAvatarQuantities) {
        const std::string id(quantity.id);
        const Value value = quantity.value(dance);
        values[id] = value ? finite(*value) : Json(nullptr);
        if (const Limit bound = quantity.bound(dance)) {
            bounds[id] = {finite(bound->lowest), finite(bound->highest)};
        }
    }
    return {{"dance", dance.dance},
            {"values", values},
            {"bounds", bounds},
            {"outside", outside_of(dance)}};
}

}  // namespace

std::span<const AvatarQuantity> avatar_quantities() noexcept { return kAvatarQuantities; }

std::vector<std::string> outside_of(const AvatarDance& dance) {
    std::vector<std::string> outside;
    for (const AvatarQuantity& quantity : kAvatarQuantities) {
        if (is_outside(quantity, dance)) {
            outside.emplace_back(quantity.id);
        }
    }
    return outside;
}

std::string to_text(const AvatarReport& report) {
    std::vector<Row> rows = {{"avatar", "dance"}};
    for (const AvatarQuantity& quantity : kAvatarQuantities) {
        rows[0].emplace_back(quantity.title);
    }
    for (const AvatarRow& avatar : report.avatars) {
        for (const AvatarDance& dance : avatar.dances) {
            Row& row = rows.emplace_back(Row{avatar.name, dance.dance});
            for (const AvatarQuantity& quantity : kAvatarQuantities) {
                row.push_back(cell(quantity, dance));
            }
        }
    }
    return "Avatars in dances that are solved for them, 60 s each (lengths of feet are bound by "
           "the "
           "height of the hips)\n\n" +
           text_table(rows) + "\n";
}

std::string to_json(const AvatarReport& report) {
    Json document = {{"format", "raks-eval-avatar"}, {"version", 1}, {"seed", report.seed}};
    Json& avatars = document["avatars"] = Json::array();
    for (const AvatarRow& avatar : report.avatars) {
        Json dances = Json::array();
        for (const AvatarDance& dance : avatar.dances) {
            dances.push_back(document_of(dance));
        }
        avatars.push_back({{"model", avatar.model},
                           {"name", avatar.name},
                           {"height_m", avatar.height},
                           {"hips_m", avatar.hips_height},
                           {"dances", dances}});
    }
    // A name need not be UTF-8; invalid bytes become the replacement character.
    return document.text(2) + "\n";
}

}  // namespace raks::apps
