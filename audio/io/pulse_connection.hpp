#pragma once

#include <pulse/pulseaudio.h>

#include <chrono>
#include <memory>
#include <string>

namespace raks::audio {

/// One connection to the PulseAudio (or PipeWire) server, whose main loop is run step by step, so
/// that whatever is asked ends at a deadline even when the server never answers. Never starts a
/// server.
/// Threads: one at a time; wake() any. Real-time: no.
class PulseConnection {
 public:
    using Deadline = std::chrono::steady_clock::time_point;

    /// How connect() ended.
    enum class Result {
        connected,
        absent,   ///< there is no server
        no_reply  ///< there is one, and it did not answer in time
    };

    /// `name`: what a desktop's mixer shows.
    explicit PulseConnection(const char* name);
    ~PulseConnection();
    /// Not copied: the loop's callbacks hold its address.
    PulseConnection(const PulseConnection&) = delete;
    PulseConnection& operator=(const PulseConnection&) = delete;  ///< likewise

    /// Connects until the deadline.
    [[nodiscard]] Result connect(Deadline deadline);
    /// Runs the loop until `operation` (may be null) is done; false at the deadline, or when the
    /// server failed. Takes the operation over.
    bool finish(pa_operation* operation, Deadline deadline);
    /// One turn of the loop of at most 50 ms; false at the deadline or when the loop failed.
    [[nodiscard]] bool step(Deadline deadline);
    /// One turn of the loop that waits until something happens or wake() is called; false when the
    /// loop failed.
    [[nodiscard]] bool wait();
    /// Ends a wait(). Threads: any.
    void wake() noexcept { pa_mainloop_wakeup(loop_.get()); }

    /// libpulse's own object.
    [[nodiscard]] pa_context* context() const noexcept { return context_.get(); }
    /// Whether the server is there.
    [[nodiscard]] bool is_good() const noexcept;
    /// libpulse's text for what failed last.
    [[nodiscard]] std::string reason() const;

 private:
    struct Free {
        void operator()(pa_mainloop* loop) const noexcept { pa_mainloop_free(loop); }
        void operator()(pa_context* context) const noexcept { pa_context_unref(context); }
    };
    std::unique_ptr<pa_mainloop, Free> loop_;
    std::unique_ptr<pa_context, Free> context_;
};

}  // namespace raks::audio
