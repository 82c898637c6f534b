#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/expected.hpp"

namespace raks::engine {

/// A picture of a folder.
struct NumberedPicture {
    std::filesystem::path path;
    std::int64_t number = 0;  ///< the last one in its name, >= 0
};

/// The PNG and JPEG pictures of a folder in the order of their numbers; other files are passed
/// over. Errors: the folder cannot be read, has none, two of them have the same number. Threads:
/// any. Real-time: no.
[[nodiscard]] Expected<std::vector<NumberedPicture>> list_numbered_pictures(
    const std::filesystem::path& folder);

}  // namespace raks::engine
