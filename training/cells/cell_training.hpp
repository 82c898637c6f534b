#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/cells/cell_arcs.hpp"
#include "training/cells/cell_cutting.hpp"
#include "training/cells/cell_repeats.hpp"
#include "training/figures/figure_trainer.hpp"
#include "training/figures/training_clip.hpp"

/// From takes whose beats are labelled to a dance of cells: the work of `raks train take`.
namespace raks::motion {

/// Which takes, which beats and how they are joined.
struct CellTrainingPlan {
    std::vector<std::filesystem::path> clips;  ///< or one folder: all clips in it
    std::vector<TakeBeat> beats;               ///< of takes, which are the clips' names
    std::vector<std::string> without;          ///< takes of the table that are left out
    std::string dance;                         ///< name of the dance
    std::string licence;                       ///< of the takes, and who made them
    ClipUnits units;                           ///< of the clips
    ArcOptions arcs;                           ///< how cells are joined
    TieOptions ties;                           ///< what is learnt as repeats
    bool lays_arms = false;                    ///< lay_arms() in place of BeatFate::home
    int threads = 1;  ///< takes at once, each 5 kB a frame; the result is the same for any number
};

/// What became of one take.
struct TakeUse {
    std::string take;                           ///< the clip's name
    std::array<std::size_t, kBeatFates> beats;  ///< of the table, by BeatFate
    std::size_t laid = 0;                       ///< beats that were given other arms: lay_arms()

    /// Beats that met this fate.
    [[nodiscard]] std::size_t count(BeatFate fate) const noexcept {
        return beats[static_cast<std::size_t>(fate)];
    }
    /// Beats of the table.
    [[nodiscard]] std::size_t labelled() const noexcept;
};

/// The dance and what it was learnt from.
struct CellTrainingReport {
    CellDance dance;                    ///< passes validate()
    std::vector<TakeUse> takes;         ///< in the order of the table
    bool has_rests = false;             ///< ReachedCells
    bool has_endings = false;           ///< see above
    std::size_t wide_joins = 0;         ///< JoinedCells
    std::size_t landings = 0;           ///< of the cells that were cut
    std::size_t far_landings = 0;       ///< of these: further than kFarLanding from a beat
    std::size_t tied_cells = 0;         ///< cells that repeat others
    std::size_t figures = 0;            ///< how many cells these would be, each counted once
    std::size_t tied_states = 0;        ///< tie_states()
    double people_jerk_rms = 0.0;       ///< of what is danced, m/s^3: jerk_samples(); 0: not known
    double people_jerk_p999 = 0.0;      ///< its 99.9th percentile
    std::vector<std::string> warnings;  ///< for people, one line each
};

/// Reads the clips that the table needs, cuts them at their beats, leaves out what is no dance,
/// learns each stretch as a chain of states, ties what repeats and joins the cells. Deterministic:
/// the same files and plan give the same bits. Errors: of the readers; a take that is not among the
/// clips; `without` a take that the table has not; beats beyond the end of their clip; more beats
/// than a dance holds; no beat that may be danced, or none that leads back to another.
/// Threads: workers. Real-time: no (a second for half a minute of dancing).
[[nodiscard]] Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan);

/// The same of clips that are there; `plan.clips` and `plan.units` are not read.
[[nodiscard]] Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan,
                                                       std::span<const TrainingClip> clips);

}  // namespace raks::motion
