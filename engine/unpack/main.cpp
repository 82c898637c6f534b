// The program raks-unpack: unpacks the pictures and meshes of one model for raks, which starts it
// and hands them to it one after the other. It runs in a cage, which damaged or malicious bytes can
// at worst end.
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <span>
#include <string_view>
#include <vector>

#include "base/talking_child.hpp"
#include "engine/decode/confine.hpp"
#include "engine/unpack/unpackers.hpp"
#include "render/import/import_budget.hpp"
#include "render/import/unpack_protocol.hpp"

namespace raks::engine {
namespace {

using render::kUnpackSocket;
using render::UnpackAnswer;
using render::UnpackRequest;

constexpr std::uint64_t kMemory = std::uint64_t{2} << 30U;  // bytes, beside what libraries take
constexpr rlim_t kSeconds = 60;                             // of the processor

// raks, which waits, knows when it is too late.
constexpr TalkDeadline kNever = TalkDeadline::max();

bool is_started_by_raks() {
    struct stat status {};
    return fstat(kUnpackSocket, &status) == 0 && S_ISSOCK(status.st_mode);
}

bool is_in_bounds(const UnpackRequest& what) {
    return what.magic == UnpackRequest().magic && what.packed_bytes <= render::kMostModelBytes &&
           what.row_bytes > 0 && what.rows <= render::kMostModelBytes / what.row_bytes;
}

Expected<void> unpack_within_memory(const UnpackRequest& what,
                                    const std::vector<std::byte>& packed,
                                    std::vector<std::byte>& out) {
    try {
        out.resize(static_cast<std::size_t>(what.rows * what.row_bytes));
        return unpack(what, packed, out);
    } catch (const std::bad_alloc&) {
        return fail("it takes more than 2 GiB to unpack");
    }
}

Talk send_answer(UnpackAnswer answer, std::span<const std::byte> bytes) {
    const Talk sent = send_all(kUnpackSocket, std::as_bytes(std::span(&answer, 1)), kNever);
    return sent == Talk::good ? send_all(kUnpackSocket, bytes, kNever) : sent;
}

/// One thing after the other, until raks wants no more.
void serve(bool is_caged) {
    UnpackRequest what;
    std::vector<std::byte> packed;
    std::vector<std::byte> out;
    Talk talk = Talk::good;
    while (talk == Talk::good &&
           receive_all(kUnpackSocket, std::as_writable_bytes(std::span(&what, 1)), kNever) ==
               Talk::good &&
           is_in_bounds(what)) {
        packed.resize(static_cast<std::size_t>(what.packed_bytes));
        if (receive_all(kUnpackSocket, packed, kNever) != Talk::good) {
            return;
        }
        const auto done = unpack_within_memory(what, packed, out);
        UnpackAnswer answer{.is_good = done ? 1U : 0U, .is_caged = is_caged ? 1U : 0U};
        if (done) {
            talk = send_answer(answer, out);
            continue;
        }
        const std::string_view words =
            std::string_view(done.error().message).substr(0, render::kMostUnpackWords);
        answer.words = static_cast<std::uint32_t>(words.size());
        talk = send_answer(answer, std::as_bytes(std::span(words)));
    }
}

bool is_caged(bool is_to_be) {
    const rlimit processor{kSeconds, kSeconds};
    static_cast<void>(setrlimit(RLIMIT_CPU, &processor));
    return !is_to_be || confine(kMemory) == Confinement::whole;
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    if (!is_started_by_raks()) {
        std::fputs("raks-unpack: is started by raks, to unpack models; use raks\n", stderr);
        return 2;
    }
    const bool is_to_be_caged = argc < 2 || std::string_view(argv[1]) != "--no-sandbox";
    try {
        serve(is_caged(is_to_be_caged));
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "raks-unpack: %s\n", problem.what());
        return 1;
    }
    return 0;
}
