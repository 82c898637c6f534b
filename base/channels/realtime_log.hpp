#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

#include "base/channels/event_queue.hpp"
#include "base/realtime.hpp"
#include "base/time.hpp"

namespace raks {

/// What a real-time thread has to say, without formatting there: a fixed text with two numbers.
struct LogRecord {
    const char* text = "";  ///< static storage; "%a" and "%b" stand for the numbers
    double a = 0.0;
    double b = 0.0;
    StreamTime time{};
};

/// Log of one real-time thread. A worker drains and formats it; full means dropped and counted.
/// Threads: note from one real-time thread, drain_line from one other. Real-time: note yes.
class RealtimeLog {
 public:
    explicit RealtimeLog(std::size_t capacity = 256) : queue_(capacity) {}

    void note(StreamTime time,
              const char* text,
              double a = 0.0,
              double b = 0.0) noexcept RAKS_NONBLOCKING {
        queue_.push({text, a, b, time});
    }

    /// Next line, formatted; false when there is none.
    bool drain_line(std::string& line);

    [[nodiscard]] std::uint64_t dropped() const noexcept { return queue_.dropped(); }

 private:
    EventQueue<LogRecord> queue_;
};

}  // namespace raks
