#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::test {

/// A PulseAudio server of our own with the null sink `raks_null`, whose monitor can be recorded,
/// and as many more as a test adds. For "it runs" only: its round trip drifts. Changes this
/// process's environment for good: use it in a process of its own.
class PulseServer {
 public:
    /// `description`: what a desktop calls the sink; its monitor is then "Monitor of" that.
    explicit PulseServer(std::string description = "Null Output", int rate = 48'000);

    /// Empty when the server answers; else why not.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }

    /// One more null sink: what programs call it, and what people do.
    static void add_sink(const std::string& name,
                         const std::string& description,
                         int rate = 48'000);
    /// A sink that is heard about 0.3 s after it was given sound, and says so: a second server
    /// plays it. Its name and description are of that server's making.
    void add_slow_sink();
    /// Takes a sink away, as if it were unplugged.
    static void remove_sink(const std::string& name);
    /// What the desktop's sound settings do.
    static void set_default_sink(const std::string& name);
    /// Runs `pactl` with these arguments; false when it fails.
    [[nodiscard]] static bool pactl(std::vector<std::string> arguments);
    /// Ends the server at once, as a crash would.
    void kill();
    /// Starts it again with the first sink alone.
    void restart(int rate);
    /// Stops the server's process (it accepts connections and does not answer), or lets it go on.
    void freeze(bool is_frozen) const;

 private:
    void start(int rate);
    [[nodiscard]] std::unique_ptr<ChildProcess> server(
        const std::string& socket, const std::vector<std::string>& first_sink) const;

    TemporaryFolder folder_;
    std::string description_;
    std::string problem_;
    std::unique_ptr<ChildProcess> process_;
    std::unique_ptr<ChildProcess> far_;  // the server of the slow sink
};

}  // namespace raks::test
