// What is written into a grammar's file.
#include <fmt/format.h>

#include <algorithm>

#include "base/printable.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_grammar_format.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kLongestFigureName = 60;  // characters

}  // namespace

bool is_figure_name(std::string_view name) noexcept {
    // Not std::isalnum, which depends on the locale.
    const auto is_fit = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '-' || c == '_';
    };
    return !name.empty() && name.size() <= kLongestFigureName &&
           std::all_of(name.begin(), name.end(), is_fit);
}

std::string why_no_figure_name(std::string_view name) {
    return fmt::format("\"{}\" cannot name a file: letters a-z, digits, '-' and '_', 1 to {}",
                       printable(name, kLongestFigureName),
                       kLongestFigureName);
}

std::string figure_rule_text(std::string_view figure, double seen, std::string_view next) {
    const std::string after = next.empty() ? "" : fmt::format("after = {{ {} = 1 }}\n", next);
    return fmt::format("\n[[figure]]\nname = \"{}\"\nseen = {}\n{}", figure, seen, after);
}

std::string grammar_head_text(const FigureGrammar& grammar) {
    std::string couple;
    if (grammar.couple) {
        const auto hold = static_cast<std::size_t>(grammar.couple->hold);
        couple = fmt::format("\n[couple]\nhold = \"{}\"\n", kCoupleHoldNames[hold]);
        if (grammar.couple->apart) {
            couple += fmt::format(
                "apart = [{}, {}]\n", grammar.couple->apart->x, grammar.couple->apart->y);
        }
    }
    return fmt::format(
               "# Which figure comes after which. Without a line `after`, every other figure "
               "follows as\n"
               "# often as it was `seen` (0: only after those whose `after` names it); "
               "after = {{ NAME = 2,\n"
               "# OTHER = 1 }} says it for one figure.\n"
               "# energy = 0.0 ... 1.0 is the music that a figure is for: from the quietest to "
               "the\n"
               "# loudest. The dance begins with the first figure.\n"
               "format = \"{}\"\nversion = {}\ndance = \"{}\"\nbeats_per_bar = {}\nstarts = "
               "\"{}\"\n",
               kGrammarFormat,
               kGrammarVersion,
               grammar.dance,
               grammar.beats_per_bar,
               kStartsNames[static_cast<std::size_t>(grammar.starts)]) +
           couple;
}

}  // namespace raks::motion
