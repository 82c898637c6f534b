#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string>

#include "base/expected.hpp"

namespace raks::audio {

/// How raks-decode is started.
struct DecoderStart {
    std::filesystem::path program;  ///< of raks-decode
    /// What it gets from kDecodeSocket on; they stay the caller's. All else is closed.
    std::span<const int> descriptors;
    std::string mode{};  ///< its first argument, such as "--pictures"; empty: none
};

/// Starts raks-decode as a child of this process, with signals as a fresh program has them and a
/// process group of its own; what its libraries print is lost. Errors: the system's.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<pid_t> spawn_decoder(const DecoderStart& start);

/// Kills a child and waits for its end; says how it ended, which may have been before: "killed by
/// SIGSEGV" or "exit code 1". Threads: any. Real-time: no.
std::string end_child(pid_t pid);

}  // namespace raks::audio
