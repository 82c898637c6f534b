#include "motion/figures/figure_grammar.hpp"

#include <toml++/toml.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/suggest.hpp"
#include "base/text_file.hpp"
#include "base/toml_headers.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "raks-dance";
constexpr std::int64_t kVersion = 1;
constexpr std::array<std::string_view, 2> kStartsNames = {"common", "own"};  // by Starts
constexpr double kLargestWeight = 1e6;
constexpr std::size_t kMaxGrammarBytes = std::size_t{1} << 20U;
constexpr double kFarthest = 10.0;      // metres
constexpr double kFarthestAside = 1.0;  // metres

/// Reads one grammar; the first fault ends it.
class GrammarReader {
 public:
    explicit GrammarReader(const std::string& name) : name_(name) {}

    Expected<FigureGrammar> read(const toml::table& root) {
        if (auto ok = check_keys(root,
                                 {"format",
                                  "version",
                                  "dance",
                                  "beats_per_bar",
                                  "starts",
                                  "lead",
                                  "follow",
                                  "figure"});
            !ok) {
            return fail(std::move(ok.error()));
        }
        if (root["format"].value<std::string>() != std::string(kFormat)) {
            return fail(fmt::format("{}: format must be \"{}\"", name_, kFormat));
        }
        const auto version = root["version"].value<std::int64_t>();
        if (!version || *version < 1 || *version > kVersion) {
            return fail(
                fmt::format("{}: version must be a number up to {}; is Raks older than the file?",
                            name_,
                            kVersion));
        }
        FigureGrammar grammar;
        grammar.dance = root["dance"].value_or(std::string());
        const toml::array* const figures = root["figure"].as_array();
        if (grammar.dance.empty() || figures == nullptr || figures->empty()) {
            return fail(name_ + ": needs dance = \"...\" and at least one [[figure]]");
        }
        const auto bar = root["beats_per_bar"].value_or<std::int64_t>(
            root.contains("beats_per_bar") ? 0 : grammar.beats_per_bar);
        if (bar < 2 || bar > 12) {
            return fail(name_ + ": beats_per_bar must be a number from 2 to 12");
        }
        grammar.beats_per_bar = static_cast<int>(bar);
        const auto starts = root["starts"].value_or(
            std::string(root.contains("starts") ? "" : kStartsNames.front()));
        const auto named = std::find(kStartsNames.begin(), kStartsNames.end(), starts);
        if (named == kStartsNames.end()) {
            return fail(name_ + ": starts must be \"common\" or \"own\"");
        }
        grammar.starts = static_cast<FigureGrammar::Starts>(named - kStartsNames.begin());
        for (const DanceRole role : {DanceRole::lead, DanceRole::follow}) {
            if (auto ok = read_place(root, role, grammar); !ok) {
                return fail(std::move(ok.error()));
            }
        }
        for (const toml::node& node : *figures) {
            if (auto ok = read_figure(node, grammar); !ok) {
                return fail(std::move(ok.error()));
            }
        }
        for (std::size_t i = 0; i < grammar.rules.size(); ++i) {
            if (auto ok = read_followers(*(*figures)[i].as_table(), grammar, i); !ok) {
                return fail(std::move(ok.error()));
            }
        }
        return grammar;
    }

 private:
    [[nodiscard]] std::string where(const toml::node& node) const {
        return fmt::format("{}: line {}", name_, node.source().begin.line);
    }

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

    /// Beyond every bound where there is no number.
    static double number_of(const toml::node_view<const toml::node>& value) {
        return value.value<double>().value_or(kLargestWeight);
    }

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

    Expected<void> read_figure(const toml::node& node, FigureGrammar& grammar) const {
        const toml::table* const table = node.as_table();
        if (table == nullptr) {
            return fail(where(node) + ": a figure must be a [[figure]] table");
        }
        if (auto ok = check_keys(*table, {"name", "energy", "after", "lead_aside", "follow_aside"});
            !ok) {
            return ok;
        }
        FigureGrammar::Rule rule;
        rule.figure = (*table)["name"].value_or(std::string());
        if (rule.figure.empty()) {
            return fail(where(node) + ": a figure needs a name");
        }
        const bool is_known =
            std::any_of(grammar.rules.begin(), grammar.rules.end(), [&](const auto& other) {
                return other.figure == rule.figure;
            });
        if (is_known) {
            return fail(fmt::format("{}: figure \"{}\" is there twice", where(node), rule.figure));
        }
        rule.energy = (*table)["energy"].value_or(table->contains("energy") ? -1.0 : 0.5);
        if (!(rule.energy >= 0.0 && rule.energy <= 1.0)) {
            return fail(where(node) + ": energy must be a number from 0 to 1");
        }
        for (std::size_t role = 0; role < kRoleNames.size(); ++role) {
            const std::string key = fmt::format("{}_aside", kRoleNames[role]);
            if (!table->contains(key)) {
                continue;
            }
            const auto value = (*table)[key];
            rule.aside[role] = {number_of(value[0]), number_of(value[1])};
            if (!(std::abs(rule.aside[role].x) <= kFarthestAside &&
                  std::abs(rule.aside[role].y) <= kFarthestAside)) {
                return fail(fmt::format("{}: {} must be [left, forward], each up to {} m",
                                        where(node),
                                        key,
                                        kFarthestAside));
            }
        }
        grammar.rules.push_back(std::move(rule));
        return {};
    }

    Expected<void> read_followers(const toml::table& table,
                                  FigureGrammar& grammar,
                                  std::size_t index) const {
        std::vector<std::string_view> names;
        for (const FigureGrammar::Rule& rule : grammar.rules) {
            names.push_back(rule.figure);
        }
        std::vector<double>& after = grammar.rules[index].after;
        after.assign(names.size(), 0.0);
        const toml::table* const weights = table["after"].as_table();
        double sum = 0.0;
        if (weights != nullptr) {
            for (const auto& entry : *weights) {
                const auto at = std::find(names.begin(), names.end(), entry.first.str());
                if (at == names.end()) {
                    return fail(where(entry.second) + ": " +
                                unknown_name("figure", entry.first.str(), names));
                }
                const double weight = entry.second.value<double>().value_or(-1.0);
                if (!(weight >= 0.0 && weight <= kLargestWeight)) {
                    return fail(fmt::format("{}: the weight of \"{}\" must be a number >= 0",
                                            where(entry.second),
                                            entry.first.str()));
                }
                after[static_cast<std::size_t>(at - names.begin())] = weight;
                sum += weight;
            }
        }
        if (!(sum > 0.0)) {
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
        rule.after.assign(figures.size(), 1.0);
        if (figures.size() > 1) {
            rule.after[i] = 0.0;
        }
        grammar.rules.push_back(std::move(rule));
    }
    return grammar;
}

Expected<FigureGrammar> parse_grammar(std::string_view text, const std::string& name) {
    if (const std::size_t line = line_of_nameless_header(text); line > 0) {
        return fail(fmt::format("{}: line {}: [ needs a name behind it", name, line));
    }
    try {
        const toml::table root = toml::parse(text);
        return GrammarReader(name).read(root);
    } catch (const toml::parse_error& error) {
        return fail(
            fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
    }
}

Expected<FigureGrammar> load_grammar(const fs::path& path) {
    auto text = read_text_file(path, kMaxGrammarBytes);
    if (!text) {
        return fail(std::move(text.error()));
    }
    return parse_grammar(*text, path.string());
}

}  // namespace raks::motion
