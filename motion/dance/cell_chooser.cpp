#include "motion/dance/cell_chooser.hpp"

#include <algorithm>
#include <cmath>

#include "base/random.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// From a prototype on a professional's dances: with these, energy asked and danced correlate by .5
// to .6, and a fifth of the four-beat windows of three minutes were danced before.
constexpr double kArcSoftness = 9.0;     // centimetres: weight exp(-(D / this)^2)
constexpr double kEnergySpread = 0.25;   // metres a second
constexpr int kLongestRun = 8;           // beats of a take in a row
constexpr int kShortRun = 3;             // a run is rarely cut before
constexpr double kGoOnEarly = 8.0;       // weight of the natural successor in a short run
constexpr double kGoOnLater = 1.5;       // and in a longer one
constexpr double kRepeatWeight = 0.003;  // of what was danced lately
// Costs of a future.
constexpr double kStageRadius = 1.3;  // metres from the middle that cost nothing
constexpr double kStageCost = 2.5;    // a square metre beyond
constexpr double kTurnedCost = 0.35;  // turned away, of 2
constexpr double kJoinCost = 0.5;
constexpr double kJoinDistance = 10.0;  // centimetres that cost 1 more
constexpr double kRepeatCost = 1.5;
constexpr double kEnergyCost = 4.0;  // a metre a second
constexpr std::uint64_t kDrawsAFuture = CellChooser::kLook + 1;
constexpr std::uint64_t kStream = 40;  // of random numbers
constexpr std::int32_t kNever = -1'000'000;
// Quiet music gets the calmest tenth, and none stays below or above what there is.
constexpr double kCalmest = 0.10;
constexpr double kGreatest = 0.95;

}  // namespace

double cell_energy(const CellGraph& graph, double energy) noexcept RAKS_NONBLOCKING {
    const double share = kCalmest + (kGreatest - kCalmest) * std::clamp(energy, 0.0, 1.0);
    const double at = share * static_cast<double>(graph.energies.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), graph.energies.size() - 2);
    const double part = at - static_cast<double>(i);
    return (1.0 - part) * static_cast<double>(graph.energies[i]) +
           part * static_cast<double>(graph.energies[i + 1]);
}

struct CellChooser::Future {
    CellStep last;
    int run = 1;
    FloorMove place;
    int beats = 0;
    double cost = 0.0;
    std::array<CellStep, kLook> steps{};
};

CellStep CellChooser::start(const CellGraph& graph, std::uint64_t seed) noexcept RAKS_NONBLOCKING {
    *this = CellChooser();
    seed_ = seed;
    last_danced_.fill(kNever);
    const CounterRandom random(seed, kStream);
    const double wanted = cell_energy(graph, 0.4);
    CellStep first;
    double least = 1e9;
    for (std::uint64_t i = 0; i < kFutures; ++i) {
        const auto cell = static_cast<std::uint16_t>(random.below(i, graph.cells.size()));
        const double cost = std::abs(static_cast<double>(graph.cells[cell].energy) - wanted) +
                            (graph.has_successor(cell) ? 0.0 : 1.0) +
                            (graph.cells[cell].is_second_half ? 0.5 : 0.0);
        if (cost < least) {
            least = cost;
            first = {cell, false, true};
        }
    }
    note(first);
    return first;
}

void CellChooser::note(const CellStep& step) noexcept {
    last_danced_[step.cell] = static_cast<std::int32_t>(beat_);
    run_ = step.is_joined ? 1 : run_ + 1;
    ++beat_;
}

// Beats since a cell was danced, or one beside it in its take.
std::int64_t CellChooser::beats_since(const Future& future,
                                      std::size_t cell,
                                      const CellGraph& graph,
                                      bool with_neighbours) const noexcept {
    const std::size_t first =
        with_neighbours && cell > 0 && graph.has_successor(cell - 1) ? cell - 1 : cell;
    const std::size_t last = with_neighbours && graph.has_successor(cell) ? cell + 1 : cell;
    std::int64_t latest = kNever;
    for (std::size_t i = first; i <= last; ++i) {
        latest = std::max<std::int64_t>(latest, last_danced_[i]);
    }
    for (int i = 0; i < future.beats; ++i) {
        const std::size_t own = future.steps[static_cast<std::size_t>(i)].cell;
        if (own >= first && own <= last) {
            latest = std::max(latest, beat_ + i);
        }
    }
    return beat_ + future.beats - latest;
}

namespace {

double weight_of_age(std::int64_t beats) noexcept {
    const double novel = CellChooser::kNovel;
    const auto age = static_cast<double>(beats);
    return age < novel         ? kRepeatWeight * age / novel
           : age < 4.0 * novel ? age / (4.0 * novel)
                               : 1.0;
}

double weight_of_energy(double energy, double wanted) noexcept {
    const double off = (energy - wanted) / kEnergySpread;
    return std::exp(-0.5 * off * off);
}

double weight_of_arc(const CellArc& arc) noexcept {
    const double off = static_cast<double>(arc.distance) / kArcSoftness;
    return std::exp(-off * off);
}

}  // namespace

// One draw among the natural successor and the arcs; nothing: there are neither.
std::optional<CellStep> CellChooser::drawn_step(const CellGraph& graph,
                                                const Future& future,
                                                const CellWish& wish,
                                                std::uint64_t draw) const noexcept {
    const std::size_t from = future.last.cell;
    const double wanted = cell_energy(graph, wish.energy);
    const auto suits = [&](std::size_t cell, bool is_joined) {
        return weight_of_age(beats_since(future, cell, graph, is_joined)) *
               weight_of_energy(static_cast<double>(graph.cells[cell].energy), wanted);
    };
    const auto arcs = graph.arcs_of(from);
    std::array<double, 65> weights{};  // of the arcs, and of the successor behind them
    const std::size_t count = std::min(arcs.size(), weights.size() - 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        weights[i] = weight_of_arc(arcs[i]) * suits(arcs[i].to, true);
        sum += weights[i];
    }
    const bool may_go_on =
        graph.has_successor(from) &&
        (count == 0 || (future.run < kLongestRun && !(wish.is_another && future.beats == 0)));
    if (may_go_on) {
        weights[count] =
            (future.run < kShortRun ? kGoOnEarly : kGoOnLater) * suits(from + 1, false);
        weights[count] = std::max(weights[count], 1e-12);
        sum += weights[count];
    }
    if (!may_go_on && count == 0) {
        return std::nullopt;
    }
    double at = CounterRandom(seed_, kStream + 1).uniform(draw) * sum;
    std::size_t chosen = 0;
    const std::size_t last = may_go_on ? count : count - 1;
    while (chosen < last && at >= weights[chosen]) {
        at -= weights[chosen];
        ++chosen;
    }
    if (chosen == count) {
        return CellStep{static_cast<std::uint16_t>(from + 1), future.last.is_mirrored, false};
    }
    return CellStep{arcs[chosen].to, arcs[chosen].is_mirrored != future.last.is_mirrored, true};
}

// Adds a step and what it costs.
void CellChooser::take(const CellGraph& graph,
                       const CellStep& step,
                       const CellWish& wish,
                       Future& future) const noexcept {
    const Cell& cell = graph.cells[step.cell];
    const double side = step.is_mirrored ? -1.0 : 1.0;
    if (step.is_joined) {
        const auto arcs = graph.arcs_of(future.last.cell);
        const auto arc = std::find_if(arcs.begin(), arcs.end(), [&](const CellArc& each) {
            return each.to == step.cell &&
                   each.is_mirrored == (future.last.is_mirrored != step.is_mirrored);
        });
        const double apart = static_cast<double>(arc->distance) / kJoinDistance;
        future.cost += kJoinCost + apart * apart;
    }
    if (beats_since(future, step.cell, graph, step.is_joined) < kNovel) {
        future.cost += kRepeatCost;
    }
    future.place = future.place * FloorMove{side * static_cast<double>(cell.turn),
                                            {side * static_cast<double>(cell.way.x),
                                             static_cast<double>(cell.way.y)}};
    const double beyond = std::max(0.0, glm::length(future.place.offset) - kStageRadius);
    future.cost += kStageCost * beyond * beyond;
    future.cost += wish.faces_us ? kTurnedCost * (1.0 - std::cos(future.place.heading)) : 0.0;
    future.cost +=
        kEnergyCost * std::abs(static_cast<double>(cell.energy) - cell_energy(graph, wish.energy));
    future.run = step.is_joined ? 1 : future.run + 1;
    future.last = step;
    future.steps[static_cast<std::size_t>(future.beats)] = step;
    ++future.beats;
}

void CellChooser::draw(const CellGraph& graph,
                       const CellStep& last,
                       const FloorMove& place,
                       const CellWish& wish) noexcept RAKS_NONBLOCKING {
    if (is_drawn()) {
        return;
    }
    Future future;
    future.last = last;
    future.run = run_;
    future.place = place;
    const std::uint64_t first =
        (static_cast<std::uint64_t>(beat_) * kFutures + static_cast<std::uint64_t>(drawn_)) *
        kDrawsAFuture;
    while (future.beats < kLook) {
        const auto step =
            drawn_step(graph, future, wish, first + static_cast<std::uint64_t>(future.beats));
        if (!step) {
            break;
        }
        take(graph, *step, wish, future);
    }
    if (drawn_ == 0 || future.cost < best_cost_) {
        best_cost_ = future.cost;
        std::copy_n(future.steps.begin(), best_.size(), best_.begin());
    }
    ++drawn_;
}

std::array<CellStep, CellChooser::kFollowed> CellChooser::decide() noexcept RAKS_NONBLOCKING {
    for (const CellStep& step : best_) {
        note(step);
    }
    drawn_ = 0;
    return best_;
}

}  // namespace raks::motion
