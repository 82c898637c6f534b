#pragma once

#include <sys/types.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "base/expected.hpp"

namespace raks {

/// The first descriptor that a child is given; the others follow it.
inline constexpr int kFirstGiven = 3;

/// How a part of ours is started that does for us what may break it.
struct ChildStart {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    /// What it gets from kFirstGiven on; they stay the caller's. All else is closed.
    std::span<const int> descriptors;
    bool is_heard = false;  ///< what it says on standard error is not lost
    /// It gets our whole environment, as a program that looks for a person's files needs it. Else
    /// it gets of ours where libraries lie (LD_LIBRARY_PATH) and what sanitizers are told.
    bool has_our_environment = false;
};

/// Starts a child of this process, with signals as a fresh program has them and a process group of
/// its own: what the terminal sends to us (Ctrl+C) is for us alone. It reads nothing and what it
/// prints is lost. Errors: the system's. Threads: any. Real-time: no.
[[nodiscard]] Expected<pid_t> spawn_child(const ChildStart& start);

/// Kills a child and waits for its end; says how it ended, which may have been before: "killed by
/// SIGSEGV" or "exit code 1". Threads: any. Real-time: no.
std::string end_child(pid_t pid);

/// The same for a child of spawn_child, with all that it started in its process group.
std::string end_child_group(pid_t pid);

}  // namespace raks
