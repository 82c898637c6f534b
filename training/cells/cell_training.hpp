#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "base/expected.hpp"
#include "motion/cells/cell_dance.hpp"
#include "motion/figures/label_tables.hpp"
#include "training/cells/cell_arcs.hpp"
#include "training/figures/training_clip.hpp"

/// From takes whose beats are labelled to a dance of cells: the work of `raks train take`.
namespace raks::motion {

/// Which takes, which beats and how they are joined.
struct CellTrainingPlan {
    std::vector<std::filesystem::path> clips;  ///< or one folder: all clips in it
    std::vector<TakeBeat> beats;               ///< of takes, which are the clips' names
    std::string dance;                         ///< name of the dance
    std::string licence;                       ///< of the takes, and who made them
    ClipUnits units;                           ///< of the clips
    ArcOptions arcs;                           ///< how cells are joined
};

/// What became of one take.
struct TakeUse {
    std::string take;          ///< the clip's name
    std::size_t labelled = 0;  ///< beats of it that the table has
    std::size_t cells = 0;     ///< beats that are danced
    std::size_t idle = 0;      ///< left out: hardly anything moves
    std::size_t odd = 0;       ///< left out: much shorter or longer than a beat
};

/// The dance and what it was learnt from.
struct CellTrainingReport {
    CellDance dance;                    ///< passes validate()
    std::vector<TakeUse> takes;         ///< in the order of the table
    std::size_t apart = 0;              ///< cells to or from which no way leads
    double connected = 0.0;             ///< share of the cells that stayed
    std::vector<std::string> warnings;  ///< for people, one line each
};

/// Reads the clips that the table needs, learns each stretch of labelled beats as a chain of
/// states, and joins its cells. Deterministic: the same files and plan give the same bits.
/// Errors: of the readers; a take that is not among the clips; beats beyond the end of their clip;
/// no beat that may be danced. Threads: workers. Real-time: no.
[[nodiscard]] Expected<CellTrainingReport> train_cells(const CellTrainingPlan& plan);

}  // namespace raks::motion
