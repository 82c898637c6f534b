// Dance content: all passages of a dance's figures, and how a choice of them becomes a pose.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/dance/baking/figure_size.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/cell_poses.hpp"
#include "motion/dance/dynamics/manner.hpp"
#include "motion/dance/figure_chooser.hpp"
#include "motion/dance/figure_sides.hpp"
#include "motion/dance/generator.hpp"

namespace raks::motion {

/// One figure in all the ways in which it can be danced.
struct LibraryFigure {
    std::string name;  ///< as in the grammar
    int beats = 8;     ///< length
    FloorMove move;    ///< from its start to its end
    /// From its frame to that of the dance, in which the feet of all figures begin at the same
    /// place. (A figure's frame is that of the hips on count 1, which may be turned or aside.)
    FloorMove place;
    bool turns_half = false;                  ///< ends half a turn from where it began
    std::array<std::vector<double>, 2> fist;  ///< as FigureModel has it
    Nanos landing_delay{};                  ///< of its steps at its learnt tempo; landing_delay.hpp
    std::vector<FigurePassage> passages;    ///< DanceContent::kPassages; the first as learnt
    ArmMixes arms_mix{};                    ///< which passages' arms may be mixed
    Bpm learnt_tempo{120.0};                ///< mean over its repeats
    SizeByTempo size_by_tempo;              ///< law of its size at other tempi
    FigureMiddle middle;                    ///< what its movements scale about
    std::vector<HeldHands> holds;           ///< of a couple; as the grammar says
    FigureSides sides;                      ///< how it is danced left for right
    bool can_slow = false;                  ///< also danced at half the tempo; as the grammar says
    std::optional<HandShapeWeights> hands;  ///< shapes of its hands; as the grammar says
    StillPart still = StillPart::nothing;   ///< while its hips move; as the grammar says
};

/// All that a dancer reads of a library.
struct DanceContent {
    /// Passages of each figure. Two repeats share legs and torso one time in eight, and never the
    /// arms, which are mixed from two passages.
    static constexpr int kPassages = static_cast<int>(kWays);

    Generator generator = Generator::trajectories;  ///< that made the passages
    std::vector<LibraryFigure> figures;             ///< in the order of the grammar's rules
    FigureChooser chooser;                          ///< which figure comes next
    DanceMetre metre;                               ///< its tempo: that of the figures' mean period
    FloorMove couple;   ///< like `stage`, but one of a couple dances about the stage's centre
    CoupleForm form;    ///< of a couple; as the grammar says
    SoloArms solo;      ///< of one alone; as the grammar says
    FloorMove stage;    ///< from a figure's start to the stage: centred, facing the audience
    Pose rest;          ///< what no passage sets: softly bent fingers
    Skeleton skeleton;  ///< that it was solved for
    /// Of a dance of cells, whose figures are whole takes; null: of a dance of figures.
    std::shared_ptr<const CellGraph> cells;
    std::vector<CellStands> stands;  ///< of a dance of cells, by cell; see cell_stands()
};

/// Solves all figures. Errors: as DanceLibrary::build says. Threads: workers; starts two of its
/// own. Real-time: no.
[[nodiscard]] Expected<DanceContent> make_content(std::span<const FigureModel> figures,
                                                  const Skeleton& skeleton,
                                                  const FigureGrammar* grammar,
                                                  Generator generator = Generator::trajectories);

/// Solves the takes of a dance of cells, one after the other as learnt. Errors: as make_content().
/// Threads: workers; starts two of its own. Real-time: no.
[[nodiscard]] Expected<DanceContent> make_cell_content(const CellDance& dance,
                                                       const Skeleton& skeleton);

/// Sets what the dancers of a dance of cells do beside its takes.
void take_habits(const DanceHabits& habits, DanceContent& content);

/// Sets what follows from the grammar alone: the holds of the content and of its figures, which are
/// in the order of the grammar's rules, and which figures can be danced left for right or slowly.
void take_rules(const FigureGrammar& grammar, DanceContent& content);

/// How one figure is danced this time.
struct FigureChoice {
    std::size_t figure = 0;             ///< index in DanceContent::figures
    std::size_t body = 0;               ///< passage of legs and torso
    std::array<std::size_t, 2> arms{};  ///< passages that the arms are mixed from
    float arms_share = 0.0F;            ///< of the second
    FigureSize size;                    ///< by tempo
    bool is_mirrored = false;           ///< left for right
};

/// Draws the passages of the figure that is the `number`-th of the dance; its size is as learnt.
/// Threads: any. Real-time: yes.
[[nodiscard]] FigureChoice choose_ways(std::size_t figure,
                                       std::uint64_t seed,
                                       std::uint64_t number) noexcept RAKS_NONBLOCKING;

/// The pose at a beat of a figure danced by `choice`, in the frame of its start. `manner`: of now;
/// the paper's generator knows none. A figure that comes back where it began goes on before its
/// first beat as it ends. Threads: any. Real-time: yes.
[[nodiscard]] Pose pose_of(const DanceContent& content,
                           const FigureChoice& choice,
                           double beat,
                           const Manner& manner = {}) noexcept RAKS_NONBLOCKING;

}  // namespace raks::motion
