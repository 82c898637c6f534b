#pragma once

#include <sys/types.h>

#include <cstdint>
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

/// What came of waiting for a child.
enum class Waited : std::uint8_t {
    answer,  ///< there is one
    broke,   ///< it is gone
    hung,    ///< it gave no sign of life for too long
    stopped  ///< the caller no longer wants one
};

/// Why a child was ended, in words: "its decoder broke off (killed by SIGSEGV)". `why`: what came
/// of waiting for it, an answer being one that is nonsense; `how`: of end_child.
[[nodiscard]] std::string why_ended(Waited why, const std::string& how);

}  // namespace raks::audio
