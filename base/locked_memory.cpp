#include "base/locked_memory.hpp"

#include <sys/mman.h>
#include <sys/resource.h>

#include <cerrno>
#include <system_error>

#include <fmt/format.h>

namespace raks {

// Pages that nobody touched yet stay away: prepared objects have touched theirs, and the whole
// address space, with what a graphics driver reserves, is far larger. Memory of later is not
// included: once the limit is reached it could not be had at all.
Expected<void> lock_memory() {
    if (::mlockall(MCL_CURRENT | MCL_ONFAULT) == 0) {
        return {};
    }
    const int error_number = errno;
    rlimit limit{};
    if (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        return fail(fmt::format("memory is not locked: the system allows {} MB (ulimit -l)",
                                limit.rlim_cur >> 20U));
    }
    return fail("memory is not locked: " + std::generic_category().message(error_number));
}

}  // namespace raks
