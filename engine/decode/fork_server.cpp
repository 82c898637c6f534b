#include "engine/decode/fork_server.hpp"

#include <sched.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>

#include "audio/io/decode_protocol.hpp"

namespace raks::engine {
namespace {

using Given = std::array<int, audio::kMostDescriptors>;

// fork(), but the copy is a child of this program's own parent. This process has one thread, so
// that the C library holds no lock that the copy would lack.
pid_t copy_process() {
    return static_cast<pid_t>(::syscall(SYS_clone, CLONE_PARENT | SIGCHLD, 0, 0, 0, 0));
}

// The numbers that a decoder expects; all else is closed.
bool put_in_place(const Given& given) {
    constexpr int kAbove = 16;
    Given moved{};
    for (std::size_t i = 0; i < given.size(); ++i) {
        moved[i] = ::dup2(given[i], kAbove + static_cast<int>(i));
    }
    bool is_done = true;
    for (std::size_t i = 0; i < given.size(); ++i) {
        is_done = ::dup2(moved[i], audio::kDecodeSocket + static_cast<int>(i)) >= 0 && is_done;
    }
    ::close_range(audio::kDecodeLifeline + 1, ~0U, 0);
    return is_done;
}

}  // namespace

bool become_decoder() {
    static_assert(audio::kDecodeMemory == audio::kDecodeSocket + 1 &&
                  audio::kDecodeLifeline == audio::kDecodeSocket + 2);
    // Lists of processes show which is which.
    static_cast<void>(::prctl(PR_SET_NAME, audio::kForkServerName));
    audio::DecodeMessage message;
    Given given{};
    while (audio::receive_message(audio::kDecodeSocket, message, given) == Talk::good &&
           message.kind == audio::DecodeKind::start && given.back() >= 0) {
        const pid_t pid = copy_process();
        if (pid == 0) {
            static_cast<void>(::prctl(PR_SET_NAME, audio::kDecoderName));
            return put_in_place(given);
        }
        message.kind = audio::DecodeKind::started;
        message.value = pid > 0 ? pid : -errno;
        message.set_text({});
        for (const int descriptor : given) {
            ::close(descriptor);
        }
        if (audio::send_message(audio::kDecodeSocket, message) != Talk::good) {
            break;
        }
    }
    return false;
}

}  // namespace raks::engine
