#include "motion/formation.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kApart = 1.3;  // metres between two who dance side by side
// Who dances figures of its own goes ways of its own.
constexpr double kFreeApart = 1.9;
constexpr std::size_t kLongestRow = 7;
constexpr std::size_t kLargestCircle = 10;

using Places = std::vector<glm::dvec2>;

/// The first in the middle, then to either side.
Places side_by_side(std::size_t dancers) {
    Places places;
    for (std::size_t i = 0; i < dancers; ++i) {
        const std::size_t whole_steps = (i + dancers % 2) / 2;
        const double steps = static_cast<double>(whole_steps) + (dancers % 2 == 1 ? 0.0 : 0.5);
        const bool is_right = (i + dancers) % 2 == 0;
        places.emplace_back(is_right ? -kApart * steps : kApart * steps, 0.0);
    }
    return places;
}

/// Rows from the front to the back that differ by one dancer at most; each stands before the gaps
/// of the one behind it.
Places in_rows(std::size_t dancers, std::size_t rows) {
    Places places;
    for (std::size_t row = 0; row < rows; ++row) {
        const std::size_t count = dancers * (row + 1) / rows - dancers * row / rows;
        // A quarter of a step aside, to the side that the row's length and its neighbours ask for.
        const double shift = (row + count) % 2 == 0 ? 0.25 : -0.25;
        for (std::size_t i = 0; i < count; ++i) {
            places.emplace_back(
                kApart * (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1) + shift),
                kApart * (0.5 * static_cast<double>(rows - 1) - static_cast<double>(row)));
        }
    }
    return places;
}

/// A third more of them in a row than rows.
std::size_t rows_of_grid(std::size_t dancers) {
    constexpr double kWider = 1.3;
    const auto count = static_cast<double>(dancers);
    return static_cast<std::size_t>(std::lround(count / std::sqrt(kWider * count)));
}

/// The first at the front. `turn`: of all, as a share of the way to the next.
void add_circle(std::size_t dancers, double least_radius, double turn, Places& places) {
    const auto count = static_cast<double>(dancers);
    const double chord = dancers == 1 ? 0.0 : kApart / (2.0 * std::sin(M_PI / count));
    const double radius = std::max(chord, least_radius);
    for (std::size_t i = 0; i < dancers; ++i) {
        const double angle = 2.0 * M_PI * (static_cast<double>(i) + turn) / count;
        places.emplace_back(radius * std::sin(angle), radius * std::cos(angle));
    }
}

Places in_circles(std::size_t dancers) {
    Places places;
    if (dancers == 2) {
        return side_by_side(dancers);  // in a circle one would hide the other
    }
    if (dancers <= kLargestCircle) {
        add_circle(dancers, 0.0, 0.0, places);
        return places;
    }
    // A third of them inside, who look through the gaps.
    const std::size_t inside = dancers / 3;
    const double inner = kApart / (2.0 * std::sin(M_PI / static_cast<double>(inside)));
    add_circle(dancers - inside, inner + kApart, 0.0, places);
    add_circle(inside, 0.0, 0.5, places);
    return places;
}

/// One wedge behind the other, of kLongestRow each.
Places in_wedges(std::size_t dancers) {
    // Along the floor to the next of a wing: as far apart as side by side.
    constexpr double kSlope = 0.5;
    const double aside = kApart / std::hypot(1.0, kSlope);
    const std::size_t wing = std::min(dancers, kLongestRow) / 2;
    const std::size_t wedges_behind = (dancers - 1) / kLongestRow;
    const double depth =
        static_cast<double>(wing) * kSlope * aside + static_cast<double>(wedges_behind) * kApart;
    Places places;
    for (std::size_t i = 0; i < dancers; ++i) {
        const std::size_t number = i % kLongestRow;
        const std::size_t whole_steps = (number + 1) / 2;
        const std::size_t wedge = i / kLongestRow;
        const auto steps = static_cast<double>(whole_steps);
        places.emplace_back(
            (number % 2 == 1 ? -aside : aside) * steps,
            0.5 * depth - kSlope * aside * steps - kApart * static_cast<double>(wedge));
    }
    return places;
}

/// Rows that are not straight: in an order without a pattern, the same each time.
Places here_and_there(std::size_t dancers) {
    Places places = in_rows(dancers, rows_of_grid(dancers));
    // The golden angle: no two neighbours stray alike.
    constexpr double kTurn = 2.399963;
    constexpr double kStray = 0.2;  // metres
    for (std::size_t i = 0; i < places.size(); ++i) {
        const double angle = kTurn * static_cast<double>(i);
        places[i] =
            kFreeApart / kApart * places[i] + kStray * glm::dvec2(std::sin(angle), std::cos(angle));
    }
    return places;
}

}  // namespace

std::size_t dancers_in(Formation formation, std::size_t asked) noexcept {
    constexpr std::array<std::size_t, kFormationNames.size()> kUsual = {1, 2, 3, 3, 3, 6, 6, 5};
    const std::size_t usual = kUsual[static_cast<std::size_t>(formation)];
    const bool is_fixed = formation == Formation::solo || formation == Formation::couple;
    return is_fixed || asked == 0 ? usual : std::min(asked, kMostDancers);
}

double room_in(Formation formation) noexcept {
    constexpr double kAlone = 1.3;
    constexpr double kBody = 0.35;  // half of it
    switch (formation) {
        case Formation::free:
            return 0.5 * kFreeApart - kBody;
        case Formation::canon:
            return 0.5 * kApart - 0.5 * kBody;
        default:
            return kAlone;  // all go the same ways
    }
}

std::vector<glm::dvec2> places_in(Formation formation, std::size_t dancers) {
    switch (formation) {
        case Formation::solo:
        case Formation::couple:
            return Places(dancers, glm::dvec2(0.0));
        case Formation::unison:
        case Formation::canon:
            return dancers <= kLongestRow
                       ? side_by_side(dancers)
                       : in_rows(dancers, (dancers + kLongestRow - 1) / kLongestRow);
        case Formation::free:
            return dancers <= 3 ? side_by_side(dancers) : here_and_there(dancers);
        case Formation::grid:
            return in_rows(dancers, rows_of_grid(dancers));
        case Formation::ring:
            return in_circles(dancers);
        case Formation::v:
            return in_wedges(dancers);
    }
    return {};
}

}  // namespace raks::motion
