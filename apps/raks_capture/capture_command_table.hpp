#pragma once

#include "apps/terminal/command_table.hpp"

namespace raks::apps {

/// Adds all commands of the program `raks-capture`, of which one must be chosen.
void add_commands(CommandTable& table);

}  // namespace raks::apps
