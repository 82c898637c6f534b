#pragma once

#include "apps/raks/commands.hpp"
#include "engine/setup/settings.hpp"

namespace CLI {
/// Of CLI11, whose header is large.
class App;
}  // namespace CLI

namespace raks::apps {

/// Adds `--preset NAME`, which puts the preset over the settings of the files. Added before the
/// options of settings: values are stored in the order in which options are added, whatever their
/// order on the command line, so that those of the command line win. `video`, `told`: get the
/// preset's outputs; null: the command has none. A name that no preset has is a wrong command line;
/// of a preset that cannot be read nothing is used, and one line says so.
void add_preset_option(CLI::App& app,
                       engine::Settings& settings,
                       VideoArguments* video = nullptr,
                       std::vector<engine::OutputWish>* told = nullptr);

}  // namespace raks::apps
