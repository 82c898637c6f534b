#include "motion/dance/choreography.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

namespace raks::motion {
namespace {

constexpr double kNowHops = 250.0;     // 2.5 s: about two bars
constexpr double kUsualHops = 3000.0;  // half a minute
constexpr double kQuietest = -60.0;    // LUFS: below it is silence, which says nothing of the music
constexpr double kSpan = 10.0;         // LU between the calmest and the liveliest
constexpr double kFit = 2.5;  // how much a figure's energy must fit: exp(-kFit |difference|)

constexpr std::uint64_t kFigureStream = 1;

}  // namespace

void MusicEnergy::advance(const MusicState& music) noexcept {
    const double loudness = static_cast<double>(music.loudness_lufs);
    if (music.is_silent || loudness < kQuietest) {
        return;
    }
    if (!has_heard_) {
        has_heard_ = true;
        now_ = usual_ = loudness;
    }
    now_ += (loudness - now_) / kNowHops;
    usual_ += (loudness - usual_) / kUsualHops;
}

double MusicEnergy::value() const noexcept {
    return std::clamp(0.5 + (now_ - usual_) / kSpan, 0.0, 1.0);
}

std::size_t Choreography::next(std::size_t current,
                               double energy,
                               const FigureWish& wish,
                               std::uint64_t seed,
                               std::uint64_t number) const noexcept {
    const std::size_t count = grammar_.rules.size();
    if (wish.figure && *wish.figure < count) {
        return *wish.figure;
    }
    if (wish.is_locked || count < 2) {
        return current;
    }
    const auto weight_of = [&](std::size_t figure) {
        if (wish.is_another && figure == current) {
            return 0.0;
        }
        return grammar_.rules[current].after[figure] *
               std::exp(-kFit * std::abs(grammar_.rules[figure].energy - energy));
    };
    double sum = 0.0;
    for (std::size_t figure = 0; figure < count; ++figure) {
        sum += weight_of(figure);
    }
    if (!(sum > 0.0)) {  // the grammar knows but this one, and another was asked for
        return (current + 1) % count;
    }
    double draw = sum * CounterRandom(seed, kFigureStream).uniform(number);
    for (std::size_t figure = 0; figure < count; ++figure) {
        draw -= weight_of(figure);
        if (draw < 0.0) {
            return figure;
        }
    }
    return current;
}

}  // namespace raks::motion
