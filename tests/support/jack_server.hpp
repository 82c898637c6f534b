#pragma once

#include <memory>
#include <string>

#include "tests/support/child_process.hpp"

namespace raks::test {

/// A name that no other test's server has as long as this lives.
class ServerName {
 public:
    ServerName();
    ~ServerName();
    ServerName(const ServerName&) = delete;
    ServerName& operator=(const ServerName&) = delete;

    [[nodiscard]] const std::string& get() const noexcept { return name_; }

 private:
    std::string name_;
    int lock_ = -1;
};

/// A JACK server of our own with the dummy driver, real-time where that is allowed: real streams
/// without a sound card. Points this process (and its children) to it by JACK_DEFAULT_SERVER.
///
///     JackServer jack;
///     ASSERT_EQ(jack.problem(), "");
///     ... open streams ...
///     jack.connect("raks:out_0", "raks-in:in_0");
class JackServer {
 public:
    /// `priority`: the server's own, where it is real-time; its clients have five less.
    explicit JackServer(int rate = 48'000, int period = 256, int priority = 70);
    ~JackServer();
    JackServer(const JackServer&) = delete;
    JackServer& operator=(const JackServer&) = delete;

    /// Empty when the server answers; else why not. A test fails then, it does not skip.
    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
    /// "SCHED_FIFO" or "normal": the scheduling class asked for.
    [[nodiscard]] const std::string& scheduling() const noexcept { return scheduling_; }

    /// True when done. Ports: "raks:out_0", "raks-in:in_0", "system:capture_1", ...
    [[nodiscard]] bool connect(const std::string& from, const std::string& to) const;
    [[nodiscard]] bool disconnect(const std::string& from, const std::string& to) const;
    /// Ends the server at once, as a crash would.
    void kill();
    /// Starts it again after kill(), under the same name. False: it does not start.
    [[nodiscard]] bool restart(int rate, int period = 256);

 private:
    [[nodiscard]] bool start(int rate, int period);
    [[nodiscard]] const std::string& name() const noexcept { return name_.get(); }
    /// What the server said is there.
    [[nodiscard]] std::string log() const;

    ServerName name_;
    int priority_;
    std::string scheduling_;
    std::string problem_;
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace raks::test
