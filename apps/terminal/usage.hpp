#pragma once

#include <optional>

namespace CLI {
class App;
}

namespace raks::apps {

/// Reads the command line of one of the programs into what `app` was given. Help and the version
/// are printed to stdout; wrong usage is one line on stderr. Returns what the program is to end
/// with, or nothing: go on.
[[nodiscard]] std::optional<int> read_usage(CLI::App& app, int argc, char** argv);

}  // namespace raks::apps
