#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "base/realtime.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/dancer_part.hpp"

namespace raks::motion {

/// One beat of a dance of cells.
struct CellStep {
    std::uint16_t cell = 0;    ///< index in CellGraph::cells
    bool is_mirrored = false;  ///< danced left for right
    bool is_joined = false;    ///< by an arc; false: it follows the cell before it in its take
};

/// Whether both dance the same cell on the same side.
[[nodiscard]] constexpr bool is_same_cell(const CellStep& a, const CellStep& b) noexcept {
    return a.cell == b.cell && a.is_mirrored == b.is_mirrored;
}

/// Beats that are looked ahead when cells are chosen.
inline constexpr int kCellLook = 8;

/// What one of the next beats shall be like.
struct CellBeatWish {
    double energy = 0.5;         ///< share of the dance's cells that are calmer, [0, 1]
    bool rests_at_end = false;   ///< the cell ends at rest
    bool is_another = false;     ///< the cell is not the natural one
    bool is_greatest = false;    ///< the cell is one of the greatest
    std::optional<CellStep> is;  ///< this cell: it belongs to a row that is danced again
};

/// What the next beats shall be like.
struct CellWish {
    std::array<CellBeatWish, kCellLook> beats{};  ///< from the next one that is not decided
    std::optional<std::uint16_t> take;            ///< the next cell is of this take
    bool faces_us = true;                         ///< for an audience ahead
    double room = DancerPart().room;              ///< about the middle of the stage, metres
};

/// Chooses the cells of a dance. Futures of kLook beats are drawn along the arcs, near ones more
/// often, and the one that keeps to the stage and to the front, gives what the music gives, joins
/// softly and repeats least is followed for kFollowed beats; what is left of it is the first future
/// of the next decision. What was danced in the last kNovel beats and its neighbours in the take
/// are hardly danced again, and later the less often the sooner; their mirror images may come
/// earlier. A row that is asked for may come at any time.
///
/// The draws depend on the seed and on what was asked alone. Threads: one. Real-time: yes; each
/// call of draw() costs one future.
class CellChooser {
 public:
    static constexpr int kLook = kCellLook;  ///< beats of a future
    static constexpr int kFollowed = 2;      ///< beats of the best one that are danced
    static constexpr int kNovel = 64;        ///< beats
    static constexpr int kFutures = 24;      ///< that are drawn for one decision

    /// Begins anew. Returns the first cell: one of middling energy that begins a half of the bar
    /// and goes on for a while. In the same dance what was danced before is still remembered, so
    /// that one who begins again does not dance the same again.
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
    /// What was drawn began behind another cell than the one that is danced now.
    void forget_futures() noexcept;
    /// The same dance, solved for another body.
    void go_on_in(const CellGraph& graph) noexcept { graph_ = &graph; }

 private:
    struct Future;
    [[nodiscard]] std::optional<CellStep> drawn_step(const CellGraph& graph,
                                                     const Future& future,
                                                     const CellWish& wish,
                                                     std::uint64_t draw) const noexcept;
    [[nodiscard]] std::optional<CellStep> asked_step(const CellGraph& graph,
                                                     const Future& future,
                                                     const CellWish& wish,
                                                     std::uint64_t draw) const noexcept;
    [[nodiscard]] std::optional<CellStep> kept_step(const Future& future,
                                                    const CellWish& wish) const noexcept;
    [[nodiscard]] double cost_of(const CellGraph& graph,
                                 const CellStep& step,
                                 const CellBeatWish& wish) const noexcept;
    [[nodiscard]] std::int64_t beats_since(const Future& future,
                                           const CellStep& step,
                                           const CellGraph& graph) const noexcept;
    void take(const CellGraph& graph,
              const CellStep& step,
              const CellWish& wish,
              Future& future) const noexcept;
    void note(const CellStep& step) noexcept;

    const CellGraph* graph_ = nullptr;  // of what is remembered
    std::uint64_t seed_ = 1;
    std::int64_t beat_ = 0;  // of the next cell that is decided
    int run_ = 1;            // cells since the last join
    int drawn_ = 0;
    double best_cost_ = 0.0;
    std::array<CellStep, kLook> best_{};
    int best_beats_ = 0;
    std::array<CellStep, kLook> kept_{};  // of the last decision, beyond what was followed
    int kept_beats_ = 0;
    // By side, as it is and mirrored, and cell: the beat; negative: never.
    std::array<std::array<std::int32_t, kMostCells>, 2> last_danced_{};
};

/// Share of the dance's cells that are calmer than a cell, [0, 1]. Threads: any. Real-time: yes.
[[nodiscard]] double energy_share(const CellGraph& graph,
                                  std::size_t cell) noexcept RAKS_NONBLOCKING;

/// Whether a cell may follow another one: as the next beat of its take or along an arc.
/// Threads: any. Real-time: yes.
[[nodiscard]] bool may_follow(const CellGraph& graph,
                              const CellStep& from,
                              const CellStep& to) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
