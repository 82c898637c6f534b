#pragma once

#include <string>

namespace raks::test {

/// Why instructions mean nothing here: no valgrind, a sanitizer, a build without optimization, or a
/// machine or compiler that does not run the loops for AVX2. Empty: they do.
[[nodiscard]] std::string no_instruction_count();

/// Instructions that `function` (a pattern of callgrind's) and all that it calls execute, while
/// this test program runs `test` ("Suite.DISABLED_name"). Fails the calling test, and is 0, where
/// that does. Unlike times they are the same on a busy machine. `file`: for the test, which finds
/// its name in the environment as RAKS_TEST_FILE.
[[nodiscard]] long long instructions_in(const std::string& function,
                                        const std::string& test,
                                        const std::string& file = "");

}  // namespace raks::test
