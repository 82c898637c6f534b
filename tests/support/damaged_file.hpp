#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string_view>

namespace raks::test {

/// Writes one of thousands of damaged files over the one before it. `raks::write_file` would wait
/// for the disk each time, which takes longer than the test itself.
inline void write_damaged(const std::filesystem::path& path, std::string_view bytes) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    ASSERT_TRUE(file.good()) << path << " cannot be written";
}

}  // namespace raks::test
