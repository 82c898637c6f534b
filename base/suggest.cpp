#include "base/suggest.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

#include "base/printable.hpp"

namespace raks {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Levenshtein distance, letter case ignored. Keeps one row of the table; `diagonal` is the entry
/// up and to the left.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t substituted = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({substituted, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> known) {
    std::string_view best;
    // Distances below this count as close.
    std::size_t best_distance = name.size() / 3 + 2;
    for (const std::string_view candidate : known) {
        const std::size_t distance = edit_distance(name, candidate);
        // Strictly less: of equally close names the first wins.
        if (distance < best_distance) {
            best_distance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string suggestion(std::string_view name, std::span<const std::string_view> known) {
    const std::string_view nearest = nearest_name(name, known);
    if (!nearest.empty()) {
        return "; did you mean \"" + printable(nearest) + "\"?";
    }
    // Nothing is close: lists all.
    std::string text = "; known: ";
    for (const std::string_view candidate : known) {
        text.append(printable(candidate)).append(candidate == known.back() ? "" : ", ");
    }
    return text;
}

std::string unknown_name(std::string_view what,
                         std::string_view name,
                         std::span<const std::string_view> known) {
    constexpr std::size_t kLongest = 40;
    // Cut before it is shown: the name may be any text.
    const std::string_view shown = name.substr(0, kLongest);
    return std::string(what) + " \"" + printable(shown) + "\" is unknown" +
           suggestion(shown, known);
}

}  // namespace raks
