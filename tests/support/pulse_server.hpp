#pragma once

#include <memory>
#include <string>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {

/// A PulseAudio server of our own with the null sink `raks_null`, whose monitor can be recorded.
/// For "it runs" only: its round trip drifts. Changes this process's environment for good: use it
/// in a process of its own, before PortAudio was initialized.
class PulseServer {
 public:
    /// `description`: what a desktop calls the sink; its monitor is then "Monitor of" that.
    explicit PulseServer(const std::string& description = "Null Output");

    /// Empty when the server answers; else why not.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

 private:
    TemporaryFolder folder_;
    std::string problem_;
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace raks::test
