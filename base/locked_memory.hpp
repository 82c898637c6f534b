#pragma once

#include "base/expected.hpp"

namespace raks {

/// Keeps the memory that this process uses now from being moved to disk, so that no real-time
/// thread waits for a page of it. May be repeated when more is used. Errors: the system allows
/// less (RLIMIT_MEMLOCK); everything goes on as before.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<void> lock_memory();

}  // namespace raks
