#pragma once

#include <optional>

namespace raks::apps {

/// From here on SIGINT and SIGTERM are noted instead of ending the process, SIGXFSZ (a file grew
/// over its limit) and SIGPIPE become errors of the write. A second SIGINT ends at once.
/// Threads: main, once.
void catch_signals() noexcept;

/// The signal that asked the program to stop, if any came.
/// Threads: any. Real-time: yes.
[[nodiscard]] std::optional<int> stop_signal() noexcept;

/// 128 + the signal's number when one came, else `code`.
[[nodiscard]] int exit_code_after_signals(int code) noexcept;

}  // namespace raks::apps
