#pragma once

#include "apps/terminal/command_table.hpp"

namespace raks::apps {

/// Adds `sync FOLDER` below `parent`: the clocks of the films in a capture's folder.
void add_sync(CommandTable& table, CLI::App& parent);

}  // namespace raks::apps
