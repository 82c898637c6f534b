#include "apps/terminal/say.hpp"

#include <cstdio>

#include "base/printable.hpp"

namespace raks::apps {

void say(std::string_view line) { std::fprintf(stderr, "raks: %s\n", printable(line).c_str()); }

}  // namespace raks::apps
