#include "base/locked_memory.hpp"

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <fstream>
#include <string>

namespace raks {
namespace {

TEST(LockedMemory, is_locked_or_says_why_not) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "sanitizers lock no memory: theirs is far larger than what there is";
#endif
    const auto locked = lock_memory();
    std::ifstream status("/proc/self/status");
    std::string line;
    while (std::getline(status, line) && !line.starts_with("VmLck:")) {
    }
    const bool holds_some = line.find_first_of("123456789") != std::string::npos;
    EXPECT_EQ(holds_some, locked.has_value()) << line;
    if (!locked) {
        EXPECT_TRUE(locked.error().message.starts_with("memory is not locked: "));
    }
    munlockall();
}

}  // namespace
}  // namespace raks
