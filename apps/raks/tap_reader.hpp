#pragma once

#include <termios.h>

#include <optional>

#include "base/time.hpp"

namespace raks::apps {

/// Reads taps on any key of the terminal, without waiting for Return, or a byte each from a pipe.
/// The terminal is as before afterwards. Threads: main; one at a time.
class TapReader {
 public:
    TapReader();
    ~TapReader();
    /// Not copied: it changes the terminal.
    TapReader(const TapReader&) = delete;
    TapReader& operator=(const TapReader&) = delete;  ///< likewise

    /// When a key was pressed within the next `longest`; nothing where none was.
    [[nodiscard]] std::optional<HostTime> wait(Nanos longest);
    /// True once a pipe has ended: no tap will come.
    [[nodiscard]] bool has_ended() const noexcept { return has_ended_; }

 private:
    std::optional<termios> before_;
    bool has_ended_ = false;
};

}  // namespace raks::apps
