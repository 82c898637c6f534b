#pragma once

#include <cstddef>
#include <span>

#include "base/expected.hpp"
#include "base/talking_child.hpp"

/// What a child answers to one request: the bytes that were asked for, or why there are none.
namespace raks {

/// The child's side. `is_caged`: see confine(). Threads: one a socket. Real-time: no.
[[nodiscard]] Talk send_answer(int socket,
                               const Expected<std::span<const std::byte>>& made,
                               bool is_caged);

/// What came of a request.
struct TalkAnswer {
    Expected<void> done;   ///< or why not, in one line
    bool is_caged = true;  ///< by seccomp, if the child is to be believed
};

/// Our side. Good: `answer` is filled in and, where it is done, all of `made`. Whatever the child
/// says, no more than `made` is written to. One that is not caged is noted (note_uncaged_child).
/// Threads: one a socket. Real-time: no.
[[nodiscard]] Talk receive_answer(int socket,
                                  std::span<std::byte> made,
                                  TalkDeadline deadline,
                                  TalkAnswer& answer);

}  // namespace raks
