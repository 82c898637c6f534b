#include "motion/figures/figure_grammar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/file.hpp"
#include "base/plain_name.hpp"
#include "base/suggest.hpp"
#include "base/toml_reader.hpp"
#include "motion/figures/couple_form_reader.hpp"
#include "motion/figures/dance_habits_reader.hpp"
#include "motion/figures/figure_grammar_format.hpp"
#include "motion/figures/solo_arms_reader.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestWeight = 1e6;      // of `seen` and `after`
constexpr std::size_t kMostFigures = 1000;  // the weights between them are its square
constexpr double kFarthest = 10.0;          // metres to a turn point
constexpr double kFarthestAside = 1.0;      // metres that a partner moves aside

/// Reads one grammar; reading stops at the first fault.
class GrammarReader {
 public:
    explicit GrammarReader(const std::string& name) : name_(name) {}

    Expected<FigureGrammar> read(const toml::table& root) {
        FigureGrammar grammar;
        if (auto ok = read_head(root, grammar); !ok) {
            return fail(std::move(ok.error()));
        }
        if (auto ok = read_figures(root, grammar); !ok) {
            return fail(std::move(ok.error()));
        }
        return grammar;
    }

    /// Adds the figures of the file to those of `grammar`, and gives the old ones weights for them.
    Expected<void> extend(const toml::table& root, FigureGrammar& grammar) {
        // The head is checked, then dropped: the grammar keeps its own.
        FigureGrammar own;
        if (auto ok = read_head(root, own); !ok) {
            return ok;
        }
        const std::size_t known = grammar.rules.size();
        if (auto ok = read_figures(root, grammar); !ok) {
            return ok;
        }
        // The old figures know nothing of the new ones yet.
        for (std::size_t i = 0; i < known; ++i) {
            lead_on(grammar, known, grammar.rules[i].after);
        }
        return {};
    }

 private:
    /// Extends a rule that knows only the first `known` figures: each new one gets the mean of the
    /// positive weights, times its `seen`.
    static void lead_on(const FigureGrammar& grammar,
                        std::size_t known,
                        std::vector<double>& after) {
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t i = 0; i < known; ++i) {
            // Mean over the followers that it has, not over all figures.
            sum += after[i];
            count += after[i] > 0.0 ? 1.0 : 0.0;
        }
        for (std::size_t i = known; i < grammar.rules.size(); ++i) {
            after.push_back(grammar.rules[i].seen * sum / std::max(count, 1.0));
        }
    }

    // Everything but figures. An absent key takes its default; one of the wrong type must be an
    // error, hence the two different fallbacks of value_or().
    Expected<void> read_head(const toml::table& root, FigureGrammar& grammar) {
        if (auto ok = check_keys(root,
                                 {"format",
                                  "version",
                                  "dance",
                                  "beats_per_bar",
                                  "starts",
                                  "pauses",
                                  "rests",
                                  "rest_at",
                                  "endings",
                                  "idle",
                                  "hands",
                                  "mirror",
                                  "mood",
                                  "lead",
                                  "follow",
                                  "couple",
                                  "solo",
                                  "figure"});
            !ok) {
            return ok;
        }
        if (root["format"].value<std::string>() != std::string(kGrammarFormat)) {
            return fail(fmt::format("{}: format must be \"{}\"", name_, kGrammarFormat));
        }
        // A newer version is most likely a newer program's file.
        const auto version = root["version"].value_exact<std::int64_t>();
        if (!version || *version < 1 || *version > kGrammarVersion) {
            return fail(
                fmt::format("{}: version must be a number up to {}; is Raks older than the file?",
                            name_,
                            kGrammarVersion));
        }
        grammar.dance = root["dance"].value_or(std::string());
        // [[figure]] tables arrive as an array of tables.
        const toml::array* const figures = root["figure"].as_array();
        if (grammar.dance.empty() || figures == nullptr || figures->empty()) {
            return fail(name_ + ": needs dance = \"...\" and at least one [[figure]]");
        }
        if (!is_plain_name(grammar.dance)) {
            return fail(fmt::format("{}: dance: {}", name_, why_no_plain_name(grammar.dance)));
        }
        // Of a wrong type: 0, which fails the range check below.
        const std::int64_t bar = root.contains("beats_per_bar")
                                     ? root["beats_per_bar"].value_exact<std::int64_t>().value_or(0)
                                     : grammar.beats_per_bar;
        if (bar < 2 || bar > 12) {
            return fail(name_ + ": beats_per_bar must be a number from 2 to 12");
        }
        grammar.beats_per_bar = static_cast<int>(bar);
        const auto starts = root["starts"].value_or(
            std::string(root.contains("starts") ? "" : kStartsNames.front()));
        // In the order of Starts.
        const auto named = std::find(kStartsNames.begin(), kStartsNames.end(), starts);
        if (named == kStartsNames.end()) {
            return fail(name_ + ": starts must be \"common\" or \"own\"");
        }
        grammar.starts = static_cast<FigureGrammar::Starts>(named - kStartsNames.begin());
        if (auto ok = read_habits(root, grammar.habits); !ok) {
            return fail(name_ + ": " + ok.error().message);
        }
        for (std::string& note : grammar.habits.notes) {
            note.insert(0, name_ + ": ");
        }
        for (const DanceRole role : {DanceRole::lead, DanceRole::follow}) {
            if (auto ok = read_place(root, role, grammar); !ok) {
                return ok;
            }
        }
        // A hold that is none is no reason not to dance.
        if (const toml::node* const couple = root.get("couple")) {
            HoldComplaints complaints(name_, grammar.notes);
            grammar.couple = read_couple_form(*couple, complaints);
        }
        if (const toml::node* const solo = root.get("solo")) {
            HoldComplaints complaints(name_, grammar.notes);
            grammar.solo = read_solo_arms(*solo, complaints);
        }
        return {};
    }

    // Two passes: `after` may name figures that come later in the file.
    Expected<void> read_figures(const toml::table& root, FigureGrammar& grammar) {
        // Figures that are there already when a grammar is extended.
        const std::size_t known = grammar.rules.size();
        const toml::array& figures = *root["figure"].as_array();
        if (known + figures.size() > kMostFigures) {
            return fail(fmt::format(
                "{}: has {} figures, more than {}", name_, known + figures.size(), kMostFigures));
        }
        for (const toml::node& node : figures) {
            if (auto ok = read_figure(node, grammar); !ok) {
                return ok;
            }
        }
        for (std::size_t i = 0; i < figures.size(); ++i) {
            if (auto ok = read_followers(*figures[i].as_table(), grammar, known + i); !ok) {
                return ok;
            }
        }
        return {};
    }

    // "FILE: line N", for messages.
    [[nodiscard]] std::string where(const toml::node& node) const {
        return fmt::format("{}: line {}", name_, node.source().begin.line);
    }

    // An unknown key is most likely a typing error, so the nearest known one is suggested.
    Expected<void> check_keys(const toml::table& table,
                              const std::vector<std::string_view>& known) const {
        for (const auto& entry : table) {
            if (std::find(known.begin(), known.end(), entry.first.str()) == known.end()) {
                return fail(where(entry.second) + ": " +
                            unknown_name("key", entry.first.str(), known));
            }
        }
        return {};
    }

    /// The number, or, where there is none, one that fails every range check.
    static double number_of(const toml::node_view<const toml::node>& value) {
        return value.value<double>().value_or(kLargestWeight);
    }

    // [lead] or [follow]; either may be absent.
    Expected<void> read_place(const toml::table& root,
                              DanceRole role,
                              FigureGrammar& grammar) const {
        const std::string_view name = kRoleNames[static_cast<std::size_t>(role)];
        const toml::node* const node = root.get(name);
        if (node == nullptr) {
            return {};
        }
        const toml::table* const table = node->as_table();
        if (table == nullptr) {
            return fail(fmt::format("{}: {} must be a table", where(*node), name));
        }
        if (auto ok = check_keys(*table, {"turn_point", "heading"}); !ok) {
            return ok;
        }
        const auto point = (*table)["turn_point"];
        FigureGrammar::Place place;
        place.role = role;
        place.turn_point = {number_of(point[0]), number_of(point[1])};
        // Degrees in the file, radians in the grammar.
        const double degrees = table->contains("heading") ? number_of((*table)["heading"]) : 0.0;
        place.heading = degrees * M_PI / 180.0;
        if (!(std::abs(place.turn_point.x) <= kFarthest &&
              std::abs(place.turn_point.y) <= kFarthest && std::abs(degrees) <= 360.0)) {
            return fail(
                fmt::format("{}: {} needs turn_point = [left, forward], each up to {} m, "
                            "and a heading of up to 360 degrees",
                            where(*node),
                            name,
                            kFarthest));
        }
        grammar.places.push_back(place);
        return {};
    }

    // How far partners move aside in a figure.
    Expected<void> read_asides(const toml::table& table, FigureGrammar::Rule& rule) const {
        for (std::size_t role = 0; role < kRoleNames.size(); ++role) {
            // "lead_aside" and "follow_aside".
            const std::string key = fmt::format("{}_aside", kRoleNames[role]);
            if (!table.contains(key)) {
                continue;
            }
            const auto value = table[key];
            rule.aside[role] = {number_of(value[0]), number_of(value[1])};
            if (!(std::abs(rule.aside[role].x) <= kFarthestAside &&
                  std::abs(rule.aside[role].y) <= kFarthestAside)) {
                return fail(fmt::format("{}: {} must be [left, forward], each up to {} m",
                                        where(table),
                                        key,
                                        kFarthestAside));
            }
        }
        return {};
    }

    // One [[figure]] but for its `after`.
    Expected<void> read_figure(const toml::node& node, FigureGrammar& grammar) const {
        const toml::table* const table = node.as_table();
        if (table == nullptr) {
            return fail(where(node) + ": a figure must be a [[figure]] table");
        }
        if (auto ok = check_keys(*table,
                                 {"name",
                                  "energy",
                                  "seen",
                                  "after",
                                  "lead_aside",
                                  "follow_aside",
                                  "holds",
                                  "hands",
                                  "mirror",
                                  "still",
                                  "half_tempo"});
            !ok) {
            return ok;
        }
        FigureGrammar::Rule rule;
        rule.figure = (*table)["name"].value_or(std::string());
        if (rule.figure.empty()) {
            return fail(where(node) + ": a figure needs a name");
        }
        if (!is_plain_name(rule.figure)) {
            return fail(where(node) + ": name: " + why_no_plain_name(rule.figure));
        }
        // Names are how rules refer to one another, so they must be unique.
        const bool is_known =
            std::any_of(grammar.rules.begin(), grammar.rules.end(), [&](const auto& other) {
                return other.figure == rule.figure;
            });
        if (is_known) {
            return fail(fmt::format("{}: figure \"{}\" is there twice", where(node), rule.figure));
        }
        // -1 stands for a wrong type and fails the check below.
        rule.energy = (*table)["energy"].value_or(table->contains("energy") ? -1.0 : 0.5);
        if (!(rule.energy >= 0.0 && rule.energy <= 1.0)) {
            return fail(where(node) + ": energy must be a number from 0 to 1");
        }
        rule.seen = (*table)["seen"].value_or(table->contains("seen") ? -1.0 : 1.0);
        if (!(rule.seen >= 0.0 && rule.seen <= kLargestWeight)) {
            return fail(where(node) + ": seen must be a number >= 0");
        }
        for (const auto& [key, value] :
             {std::pair("mirror", &rule.can_mirror), std::pair("half_tempo", &rule.can_slow)}) {
            const auto read = (*table)[key].value<bool>();
            if (table->contains(key) && !read) {
                return fail(fmt::format("{}: {} must be true or false", where(node), key));
            }
            *value = read.value_or(*value);
        }
        if (auto ok = read_asides(*table, rule); !ok) {
            return ok;
        }
        if (const toml::node* const hands = table->get("hands")) {
            HandShapeWeights shapes{};
            std::vector<std::string> untold;  // by habits_of_file()
            if (read_shapes(*hands, shapes, untold)) {
                rule.hands = shapes;
            }
        }
        if (table->contains("still")) {
            const std::string still = (*table)["still"].value_or(std::string());
            const auto named = std::find(kStillPartNames.begin(), kStillPartNames.end(), still);
            if (named == kStillPartNames.end()) {
                return fail(where(node) + ": " + unknown_name("still", still, kStillPartNames));
            }
            rule.still = static_cast<StillPart>(named - kStillPartNames.begin());
        }
        if (const toml::node* const holds = table->get("holds")) {
            HoldComplaints complaints(name_, grammar.notes);
            rule.holds = read_held_hands(*holds, complaints);
        }
        grammar.rules.push_back(std::move(rule));
        return {};
    }

    /// Weights of a figure without `after`: every other figure by its `seen`; a single figure
    /// follows itself.
    static void follow_as_seen(FigureGrammar& grammar, std::size_t index) {
        std::vector<double>& after = grammar.rules[index].after;
        for (std::size_t i = 0; i < after.size(); ++i) {
            after[i] = i != index || after.size() == 1 ? grammar.rules[i].seen : 0.0;
        }
    }

    // The weights after figure `index`; figures not named get 0.
    Expected<void> read_followers(const toml::table& table,
                                  FigureGrammar& grammar,
                                  std::size_t index) const {
        std::vector<std::string_view> names;
        for (const FigureGrammar::Rule& rule : grammar.rules) {
            // All figures, those of an extended grammar included.
            names.push_back(rule.figure);
        }
        std::vector<double>& after = grammar.rules[index].after;
        after.assign(names.size(), 0.0);
        if (!table.contains("after")) {
            follow_as_seen(grammar, index);
        } else if (const toml::table* const weights = table["after"].as_table()) {
            for (const auto& entry : *weights) {
                const auto at = std::find(names.begin(), names.end(), entry.first.str());
                if (at == names.end()) {
                    return fail(where(entry.second) + ": " +
                                unknown_name("figure", entry.first.str(), names));
                }
                // A negative number stands for a wrong type.
                const double weight = entry.second.value<double>().value_or(-1.0);
                if (!(weight >= 0.0 && weight <= kLargestWeight)) {
                    return fail(fmt::format("{}: the weight of \"{}\" must be a number >= 0",
                                            where(entry.second),
                                            entry.first.str()));
                }
                after[static_cast<std::size_t>(at - names.begin())] = weight;
            }
        }
        // Without any follower the dance could not go on.
        if (std::all_of(after.begin(), after.end(), [](double weight) { return weight == 0.0; })) {
            return fail(fmt::format("{}: nothing comes after \"{}\"; give it after = {{ ... }}",
                                    where(table),
                                    names[index]));
        }
        return {};
    }

    const std::string& name_;
};

}  // namespace

const FigureGrammar::Place* FigureGrammar::place_of(DanceRole role) const noexcept {
    const auto place = std::find_if(
        places.begin(), places.end(), [role](const Place& one) { return one.role == role; });
    return place != places.end() ? &*place : nullptr;
}

FigureGrammar FigureGrammar::uniform(const std::vector<std::string>& figures) {
    FigureGrammar grammar;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        Rule rule;
        rule.figure = figures[i];
        // Equal weights, but no figure directly after itself.
        rule.after.assign(figures.size(), 1.0);
        if (figures.size() > 1) {
            rule.after[i] = 0.0;
        }
        grammar.rules.push_back(std::move(rule));
    }
    return grammar;
}

namespace {

/// Parses TOML and passes the table to `read`, which returns an Expected.
template <typename Read>
auto with_toml(std::string_view text, const std::string& name, const Read& read)
    -> decltype(read(toml::table())) {
    const auto root = parse_toml(text, name);
    if (!root) {
        return fail(root.error());
    }
    return read(*root);
}

}  // namespace

Expected<FigureGrammar> parse_grammar(std::string_view text, const std::string& name) {
    return with_toml(
        text, name, [&name](const toml::table& root) { return GrammarReader(name).read(root); });
}

Expected<FigureGrammar> load_grammar(const fs::path& path) {
    auto text = read_text_file(path, kLongestToml);
    if (!text) {
        return fail(std::move(text.error()));
    }
    return parse_grammar(*text, path.string());
}

Expected<void> extend_grammar(const fs::path& path, FigureGrammar& grammar) {
    auto text = read_text_file(path, kLongestToml);
    if (!text) {
        return fail(std::move(text.error()));
    }
    // A copy, so that an error leaves the grammar as it was.
    FigureGrammar extended = grammar;
    const std::string name = path.string();
    // Errors carry the name of the file that extends.
    auto done = with_toml(*text, name, [&](const toml::table& root) {
        return GrammarReader(name).extend(root, extended);
    });
    if (done) {
        grammar = std::move(extended);
    }
    return done;
}

Expected<std::vector<std::string>> figures_in_grammar(std::string_view text,
                                                      const std::string& name) {
    return with_toml(text, name, [](const toml::table& root) -> Expected<std::vector<std::string>> {
        std::vector<std::string> names;
        if (const toml::array* const figures = root["figure"].as_array()) {
            for (const toml::node& node : *figures) {
                const toml::table* const table = node.as_table();
                // A figure without a name counts with an empty one, so that positions stay.
                names.push_back(table != nullptr ? (*table)["name"].value_or(std::string())
                                                 : std::string());
            }
        }
        return names;
    });
}

}  // namespace raks::motion
