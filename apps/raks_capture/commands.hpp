#pragma once

#include "apps/clips/body_options.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/terminal/command_table.hpp"

/// The commands of the program `raks-capture`, which `raks capture` starts.
namespace raks::apps {

/// Adds all of them, of which one must be chosen.
void add_commands(CommandTable& table);

/// Adds `board`.
void add_board(CommandTable& table);
/// Adds `calibrate`.
void add_calibrate(CommandTable& table);
/// Adds `correct`.
void add_correct(CommandTable& table);
/// Adds `run`.
void add_run(CommandTable& table);
/// Adds `label`.
void add_label(CommandTable& table);
/// Adds `report`.
void add_report(CommandTable& table);
/// Adds `simulate`.
void add_simulate(CommandTable& table);
/// Adds `sync`.
void add_sync(CommandTable& table);
/// Adds `compare`.
void add_compare(CommandTable& table);
/// Adds `solve`.
void add_solve(CommandTable& table);
/// Adds `track`.
void add_track(CommandTable& table);

}  // namespace raks::apps
