#pragma once

#include <cstdint>

namespace raks::engine {

/// What became of confine().
enum class Confinement : std::uint8_t {
    whole,
    without_filter,  ///< this kernel refuses seccomp; all else holds
};

/// Takes from this process, for good, what a decoder does not need: files and sockets but those
/// that are open, other programs, threads, more rights; more than `more_memory` bytes of memory
/// than it has now. A system call that is not on the list is answered with EPERM. Libraries must be
/// loaded before. Threads: the only one. Real-time: no.
[[nodiscard]] Confinement confine(std::uint64_t more_memory);

/// Ends this process when the other end of this pipe is closed, also while a decoder spins. (Not by
/// PR_SET_PDEATHSIG, which counts the end of the *thread* that started it.)
void end_with(int lifeline);

}  // namespace raks::engine
