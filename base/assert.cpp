#include "base/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace raks {

void assertion_failed(const char* expression, const char* file, int line) noexcept {
    std::fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, expression);
    // The message comes first: abort() does not return.
    std::abort();
}

}  // namespace raks
