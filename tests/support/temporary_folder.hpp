#pragma once

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <system_error>

namespace raks::test {

/// An empty folder that nobody else has: tests run side by side, and so may whole test runs. It
/// goes away with this.
class TemporaryFolder {
 public:
    TemporaryFolder() {
        std::string pattern = ::testing::TempDir() + "raks-XXXXXX";
        if (mkdtemp(pattern.data()) == nullptr) {
            throw std::system_error(errno, std::generic_category(), pattern);
        }
        path_ = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }
    [[nodiscard]] bool is_empty() const { return std::filesystem::is_empty(path_); }

 private:
    std::filesystem::path path_;
};

}  // namespace raks::test
