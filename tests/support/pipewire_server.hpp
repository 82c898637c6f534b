#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {

/// PipeWire with WirePlumber and its PulseAudio server, of our own and without systemd, as
/// scripts/unpack_pipewire.sh puts it into the build folder. Two sinks: `speakers` ("Speakers", the
/// default) and `headphones` ("Headphones"); more as PulseServer adds them. Changes this process's
/// environment for good: use it in a process of its own.
class PipeWireServer {
 public:
    PipeWireServer();

    /// Whether it was unpacked: else a test skips.
    [[nodiscard]] static bool is_unpacked();
    /// Empty when the server answers; else why not.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
    /// Ends its programs at once, as a crash would.
    void kill();
    /// Starts them again with both sinks.
    void start();

 private:
    TemporaryFolder folder_;
    std::string problem_;
    std::unique_ptr<ChildProcess> bus_;
    std::vector<std::unique_ptr<ChildProcess>> programs_;  // later ones need those before
};

}  // namespace raks::test
