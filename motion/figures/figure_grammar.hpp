#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"

namespace raks::motion {

/// How a dance goes from figure to figure: a bigram, and how lively each figure is.
struct FigureGrammar {
    struct Rule {
        std::string figure;
        double energy = 0.5;        ///< [0, 1]: 0 for the quietest music, 1 for the loudest
        std::vector<double> after;  ///< by figure: weight that it comes after this one, >= 0
    };
    std::string dance;
    std::vector<Rule> rules;  ///< by figure; the dance begins with the first

    /// Every figure after every other alike, none after itself unless it is alone.
    [[nodiscard]] static FigureGrammar uniform(const std::vector<std::string>& figures);
};

/// Reads models/trained/DANCE.toml: format = "raks-dance", version = 1, dance, and one [[figure]]
/// each with name, energy and `after` = { figure = weight, ... }. Errors, one line: not readable,
/// not TOML, another format, a newer version, unknown keys and figures (the nearest is named), two
/// figures of one name, weights that are negative or no numbers, a figure that nothing follows.
/// Threads: workers. Real-time: no.
[[nodiscard]] Expected<FigureGrammar> load_grammar(const std::filesystem::path& path);
[[nodiscard]] Expected<FigureGrammar> parse_grammar(std::string_view toml, const std::string& name);

}  // namespace raks::motion
