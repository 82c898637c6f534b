#pragma once

#include <string_view>

namespace raks::apps {

/// One line for people on stderr, behind "raks: ": an error, a warning, what is being done. Names
/// and words that files and the command line bring along cannot break it (base/printable.hpp).
/// Threads: any. Real-time: no.
void say(std::string_view line);

}  // namespace raks::apps
