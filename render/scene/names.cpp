#include "render/scene/names.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace raks::render {
namespace {

/// Fewest insertions, deletions and exchanges of letters that make `b` of `a`. (Levenshtein 1966)
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t exchanged = diagonal + (a[i] == b[j] ? 0U : 1U);
            diagonal = row[j + 1];
            row[j + 1] = std::min({exchanged, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row[b.size()];
}

constexpr std::size_t kLongestQuotedName = 60;  // of what the user typed, in the error line

}  // namespace

std::string unknown_name(std::string_view what,
                         std::string_view name,
                         std::span<const std::string_view> known) {
    const std::string_view shown = name.substr(0, kLongestQuotedName);
    const std::string_view nearest =
        *std::min_element(known.begin(), known.end(), [&](std::string_view a, std::string_view b) {
            return edit_distance(shown, a) < edit_distance(shown, b);
        });
    std::string line(what);
    line.append(" \"").append(shown).append("\" is unknown, did you mean \"");
    line.append(nearest).append("\"? (known:");
    for (std::size_t i = 0; i < known.size(); ++i) {
        line.append(i == 0 ? " " : ", ").append(known[i]);
    }
    return line.append(")");
}

}  // namespace raks::render
