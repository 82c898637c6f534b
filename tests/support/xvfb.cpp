#include "tests/support/xvfb.hpp"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <stdexcept>

#include "tests/support/program.hpp"

namespace raks::test {

Xvfb::Xvfb(int width, int height) {
    constexpr int kDisplayDescriptor = 7;
    const Program child =
        start_program({"Xvfb",
                       "-displayfd",
                       std::to_string(kDisplayDescriptor),
                       "-screen",
                       "0",
                       std::to_string(width) + "x" + std::to_string(height) + "x24",
                       "-nolisten",
                       "tcp",
                       "-noreset"},  // else it refuses clients for a moment when the last leaves
                      kDisplayDescriptor,
                      "/dev/null");
    pid_ = child.pid;
    const std::string number = read_line(child.output);  // it says so once it takes clients
    close(child.output);
    if (number.empty()) {
        wait_for(pid_);
        throw std::runtime_error("Xvfb ended before it was ready");
    }
    display_ = ":" + number;
    setenv("DISPLAY", display_.c_str(), 1);   // NOLINT(concurrency-mt-unsafe): one thread yet
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);  // NOLINT(concurrency-mt-unsafe)
}

Xvfb::~Xvfb() {
    kill(pid_, SIGTERM);
    wait_for(pid_);
}

}  // namespace raks::test
