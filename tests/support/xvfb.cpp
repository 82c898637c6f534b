#include "tests/support/xvfb.hpp"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "tests/support/process.hpp"

namespace raks::test {

Xvfb::Xvfb(int width, int height) {
    ProcessPlan plan;
    plan.command = {"Xvfb",
                    "-displayfd",
                    "1",
                    "-screen",
                    "0",
                    std::to_string(width) + "x" + std::to_string(height) + "x24",
                    "-nolisten",
                    "tcp",
                    "-noreset"};  // else it refuses clients for a moment when the last leaves
    plan.timeout = std::chrono::hours(1);  // of all tests that use it
    server_ = std::make_unique<CapturedProcess>(plan);
    // Its number: it says so once it takes clients.
    const auto is_ready = [](const ProcessResult& said) { return said.out.ends_with('\n'); };
    if (!server_->wait_until(is_ready)) {
        throw std::runtime_error("Xvfb ended before it was ready");
    }
    display_ = ":" + server_->output().out;
    display_.pop_back();
    setenv("DISPLAY", display_.c_str(), 1);   // NOLINT(concurrency-mt-unsafe): one thread yet
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe)
}

Xvfb::~Xvfb() {
    server_->send(SIGTERM);
    server_->wait();
}

}  // namespace raks::test
