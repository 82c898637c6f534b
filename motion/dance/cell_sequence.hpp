#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/beats.hpp"
#include "base/realtime.hpp"
#include "motion/dance/cell_chooser.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dance/dancer_part.hpp"

namespace raks::motion {

/// A dance of cells over one continuous phase: pieces of takes, each danced for some beats and
/// joined to the next one on a beat. Around a join both pieces are danced and averaged (Ofli 2008,
/// section 5); the next one is laid so that feet that stand in both do not move. It does for cells
/// what FigureSequence does for figures.
/// Threads: one. Real-time: yes.
class CellSequence {
 public:
    /// Beats ahead that are decided, at least.
    static constexpr double kDecided = 1.0;

    /// Begins with a first cell at phase 0, facing the audience at `stage`.
    void start(const DanceContent& content,
               const FloorMove& stage,
               const DancerPart& part) noexcept RAKS_NONBLOCKING;
    /// Advances to a phase: thinks a little about what comes next, and decides when it is due.
    /// `energy`: of the music, [0, 1]. `wish`: cleared as far as it was granted.
    void advance(Beats phase, double energy, FigureWish& wish) noexcept RAKS_NONBLOCKING;
    /// The phase was re-anchored: goes on in the same cell, at its part of the beat.
    void jump(Beats phase) noexcept RAKS_NONBLOCKING;
    /// Goes on with the same takes, solved for another body.
    void go_on_in(const DanceContent& content, const FloorMove& stage) noexcept;
    /// The pose in the world at a phase up to kDecided after the last advance; later the present
    /// take goes on.
    [[nodiscard]] Pose at(Beats phase) const noexcept RAKS_NONBLOCKING;

    /// The take that is danced, as a figure.
    [[nodiscard]] const LibraryFigure& figure() const noexcept;
    /// Beats of the take at a phase.
    [[nodiscard]] double beat(Beats phase) const noexcept;
    /// The phase at which the present bar ends.
    [[nodiscard]] Beats end() const noexcept;
    /// Whether the present piece is danced left for right.
    [[nodiscard]] bool is_mirrored() const noexcept { return present().is_mirrored; }
    /// How many pieces were begun before this one.
    [[nodiscard]] std::uint64_t number() const noexcept { return number_; }

 private:
    /// Some beats of one take.
    struct Piece {
        std::uint16_t first_cell = 0;
        bool is_mirrored = false;
        double from = 0.0;                              // phase at which it begins
        double until = 0.0;                             // phase up to which it is decided
        FloorMove floor{};                              // from the take's frame to the world
        std::array<std::array<double, 2>, 2> swings{};  // by Side: when it goes over, after `from`
        std::array<bool, 2> is_lifted{};                // by Side: by a step of its own
    };
    [[nodiscard]] const Piece& present() const noexcept { return pieces_[present_]; }
    [[nodiscard]] Pose pose_of(const Piece& piece, double phase) const noexcept;
    [[nodiscard]] Pose joined(const Piece& before, const Piece& after, double phase) const noexcept;
    void append(const CellStep& step) noexcept;
    void lay(const Piece& before, Piece& after) const noexcept;
    [[nodiscard]] FloorMove end_on_stage() const noexcept;

    static constexpr std::size_t kMostPieces = 6;

    const DanceContent* content_ = nullptr;
    FloorMove stage_;
    CellChooser chooser_;
    CellStep last_;  // that was decided
    std::array<Piece, kMostPieces> pieces_{};
    std::size_t count_ = 0;
    std::size_t present_ = 0;
    double phase_ = 0.0;
    bool faces_us_ = true;
    std::uint64_t number_ = 0;
};

}  // namespace raks::motion
