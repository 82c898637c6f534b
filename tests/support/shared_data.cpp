#include "tests/support/shared_data.hpp"

#include <cstdlib>

namespace raks::test {

std::filesystem::path shared_data() {
    const char* const given = std::getenv("RAKS_SHARED");  // NOLINT(concurrency-mt-unsafe)
    const std::filesystem::path folder =
        given != nullptr ? given : std::filesystem::path(RAKS_SOURCE_DIR) / ".." / "shared";
    return folder / "data";
}

}  // namespace raks::test
