#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/beat_grid.hpp"
#include "base/music_state.hpp"
#include "motion/dance/dance_content.hpp"
#include "motion/dancer.hpp"
#include "motion/figures/figure_grammar.hpp"
#include "motion/figures/figure_model.hpp"
#include "motion/skeleton/pose.hpp"

namespace raks::motion::test {

/// The shipped basic step of the lead.
const FigureModel& basic_step();
/// The shipped figures of a role, in the order of the shipped grammar.
const std::vector<FigureModel>& salsa_figures(DanceRole role = DanceRole::lead);
/// The shipped grammar.
const FigureGrammar& couple_grammar();
/// The shipped grammar for one alone, who need not leave room.
const FigureGrammar& salsa_grammar();
std::shared_ptr<const DanceLibrary> library_of(const FigureModel& model);
/// Salsa with its grammar.
std::shared_ptr<const DanceLibrary> salsa_library(DanceRole role = DanceRole::lead);
/// The same for one of a couple.
std::shared_ptr<const DanceLibrary> couple_library(DanceRole role);
/// The same of figures of joint positions.
std::shared_ptr<const DanceLibrary> position_library();

/// A shipped dance that was written: its figures and its grammar.
DanceContent written_dance(const std::string& name);

/// One state of known music: sure, loud, in bars of four, on this grid.
MusicState sure_state(HopIndex hop, const BeatGrid& grid);

/// A steady tempo with a beat, a downbeat, at time 0.
BeatGrid steady_grid(double bpm);

/// The music of every hop.
using Music = std::function<MusicState(HopIndex)>;
Music steady_music(double bpm);

/// Every hop's final pose of a dancer to this music.
std::vector<Pose> dance_to(const Music& music,
                           HopIndex hops,
                           const FigureModel& model = basic_step());

/// Faster than 10 m/s no joint may go: metres a hop.
inline constexpr double kFastestStep = 0.10;

/// Largest distance in metres that any joint moves between two poses one hop apart.
double largest_step(const std::vector<Pose>& poses, HopIndex from, HopIndex to);

/// Whether two poses are the same, bit for bit.
bool are_same(const Pose& a, const Pose& b);

}  // namespace raks::motion::test
