#pragma once

#include <string>

#include "apps/terminal/command_table.hpp"

/// The options of the commands of `raks-train`.
namespace raks::apps {

/// Adds `figure`.
void add_train_figure(CommandTable& table);
/// Adds `take`.
void add_train_take(CommandTable& table);
/// Adds `report`.
void add_train_report(CommandTable& table);
/// Adds `beats`. `command`: the command line, which is stored in what it makes.
void add_train_beats(CommandTable& table, const std::string& command);
/// Adds `genre`. `command`: likewise.
void add_train_genre(CommandTable& table, const std::string& command);

}  // namespace raks::apps
