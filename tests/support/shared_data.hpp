#pragma once

#include <filesystem>

namespace raks::test {

/// The folder of data too large, or not free, to lie in the repository: $RAKS_SHARED, or `shared`
/// beside the checkout. Tests that need it are skipped where it is not.
[[nodiscard]] std::filesystem::path shared_data();

}  // namespace raks::test
