#include "tests/support/instruction_count.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>

#include "tests/support/process.hpp"

namespace raks::test {

std::string no_instruction_count() {
#if defined(RAKS_SANITIZED)
    return "a sanitizer's instructions are counted as well";
#elif !defined(__OPTIMIZE__)
    return "this build is not optimized";
#elif !defined(__x86_64__) || defined(__clang__)
    return "this build has no loops for AVX2";
#else
    if (!__builtin_cpu_supports("avx2")) {
        return "this machine has no AVX2";
    }
    ProcessPlan plan;
    plan.command = {"valgrind", "--version"};
    return run_process(plan).exit_code == 0 ? "" : "valgrind is not installed";
#endif
}

long long instructions_in(const std::string& function,
                          const std::string& test,
                          const std::string& file) {
    ProcessPlan plan;
    plan.command = {"valgrind",
                    "--tool=callgrind",
                    "--callgrind-out-file=/dev/null",
                    "--toggle-collect=" + function,
                    std::filesystem::read_symlink("/proc/self/exe").string(),
                    "--gtest_filter=" + test,
                    "--gtest_also_run_disabled_tests"};
    plan.environment = {{"RAKS_TEST_FILE", file}};
    plan.timeout = std::chrono::minutes(5);
    const ProcessResult result = run_process(plan);
    EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
    const std::string mark = "Collected : ";
    const std::size_t at = result.err.find(mark);
    EXPECT_NE(at, std::string::npos) << result.err;
    return at == std::string::npos ? 0 : std::stoll(result.err.substr(at + mark.size()));
}

}  // namespace raks::test
