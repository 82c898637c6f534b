#pragma once

#include <sys/types.h>

#include <array>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>

#include "base/expected.hpp"
#include "base/talking_child.hpp"

namespace raks::audio {

/// A fork server: the raks-decode that decodes nothing, and starts those that do. Its libraries are
/// loaded once, which takes 100 ms, and each decoder is a copy of it. The first file starts it. It
/// never sees a byte of any. For audio/io alone. Threads: any. Real-time: no.
class DecoderForkServer {
 public:
    /// Of this process.
    [[nodiscard]] static DecoderForkServer& get();
    DecoderForkServer(const DecoderForkServer&) = delete;             ///< one a process
    DecoderForkServer& operator=(const DecoderForkServer&) = delete;  ///< likewise

    /// Starts a decoder that speaks over `descriptors` (socket, memory, lifeline; they stay the
    /// caller's) and is this process's own child. `is_stop_requested` is asked every 50 ms or more
    /// often. Errors: raks-decode is not installed, cannot be started, broke off, or gave no answer
    /// for 30 s; stopped.
    [[nodiscard]] Expected<pid_t> start_decoder(const std::array<int, 3>& descriptors,
                                                const std::function<bool()>& is_stop_requested);

 private:
    DecoderForkServer() = default;
    [[nodiscard]] Talk ask(const std::array<int, 3>& descriptors,
                           const std::function<bool()>& is_stop_requested,
                           std::int64_t& answer) const;

    std::mutex mutex_;
    std::filesystem::path program_;
    std::optional<TalkingChild> child_;
};

}  // namespace raks::audio
