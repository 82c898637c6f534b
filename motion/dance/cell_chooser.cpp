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
constexpr double kEnergySpread = 0.40;   // of the shares that are drawn
constexpr int kLongestRun = 8;           // beats of a take in a row
constexpr int kShortRun = 3;             // a run is rarely cut before
constexpr double kGoOnEarly = 8.0;       // weight of the natural successor in a short run
constexpr double kGoOnLater = 1.5;       // and in a longer one
constexpr double kRepeatWeight = 0.003;  // of what was danced lately
// Costs of a future.
constexpr double kStageCost = 4.2;   // beyond the room, by the square of the room's radius
constexpr double kTurnedCost = 0.8;  // turned away, of 2
constexpr double kJoinCost = 0.5;
constexpr double kJoinDistance = 10.0;  // centimetres that cost 1 more
constexpr double kRepeatCost = 3.0;     // at once; nothing after kForgotten beats
constexpr double kForgotten = 4.0 * CellChooser::kNovel;
constexpr std::int64_t kMirroredLater =
    4;                                 // times as long ago counts what was danced left for right
constexpr double kEnergyCost = 3.0;    // of the greatest cell where the calmest is wanted
constexpr double kNearShare = 0.20;    // a difference of shares that costs nothing: for variety
constexpr double kRestCost = 7.0;      // a moment of middling speed where a rest is wanted
constexpr double kGreatestCost = 3.0;  // a cell that is not one of the greatest where one is wanted
constexpr double kNaturalCost = 2.0;   // the natural successor where another cell is wanted
constexpr double kFarJoin = 6.0;       // a change along no arc
constexpr double kOffRow = 3.0;        // a beat that is not the one of the row
// Metres beyond the room where no row is asked for: it would lead on from there.
constexpr double kRowBeyond = 0.7;
constexpr double kJumpsIntoRow = 0.4;  // share of the futures that go to a row along no arc
// A rest is drawn this much more often where it is wanted, by its speed over the middling one.
constexpr double kRestSoftness = 2.5;
constexpr std::uint64_t kDrawsAFuture = CellChooser::kLook + 1;
constexpr std::uint64_t kStream = 40;  // of random numbers
constexpr std::int32_t kNever = -1'000'000;

// How far the end of a cell is from a rest: 0 at rest, 1 as a cell of middling energy.
double unrest(const CellGraph& graph, std::size_t cell) noexcept {
    const double middling = static_cast<double>(graph.energies[graph.energies.size() / 2]);
    const double speed = static_cast<double>(graph.cells[cell].speed_at_end);
    const double over = std::max(0.0, speed - static_cast<double>(kRestSpeed));
    return is_rest(graph, cell) ? 0.0 : 0.1 + over / std::max(0.1, middling);
}

// The arc from one step to another; null: none.
const CellArc* arc_between(const CellGraph& graph,
                           const CellStep& from,
                           const CellStep& to) noexcept {
    for (const CellArc& arc : graph.arcs_of(from.cell)) {
        if (arc.to == to.cell && arc.is_mirrored == (from.is_mirrored != to.is_mirrored)) {
            return &arc;
        }
    }
    return nullptr;
}

bool is_successor(const CellGraph& graph, const CellStep& from, const CellStep& to) noexcept {
    return to.cell == from.cell + 1 && to.is_mirrored == from.is_mirrored &&
           graph.has_successor(from.cell);
}

}  // namespace

double energy_share(const CellGraph& graph, std::size_t cell) noexcept RAKS_NONBLOCKING {
    const float energy = graph.cells[cell].energy;
    const auto& quantiles = graph.energies;
    const auto above = std::upper_bound(quantiles.begin(), quantiles.end(), energy);
    if (above == quantiles.begin() || above == quantiles.end()) {
        return above == quantiles.begin() ? 0.0 : 1.0;
    }
    const float below = *(above - 1);
    const float part = (energy - below) / (*above - below);
    return (static_cast<double>(above - 1 - quantiles.begin()) + static_cast<double>(part)) /
           static_cast<double>(quantiles.size() - 1);
}

bool may_follow(const CellGraph& graph,
                const CellStep& from,
                const CellStep& to) noexcept RAKS_NONBLOCKING {
    return is_successor(graph, from, to) || arc_between(graph, from, to) != nullptr;
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
    if (graph_ != &graph || seed_ != seed) {
        *this = CellChooser();
        graph_ = &graph;
        seed_ = seed;
        last_danced_[0].fill(kNever);
        last_danced_[1].fill(kNever);
    }
    forget_futures();
    const CounterRandom random(seed, kStream);
    constexpr double kMiddling = 0.4;
    CellStep first;
    double least = 1e9;
    for (std::uint64_t i = 0; i < kFutures; ++i) {
        const std::uint64_t draw = static_cast<std::uint64_t>(beat_) * kFutures + i;
        const auto cell = static_cast<std::uint16_t>(random.below(draw, graph.cells.size()));
        const double cost = std::abs(energy_share(graph, cell) - kMiddling) +
                            (graph.has_successor(cell) ? 0.0 : 1.0) +
                            (graph.cells[cell].is_second_half ? 10.0 : 0.0) +
                            (beat_ - last_danced_[0][cell] < kNovel ? 1.0 : 0.0);
        if (cost < least) {
            least = cost;
            first = {cell, false, true};
        }
    }
    note(first);
    return first;
}

void CellChooser::forget_futures() noexcept {
    drawn_ = 0;
    kept_beats_ = 0;
}

void CellChooser::note(const CellStep& step) noexcept {
    last_danced_[step.is_mirrored ? 1 : 0][step.cell] = static_cast<std::int32_t>(beat_);
    run_ = step.is_joined ? 1 : run_ + 1;
    ++beat_;
}

// Beats since a cell was danced, or one beside it in its take. Its mirror image looks different.
std::int64_t CellChooser::beats_since(const Future& future,
                                      const CellStep& step,
                                      const CellGraph& graph) const noexcept {
    const std::size_t cell = step.cell;
    const bool has_before = step.is_joined && cell > 0 && graph.has_successor(cell - 1);
    const bool has_after = step.is_joined && graph.has_successor(cell);
    const std::size_t first = has_before ? cell - 1 : cell;
    const std::size_t last = has_after ? cell + 1 : cell;
    std::array<std::int64_t, 2> latest{kNever, kNever};  // as it is, mirrored
    for (std::size_t side = 0; side < latest.size(); ++side) {
        for (std::size_t i = first; i <= last; ++i) {
            latest[side] = std::max<std::int64_t>(latest[side], last_danced_[side][i]);
        }
    }
    for (int i = 0; i < future.beats; ++i) {
        const CellStep& own = future.steps[static_cast<std::size_t>(i)];
        if (own.cell >= first && own.cell <= last) {
            latest[own.is_mirrored ? 1 : 0] = beat_ + i;
        }
    }
    const std::int64_t now = beat_ + future.beats;
    const std::size_t side = step.is_mirrored ? 1 : 0;
    return std::min(now - latest[side], kMirroredLater * (now - latest[1 - side]));
}

namespace {

double weight_of_age(std::int64_t beats) noexcept {
    const double novel = CellChooser::kNovel;
    const auto age = static_cast<double>(beats);
    return age < novel ? kRepeatWeight * age / novel : age < kForgotten ? age / kForgotten : 1.0;
}

double weight_of_energy(double share, double wanted) noexcept {
    const double off = (share - wanted) / kEnergySpread;
    return std::exp(-0.5 * off * off);
}

// A cell of this take that begins the other half of the bar, along an arc where there is one. `at`:
// a draw, [0, 1).
std::optional<CellStep> step_in_take(const CellGraph& graph,
                                     const CellStep& from,
                                     std::uint16_t take,
                                     double at) noexcept {
    for (const CellArc& arc : graph.arcs_of(from.cell)) {
        if (graph.cells[arc.to].take == take) {
            return CellStep{arc.to, arc.is_mirrored != from.is_mirrored, true};
        }
    }
    const bool is_second = !graph.cells[from.cell].is_second_half;
    const auto fits = [&](const Cell& cell) {
        return cell.take == take && cell.is_second_half == is_second;
    };
    const auto count = std::count_if(graph.cells.begin(), graph.cells.end(), fits);
    auto left = static_cast<std::ptrdiff_t>(at * static_cast<double>(count));
    for (std::size_t i = 0; i < graph.cells.size(); ++i) {
        if (fits(graph.cells[i]) && left-- == 0) {
            return CellStep{static_cast<std::uint16_t>(i), from.is_mirrored, true};
        }
    }
    return std::nullopt;
}

double weight_of_arc(const CellArc& arc) noexcept {
    const double off = static_cast<double>(arc.distance) / kArcSoftness;
    return std::exp(-off * off);
}

}  // namespace

// A step that is asked for, of a row or of a take; nothing: it is drawn freely.
std::optional<CellStep> CellChooser::asked_step(const CellGraph& graph,
                                                const Future& future,
                                                const CellWish& wish,
                                                std::uint64_t draw) const noexcept {
    const CounterRandom random(seed_, kStream + 2);
    if (wish.take && future.beats == 0) {
        return step_in_take(graph, future.last, *wish.take, random.uniform(draw));
    }
    const auto& row = wish.beats[static_cast<std::size_t>(future.beats)].is;
    if (!row || glm::length(future.place.offset) > wish.room + kRowBeyond) {
        return std::nullopt;
    }
    if (is_successor(graph, future.last, *row)) {
        return CellStep{row->cell, row->is_mirrored, false};
    }
    if (arc_between(graph, future.last, *row) != nullptr || random.uniform(draw) < kJumpsIntoRow) {
        return CellStep{row->cell, row->is_mirrored, true};
    }
    return std::nullopt;
}

// One draw among the natural successor and the arcs; nothing: there are neither.
std::optional<CellStep> CellChooser::drawn_step(const CellGraph& graph,
                                                const Future& future,
                                                const CellWish& wish,
                                                std::uint64_t draw) const noexcept {
    if (const auto asked = asked_step(graph, future, wish, draw)) {
        return asked;
    }
    const CellBeatWish& beat = wish.beats[static_cast<std::size_t>(future.beats)];
    const std::size_t from = future.last.cell;
    const auto suits = [&](const CellStep& step) {
        return weight_of_age(beats_since(future, step, graph)) *
               weight_of_energy(energy_share(graph, step.cell), beat.energy) *
               (beat.rests_at_end ? std::exp(-kRestSoftness * unrest(graph, step.cell)) : 1.0);
    };
    const auto along = [&](const CellArc& arc) {
        return CellStep{arc.to, arc.is_mirrored != future.last.is_mirrored, true};
    };
    const CellStep natural{static_cast<std::uint16_t>(from + 1), future.last.is_mirrored, false};
    const auto arcs = graph.arcs_of(from);
    std::array<double, 65> weights{};  // of the arcs, and of the successor behind them
    const std::size_t count = std::min(arcs.size(), weights.size() - 1);
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        weights[i] = weight_of_arc(arcs[i]) * suits(along(arcs[i]));
        sum += weights[i];
    }
    const bool may_go_on =
        graph.has_successor(from) && (count == 0 || (future.run < kLongestRun && !beat.is_another));
    if (may_go_on) {
        weights[count] = (future.run < kShortRun ? kGoOnEarly : kGoOnLater) * suits(natural);
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
    return chosen == count ? natural : along(arcs[chosen]);
}

// What a step costs for what the music and the user want of its beat.
double CellChooser::cost_of(const CellGraph& graph,
                            const CellStep& step,
                            const CellBeatWish& wish) const noexcept {
    if (wish.is) {
        return is_same_cell(step, *wish.is) ? 0.0 : kOffRow;
    }
    const double off = std::abs(energy_share(graph, step.cell) - wish.energy);
    double cost = kEnergyCost * std::max(0.0, off - kNearShare);
    cost += wish.is_greatest && !is_greatest(graph, step.cell) ? kGreatestCost : 0.0;
    cost += wish.rests_at_end ? kRestCost * std::min(1.0, unrest(graph, step.cell)) : 0.0;
    cost += wish.is_another && !step.is_joined ? kNaturalCost : 0.0;
    return cost;
}

// Adds a step and what it costs.
void CellChooser::take(const CellGraph& graph,
                       const CellStep& step,
                       const CellWish& wish,
                       Future& future) const noexcept {
    const Cell& cell = graph.cells[step.cell];
    const CellBeatWish& beat = wish.beats[static_cast<std::size_t>(future.beats)];
    const bool is_of_row = beat.is && is_same_cell(step, *beat.is);
    if (step.is_joined) {
        const CellArc* const arc = arc_between(graph, future.last, step);
        const double apart =
            arc != nullptr ? static_cast<double>(arc->distance) / kJoinDistance : 0.0;
        future.cost += arc != nullptr ? kJoinCost + apart * apart : kFarJoin;
    }
    if (!is_of_row) {
        const auto age = static_cast<double>(beats_since(future, step, graph));
        future.cost += kRepeatCost * std::max(0.0, 1.0 - age / kForgotten);
    }
    const double side = step.is_mirrored ? -1.0 : 1.0;
    future.place = future.place * FloorMove{side * static_cast<double>(cell.turn),
                                            {side * static_cast<double>(cell.way.x),
                                             static_cast<double>(cell.way.y)}};
    const double beyond = std::max(0.0, glm::length(future.place.offset) - wish.room) / wish.room;
    future.cost += kStageCost * beyond * beyond;
    future.cost += wish.faces_us ? kTurnedCost * (1.0 - std::cos(future.place.heading)) : 0.0;
    future.cost += cost_of(graph, step, beat);
    future.run = step.is_joined ? 1 : future.run + 1;
    future.last = step;
    future.steps[static_cast<std::size_t>(future.beats)] = step;
    ++future.beats;
}

// What the last decision would have gone on with, as long as it is not asked for something else.
std::optional<CellStep> CellChooser::kept_step(const Future& future,
                                               const CellWish& wish) const noexcept {
    if (drawn_ != 0 || future.beats >= kept_beats_ || wish.take) {
        return std::nullopt;
    }
    for (int i = 0; i <= future.beats; ++i) {
        const auto beat = static_cast<std::size_t>(i);
        const CellBeatWish& wanted = wish.beats[beat];
        const bool is_other = wanted.is && !is_same_cell(*wanted.is, kept_[beat]);
        if (is_other || (wanted.is_another && !kept_[beat].is_joined)) {
            return std::nullopt;
        }
    }
    return kept_[static_cast<std::size_t>(future.beats)];
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
        auto step = kept_step(future, wish);
        if (!step) {
            step =
                drawn_step(graph, future, wish, first + static_cast<std::uint64_t>(future.beats));
        }
        if (!step) {
            break;
        }
        take(graph, *step, wish, future);
    }
    if (drawn_ == 0 || future.cost < best_cost_) {
        best_cost_ = future.cost;
        best_ = future.steps;
        best_beats_ = future.beats;
    }
    ++drawn_;
}

std::array<CellStep, CellChooser::kFollowed> CellChooser::decide() noexcept RAKS_NONBLOCKING {
    std::array<CellStep, kFollowed> followed{};
    std::copy_n(best_.begin(), kFollowed, followed.begin());
    for (const CellStep& step : followed) {
        note(step);
    }
    drawn_ = 0;
    kept_beats_ = std::max(0, best_beats_ - kFollowed);
    std::copy(best_.begin() + kFollowed, best_.end(), kept_.begin());
    return followed;
}

}  // namespace raks::motion
