#include "motion/dance/figure_chooser.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace raks::motion {
namespace {

constexpr double kFit = 5.0;  // how much a figure's energy must fit: exp(-kFit |difference|)
// Weights by which a soloist prefers to stay facing the audience, and to turn back to it at once.
// Salsa then shows its face (less than 60 degrees aside) for 0.65 to 0.68 of the time. With 3 for
// the first: 0.48 to 0.63, since lively music asks for figures that turn.
constexpr double kStaysInFront = 6.0;
constexpr double kTurnsBack = 30.0;

constexpr std::uint64_t kFigureStream = 1;

}  // namespace

// The grammar's weight, times how well the energies fit, times the preference for facing the
// audience.
double FigureChooser::weight(std::size_t figure, const FigureMoment& moment) const noexcept {
    const double weight = grammar_.rules[moment.after].after[figure] *
                          std::exp(-kFit * std::abs(grammar_.rules[figure].energy - moment.energy));
    switch (moment.audience) {
        case Audience::ahead:
            return turns_half_[figure] ? weight : kStaysInFront * weight;
        case Audience::behind:
            return turns_half_[figure] ? kTurnsBack * weight : weight;
        case Audience::none:
            break;
    }
    return weight;
}

std::size_t FigureChooser::next(const FigureMoment& moment,
                                const FigureWish& wish,
                                std::uint64_t seed,
                                std::uint64_t number) const noexcept RAKS_NONBLOCKING {
    const std::size_t count = grammar_.rules.size();
    if (wish.figure && *wish.figure < count) {
        return *wish.figure;
    }
    if (wish.is_locked || count < 2) {
        return moment.after;
    }
    const auto weight_of = [&](std::size_t figure) {
        return wish.is_another && figure == moment.after ? 0.0 : weight(figure, moment);
    };
    double sum = 0.0;
    for (std::size_t figure = 0; figure < count; ++figure) {
        sum += weight_of(figure);
    }
    if (!(sum > 0.0)) {  // no other figure may follow, and another was asked for
        return (moment.after + 1) % count;
    }
    // Draws by cumulative weights.
    double draw = sum * CounterRandom(seed, kFigureStream).uniform(number);
    for (std::size_t figure = 0; figure < count; ++figure) {
        draw -= weight_of(figure);
        if (draw < 0.0) {
            return figure;
        }
    }
    return moment.after;
}

}  // namespace raks::motion
