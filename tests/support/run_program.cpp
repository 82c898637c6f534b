#include "tests/support/run_program.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "tests/support/process.hpp"

namespace raks::test {

std::string run_program(const std::vector<std::string>& command) {
    constexpr int kNotFound = 127;
    ProcessPlan plan;
    plan.command = command;
    // Only what hangs takes so long, however busy the machine is.
    plan.timeout = std::chrono::minutes(10);
    ProcessResult result = run_process(plan);
    if (result.exit_code == kNotFound) {
        throw std::runtime_error(command.front() +
                                 " does not start: run scripts/setup.sh to install it");
    }
    if (result.exit_code != 0) {
        throw std::runtime_error(command.front() + " ended with " +
                                 std::to_string(result.exit_code) + ": " + result.err);
    }
    return std::move(result.out);
}

}  // namespace raks::test
