#pragma once

#include <string>

namespace raks::apps {

/// What `raks --version` prints: version, commit, compiler, the FFmpeg and the PipeWire that are
/// there when it is asked for, and the licence of the whole. Loads the modules of films and of
/// PipeWire. Threads: main.
[[nodiscard]] std::string version_text();

}  // namespace raks::apps
