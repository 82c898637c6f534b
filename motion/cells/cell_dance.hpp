#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/figures/figure_model.hpp"

#include <glm/vec2.hpp>

/// A dance of cells: whole takes of people, cut at their beats. A cell is one beat of a take; an
/// arc leads from the end of a cell to the start of another one at which body and speed agree. A
/// walk along arcs is a dance that nobody has danced, of moments that somebody has.
namespace raks::motion {

/// Most cells of a dance: for each the dancer remembers when it was danced last.
inline constexpr std::size_t kMostCells = 2048;
/// Most beats of all takes of a dance together, those that no cell has among them.
inline constexpr int kMostTakeBeats = 4096;

/// One beat of a take. Its mirror image is a cell, too, and is not listed.
struct Cell {
    std::uint16_t take = 0;  ///< index in CellGraph::takes
    std::uint16_t beat = 0;  ///< it lasts from this beat of the take to the next one
    /// Mean speed of the joints about the hips where the beat lasts as long as the dance's; m/s.
    float energy = 0.0F;
    float turn = 0.0F;  ///< of the hips over the cell, radians; positive to the left
    glm::vec2 way{};    ///< of the hips, left and forward of where it starts; metres
    /// Of the joints about the hips as it ends, mean over an eighth of a second; metres a second
    float speed_at_end = 0.0F;
    /// By Side: when the foot lands next to the cell's first beat, in beats from it; [-0.5, 0.5).
    std::array<float, 2> landings{kNoLanding, kNoLanding};
    bool is_second_half = false;  ///< of the bar
    bool stands_at_end = false;   ///< on both feet

    /// Of a foot that does not land.
    static constexpr float kNoLanding = 2.0F;
};

/// A change from one cell to another. Between their mirror images it holds as well.
struct CellArc {
    std::uint16_t to = 0;      ///< index in CellGraph::cells
    bool is_mirrored = false;  ///< to the mirror image, or from it to the cell as it is
    float distance = 0.0F;     ///< of the two moments (training/cells/take_moments.hpp)
};

/// A stretch of a take between beats that were labelled.
struct CellTake {
    std::string name;  ///< the clip's, with the first second where a clip has several
    int beats = 0;     ///< of the stretch; cells need not use the outer ones
};

/// The cells of a dance and how they follow one another. Immutable once made.
struct CellGraph {
    std::vector<CellTake> takes;           ///< in the order of the models
    std::vector<Cell> cells;               ///< by take and beat; each can be left and reached
    std::vector<std::uint32_t> first_arc;  ///< by cell, and one more: its arcs in `arcs`
    std::vector<CellArc> arcs;             ///< by cell, the natural successor not among them
    double beat_seconds = 0.5;             ///< mean length of a beat in the takes
    std::array<float, 21>
        energies{};  ///< of the cells: quantiles 0, .05, .. 1; see sort_energies()

    /// The arcs that leave a cell.
    [[nodiscard]] std::span<const CellArc> arcs_of(std::size_t cell) const noexcept {
        return std::span(arcs).subspan(first_arc[cell], first_arc[cell + 1] - first_arc[cell]);
    }
    /// Whether `cell + 1` is the next beat of the same take.
    [[nodiscard]] bool has_successor(std::size_t cell) const noexcept {
        return cell + 1 < cells.size() && cells[cell + 1].take == cells[cell].take &&
               cells[cell + 1].beat == cells[cell].beat + 1;
    }
};

/// A dance of cells as learnt: what `raks train take` writes and the dancer dances.
struct CellDance {
    std::string dance;               ///< name of the dance
    std::string licence;             ///< of the takes, and who made them, for people
    std::vector<FigureModel> takes;  ///< one a stretch, a figure of so many beats
    CellGraph graph;                 ///< of the same takes
};

/// Gives the takes the landings of their cells after which the foot stands, as figures have theirs:
/// contacts begin there, and a dance is judged by them. Threads: any. Real-time: no.
void give_landings(CellDance& dance);

/// Beats from a beat beyond which a landing is not on it.
inline constexpr double kFarLanding = 0.15;
/// States a beat of a take.
inline constexpr int kStatesPerBeat = 8;
/// Samples a beat of a take's phase.
inline constexpr int kCellSamples = 24;
/// Contact bins a beat of a take (FigureModel::contact).
inline constexpr int kContactBinsPerBeat = 24;

// What a cell is good for. Training keeps a cell only where each kind that the dance has is reached
// from it within kBeatsToKind beats. Each function costs nothing and may be called on any thread.

/// Beats within which every cell reaches a rest, an ending and one of the greatest cells.
inline constexpr int kBeatsToKind = 8;
/// Metres a second under which a body on both feet is at rest.
inline constexpr float kRestSpeed = 0.25F;
/// Index in CellGraph::energies from which on cells are the greatest: the top tenth.
inline constexpr std::size_t kGreatestQuantile = 18;

/// Whether the dance may hold at the end of a cell: it comes to rest there on both feet.
[[nodiscard]] inline bool is_rest(const CellGraph& graph, std::size_t cell) noexcept {
    return graph.cells[cell].stands_at_end && graph.cells[cell].speed_at_end < kRestSpeed;
}
/// Whether the dance may end with a cell: it comes to rest as the next half of a bar would begin
/// with its first beat. A dance that has none ends at any rest.
[[nodiscard]] inline bool is_ending(const CellGraph& graph, std::size_t cell) noexcept {
    return is_rest(graph, cell) && graph.cells[cell].is_second_half;
}
/// Whether a cell is one of those with the most energy; sort_energies() must have been called.
[[nodiscard]] inline bool is_greatest(const CellGraph& graph, std::size_t cell) noexcept {
    return graph.cells[cell].energy >= graph.energies[kGreatestQuantile];
}

/// Sets the graph's quantiles of energy from its cells, of which there is at least one.
void sort_energies(CellGraph& graph);

/// Checks everything that the dancer relies on. The error names the first fault. Threads: any.
/// Real-time: no.
[[nodiscard]] Expected<void> validate(const CellGraph& graph);

}  // namespace raks::motion
