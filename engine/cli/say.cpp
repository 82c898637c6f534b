#include "engine/cli/say.hpp"

#include <cstdio>

#include "base/printable.hpp"

namespace raks::cli {

void say(std::string_view line) { std::fprintf(stderr, "raks: %s\n", printable(line).c_str()); }

}  // namespace raks::cli
