#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "base/child_process.hpp"
#include "base/expected.hpp"

namespace raks::audio {

/// How raks-decode is started.
struct DecoderStart {
    std::filesystem::path program;  ///< of raks-decode
    /// What it gets from kDecodeSocket on; they stay the caller's. All else is closed.
    std::span<const int> descriptors;
    std::string mode{};  ///< its first argument, such as "--pictures"; empty: none
};

/// Starts raks-decode as spawn_child does. Errors: the system's.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<pid_t> spawn_decoder(const DecoderStart& start);

/// What came of waiting for a child.
enum class Waited : std::uint8_t {
    answer,  ///< there is one
    broke,   ///< it is gone
    hung,    ///< it gave no sign of life for too long
    stopped  ///< the caller no longer wants one
};

/// Why a child was ended, in words: "its decoder ended too soon (killed by SIGSEGV)". `why`: what
/// came of waiting for it, an answer being one that is nonsense; `how`: of end_child.
[[nodiscard]] std::string why_ended(Waited why, const std::string& how);

}  // namespace raks::audio
