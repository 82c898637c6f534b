#pragma once

#include <optional>

namespace CLI {
/// Of CLI11, whose header is large.
class App;
}  // namespace CLI

namespace raks::apps {

/// Parses the command line into what the options of `app` are bound to. Help and version go to
/// stdout, a wrong command line is one line on stderr. Returns the exit code to end with; nothing:
/// go on.
[[nodiscard]] std::optional<int> read_usage(CLI::App& app, int argc, char** argv);

}  // namespace raks::apps
