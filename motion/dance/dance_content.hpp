#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/beats.hpp"
#include "base/expected.hpp"
#include "motion/dance/baking/arm_mixes.hpp"
#include "motion/dance/baking/figure_passage.hpp"
#include "motion/dance/baking/figure_size.hpp"
#include "motion/dance/beat_phase.hpp"
#include "motion/dance/figure_chooser.hpp"
#include "motion/dance/generator.hpp"

namespace raks::motion {

/// One figure in all the ways in which it can be danced.
struct LibraryFigure {
    std::string name;
    int beats = 8;
    FloorMove move;  ///< from its start to its end
    /// From its frame to the dance's: so that the feet are where they were when it begins. (A frame
    /// is that of the hips on count 1, which may be turned or aside.)
    FloorMove place;
    bool turns_half = false;
    std::array<std::vector<double>, 2> fist;  ///< as FigureModel has it
    Nanos landing_delay{};  ///< of its steps at its learnt tempo; landing_delay.hpp
    std::vector<FigurePassage> passages;
    ArmMixes arms_mix{};
    Bpm learnt_tempo{120.0};
    SizeByTempo size_by_tempo;
    FigureMiddle middle;
};

/// What the dancer reads of a library.
struct DanceContent {
    /// Ways to dance each figure: two repeats then share legs and torso one time in eight, and
    /// never the arms, which are mixed from two of them.
    static constexpr int kPassages = static_cast<int>(kWays);

    Generator generator = Generator::trajectories;
    std::vector<LibraryFigure> figures;
    FigureChooser chooser;
    DanceMetre metre;  ///< its tempo: the mean of the figures'
    FloorMove couple;  ///< the same, for one of a couple about the stage's centre
    FloorMove stage;   ///< from the frame in which a figure starts: it faces the audience, centred
    Pose rest;         ///< what no passage sets: softly bent fingers
    Skeleton skeleton;
};

/// Errors: as DanceLibrary::build says. Threads: workers; two of its own. Real-time: no.
[[nodiscard]] Expected<DanceContent> make_content(std::span<const FigureModel> figures,
                                                  const Skeleton& skeleton,
                                                  const FigureGrammar* grammar,
                                                  Generator generator = Generator::trajectories);

/// How one figure is danced this time.
struct FigureChoice {
    std::size_t figure = 0;
    std::size_t body = 0;               ///< passage of legs and torso
    std::array<std::size_t, 2> arms{};  ///< passages that the arms are mixed from
    float arms_share = 0.0F;            ///< of the second
    FigureSize size;
};

/// The ways of number `number`, as large as learnt. Threads: any. Real-time: yes.
[[nodiscard]] FigureChoice choose_ways(std::size_t figure,
                                       std::uint64_t seed,
                                       std::uint64_t number) noexcept;

/// The pose at a beat of a figure so danced, in the frame of its start.
/// Threads: any. Real-time: yes.
[[nodiscard]] Pose pose_of(const DanceContent& content,
                           const FigureChoice& choice,
                           double beat) noexcept;

}  // namespace raks::motion
