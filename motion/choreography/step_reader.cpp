#include "motion/choreography/step_reader.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace raks::motion {
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

void read_steps(const toml::table& table, TomlComplaints& complaints, AuthoredFigure& figure) {
    const toml::node* const node = table.get("steps");
    if (node == nullptr) {
        return;
    }
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->size() > kMostSteps) {
        complaints.complain(*node,
                            fmt::format("steps must be a list of at most {} steps", kMostSteps));
        return;
    }
    for (const toml::node& one : *array) {
        const toml::table* const step = one.as_table();
        if (step == nullptr) {
            complaints.complain(one, "a step must be { foot = ..., at = ..., ... }");
            return;
        }
        figure.steps.push_back(read_step(*step, complaints, figure));
    }
    // Stable: of two steps at the same beat the written order decides.
    std::stable_sort(figure.steps.begin(),
                     figure.steps.end(),
                     [](const FootStep& a, const FootStep& b) { return a.at < b.at; });
}

}  // namespace raks::motion
