#include "motion/choreography/authored_dance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr double kSlide = 1.0;  // cm; a foot that rises no more than this stays on the floor

/// The time that one step is off the floor, beats.
struct Flight {
    double from;
    double to;
};

// The flights of one foot in a repeat and in those before and after it, as a flight may reach over
// the ends of the figure. In a mirrored figure the neighbours are danced by the other foot.
std::vector<Flight> flights_of(const AuthoredFigure& figure, Side side) {
    std::vector<Flight> flights;
    for (int turn = -1; turn <= 1; ++turn) {
        for (const FootStep& step : figure.steps) {
            const Side foot = figure.is_mirrored && turn != 0
                                  ? (step.foot == Side::left ? Side::right : Side::left)
                                  : step.foot;
            if (foot == side && step.lift.value_or(kSlide + 1.0) > kSlide) {
                const double at = step.at + step.land + turn * figure.beats;
                flights.push_back({at - step.air, at});
            }
        }
    }
    return flights;
}

}  // namespace

double Track::lowest() const noexcept {
    // Keys count with the overshoot of the snap that ends at them; a spline may exceed its keys a
    // little, which is not counted.
    double least = rest - std::abs(wave);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const double moved = i == 0 ? 0.0 : over * (keys[i].value - keys[i - 1].value);
        const double value = std::min(keys[i].value, keys[i].value + moved);
        least = i == 0 ? value : std::min(least, value);
    }
    return least;
}

double Track::highest() const noexcept {
    double most = rest + std::abs(wave);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const double moved = i == 0 ? 0.0 : over * (keys[i].value - keys[i - 1].value);
        const double value = std::max(keys[i].value, keys[i].value + moved);
        most = i == 0 ? value : std::max(most, value);
    }
    return most;
}

const AuthoredFigure* AuthoredDance::figure(std::string_view name) const noexcept {
    const auto found = std::find_if(
        figures.begin(), figures.end(), [&](const auto& one) { return one.name == name; });
    return found != figures.end() ? &*found : nullptr;
}

std::string where_in(const AuthoredDance& dance, const AuthoredFigure& figure) {
    return fmt::format("{}: line {}: figure \"{}\"", dance.file, figure.line, figure.name);
}

std::vector<Hop> hops_of(const AuthoredFigure& figure) {
    // Each pair of flights that overlap longer than rounding gives one hop; it counts in the repeat
    // in which it ends.
    constexpr double kLeast = 0.01;  // beats
    std::vector<Hop> hops;
    for (const Flight& left : flights_of(figure, Side::left)) {
        for (const Flight& right : flights_of(figure, Side::right)) {
            const Hop hop{std::max(left.from, right.from), std::min(left.to, right.to)};
            if (hop.to - hop.from > kLeast && hop.to > 0.0 && hop.to <= figure.beats) {
                hops.push_back(hop);
            }
        }
    }
    std::sort(hops.begin(), hops.end(), [](const Hop& a, const Hop& b) { return a.from < b.from; });
    return hops;
}

}  // namespace raks::motion
