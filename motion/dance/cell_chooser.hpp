#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/realtime.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/dance/body/floor_move.hpp"

namespace raks::motion {

/// One beat of a dance of cells.
struct CellStep {
    std::uint16_t cell = 0;    ///< index in CellGraph::cells
    bool is_mirrored = false;  ///< danced left for right
    bool is_joined = false;    ///< by an arc; false: it follows the cell before it in its take
};

/// What the next beats shall be like.
struct CellWish {
    double energy = 0.5;      ///< of the music, [0, 1]
    bool is_another = false;  ///< the next cell is not the natural one
    bool faces_us = true;     ///< for an audience ahead
};

/// Chooses the cells of a dance. Futures of kLook beats are drawn along the arcs, near ones more
/// often, and the one that keeps to the stage and to the front, gives what the music gives, joins
/// softly and repeats least is followed for kFollowed beats. What was danced in the last kNovel
/// beats, its neighbours in the take and their mirror images are hardly danced again.
///
/// The draws depend on the seed and on what was asked alone. Threads: one. Real-time: yes; each
/// call of draw() costs one future.
class CellChooser {
 public:
    static constexpr int kLook = 8;      ///< beats of a future
    static constexpr int kFollowed = 2;  ///< beats of the best one that are danced
    static constexpr int kNovel = 64;    ///< beats
    static constexpr int kFutures = 24;  ///< that are drawn for one decision

    /// Begins anew. Returns the first cell: one of middling energy that goes on for a while.
    CellStep start(const CellGraph& graph, std::uint64_t seed) noexcept RAKS_NONBLOCKING;

    /// Draws one more future that begins behind `last`, whose end lies at `place` on the stage
    /// (its middle is 0, 0; heading 0 faces the audience); nothing after kFutures.
    void draw(const CellGraph& graph,
              const CellStep& last,
              const FloorMove& place,
              const CellWish& wish) noexcept RAKS_NONBLOCKING;
    /// Whether draw() has work left for this decision.
    [[nodiscard]] bool is_drawn() const noexcept { return drawn_ >= kFutures; }
    /// The first kFollowed beats of the best future, and the next decision begins. At least one
    /// future must have been drawn.
    [[nodiscard]] std::array<CellStep, kFollowed> decide() noexcept RAKS_NONBLOCKING;

 private:
    struct Future;
    [[nodiscard]] std::optional<CellStep> drawn_step(const CellGraph& graph,
                                                     const Future& future,
                                                     const CellWish& wish,
                                                     std::uint64_t draw) const noexcept;
    [[nodiscard]] std::int64_t beats_since(const Future& future,
                                           std::size_t cell,
                                           const CellGraph& graph,
                                           bool with_neighbours) const noexcept;
    void take(const CellGraph& graph,
              const CellStep& step,
              const CellWish& wish,
              Future& future) const noexcept;
    void note(const CellStep& step) noexcept;

    std::uint64_t seed_ = 1;
    std::int64_t beat_ = 0;  // of the next cell that is decided
    int run_ = 1;            // cells since the last join
    int drawn_ = 0;
    double best_cost_ = 0.0;
    std::array<CellStep, kFollowed> best_{};
    std::array<std::int32_t, kMostCells> last_danced_{};  // beat; negative: never
};

/// Energy of a cell that suits music of this energy, [0, 1]: so much of the dance is calmer.
/// Threads: any. Real-time: yes.
[[nodiscard]] double cell_energy(const CellGraph& graph, double energy) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
