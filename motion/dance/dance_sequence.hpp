// Dance sequence: a dance over one continuous phase, of figures or of cells.
#pragma once

#include "motion/dance/cell_sequence.hpp"
#include "motion/dance/figure_sequence.hpp"

namespace raks::motion {

/// One dance as it goes on: figures (FigureSequence) or cells of takes (CellSequence), as its
/// content has it. What both have is said there. Threads: one. Real-time: yes.
class DanceSequence {
 public:
    /// Begins at phase 0.
    void start(const DanceContent& content,
               const FloorMove& stage,
               const DancerPart& part,
               bool stands_turned) noexcept RAKS_NONBLOCKING {
        is_of_cells_ = content.cells != nullptr;
        is_of_cells_ ? cells_.start(content, stage, part)
                     : figures_.start(content, stage, part, stands_turned);
    }
    /// The tempo for figures chosen from here on.
    void set_tempo(Bpm tempo) noexcept { figures_.set_tempo(tempo); }
    /// Whether it is a dance of cells.
    [[nodiscard]] bool is_of_cells() const noexcept { return is_of_cells_; }
    /// A dance of figures to a phase; decides what comes next. `energy`: of the music, [0, 1].
    void advance(Beats phase, double energy, FigureWish& wish) noexcept RAKS_NONBLOCKING {
        figures_.advance(phase, energy, wish);
    }
    /// The same of a dance of cells.
    void advance(Beats phase, const CellMusic& music, FigureWish& wish) noexcept RAKS_NONBLOCKING {
        cells_.advance(phase, music, wish);
    }
    /// The phase was re-anchored.
    void jump(Beats phase) noexcept RAKS_NONBLOCKING {
        is_of_cells_ ? cells_.jump(phase) : figures_.jump(phase);
    }
    /// The dance has stood still as at the phase `key` and is shown again from `phase` on. Figures
    /// have gone on unseen; cells go on from where they stood.
    void go_on_from(Beats key, Beats phase) noexcept RAKS_NONBLOCKING {
        if (is_of_cells_) {
            cells_.go_on_from(key, phase);
        }
    }
    /// Whether the dance comes to rest at a phase: in a dance of cells, where the cell before ends
    /// so.
    [[nodiscard]] bool rests_at(Beats phase) const noexcept RAKS_NONBLOCKING {
        return is_of_cells_ && cells_.rests_at(phase);
    }
    /// Goes on in the same dance, solved for another body.
    void go_on_in(const DanceContent& content, const FloorMove& stage) noexcept {
        is_of_cells_ ? cells_.go_on_in(content, stage) : figures_.go_on_in(content, stage);
    }
    /// The pose in the world at a phase up to kDecided after the last advance. Steps of cells are
    /// as in the takes, whatever the manner.
    [[nodiscard]] Pose at(Beats phase, const Manner& manner = {}) const noexcept RAKS_NONBLOCKING {
        return is_of_cells_ ? cells_.at(phase, manner) : figures_.at(phase, manner);
    }
    /// The present figure or take.
    [[nodiscard]] const LibraryFigure& figure() const noexcept {
        return is_of_cells_ ? cells_.figure() : figures_.figure();
    }
    /// Beats since its count 1.
    [[nodiscard]] double beat(Beats phase) const noexcept {
        return is_of_cells_ ? cells_.beat(phase) : figures_.beat(phase);
    }
    /// Beats of the phase for each of the figure.
    [[nodiscard]] double stretch() const noexcept {
        return is_of_cells_ ? 1.0 : figures_.stretch();
    }
    /// The phase at which the present figure, or the bar, ends.
    [[nodiscard]] Beats end() const noexcept {
        return is_of_cells_ ? cells_.end() : figures_.end();
    }
    /// Whether it is danced left for right.
    [[nodiscard]] bool is_mirrored() const noexcept {
        return is_of_cells_ ? cells_.is_mirrored() : figures_.is_mirrored();
    }
    /// Whether it began half a turn away from the first.
    [[nodiscard]] bool is_turned() const noexcept { return !is_of_cells_ && figures_.is_turned(); }
    /// How many figures or pieces of takes were begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept {
        return is_of_cells_ ? cells_.number() : figures_.number();
    }

 private:
    bool is_of_cells_ = false;
    FigureSequence figures_;
    CellSequence cells_;
};

}  // namespace raks::motion
