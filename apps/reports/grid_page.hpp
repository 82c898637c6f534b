// Grid page: what is proposed of the beats of takes, to be looked at.
#pragma once

#include <string>
#include <string_view>

#include "training/cells/grid_cues.hpp"
#include "training/cells/grid_proposal.hpp"
#include "training/figures/figure_trainer.hpp"

namespace raks::apps {

/// A take and the grid that is proposed for it.
struct ProposedTake {
    motion::TrainingClip clip;
    motion::GridCues cues;
    motion::GridProposal proposal;
    std::string song;  ///< that the grid is of, and where it lies; empty: of motion alone
};

/// The part of the page that is about one take: the take over time with landings, the feet's speed
/// and its beats, then eight beats a row, the body on every beat and half beat (at most 60 rows).
/// The same data give the same bytes. Threads: any. Real-time: no.
[[nodiscard]] std::string draw_grid(const ProposedTake& take);

/// One self-contained HTML page of these parts.
[[nodiscard]] std::string grid_page(std::string_view parts);

}  // namespace raks::apps
