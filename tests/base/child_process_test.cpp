// What a program of ours gets of ours when it is started to read what others wrote.
#include "base/child_process.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "base/file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks {
namespace {

/// The environment of a child, each variable with a null behind it.
std::string environment_of_child(bool has_ours) {
    const test::TemporaryFolder folder;
    const std::string file = (folder / "environment").string();
    const auto child = spawn_child({.program = "/bin/cp",
                                    .arguments = {"/proc/self/environ", file},
                                    .descriptors = {},
                                    .has_our_environment = has_ours});
    EXPECT_TRUE(child) << child.error().message;
    EXPECT_EQ(::waitpid(*child, nullptr, 0), *child);
    return read_file(file).value();
}

TEST(Child, gets_of_our_environment_what_it_needs_alone) {
    setenv("RAKS_SECRET", "1234", 1);
    setenv("LD_LIBRARY_PATH", "/nowhere", 1);
    unsetenv("ASAN_OPTIONS");
    unsetenv("LSAN_OPTIONS");
    unsetenv("RTSAN_OPTIONS");
    unsetenv("TSAN_OPTIONS");
    unsetenv("UBSAN_OPTIONS");
    EXPECT_EQ(environment_of_child(false), std::string("LD_LIBRARY_PATH=/nowhere\0", 25));
    unsetenv("LD_LIBRARY_PATH");
    EXPECT_EQ(environment_of_child(false), "");
    EXPECT_NE(environment_of_child(true).find("RAKS_SECRET=1234"), std::string::npos);
}

}  // namespace
}  // namespace raks
