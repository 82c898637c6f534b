// The program raks-unpack: unpacks the pictures and meshes of one model for raks, which starts it
// and hands them to it one after the other. It runs in a cage, which damaged or malicious bytes can
// at worst end.
#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <vector>

#include "base/talk_answer.hpp"
#include "engine/decode/caged_program.hpp"
#include "engine/unpack/unpackers.hpp"
#include "render/import/import_budget.hpp"
#include "render/import/unpack_protocol.hpp"

namespace raks::engine {
namespace {

using render::UnpackRequest;

constexpr Cage kCage{.more_memory = std::uint64_t{2} << 30U, .seconds = 60};

bool is_in_bounds(const UnpackRequest& what) {
    return what.magic == UnpackRequest().magic && what.packed_bytes <= render::kMostModelBytes &&
           what.row_bytes > 0 && what.rows <= render::kMostModelBytes / what.row_bytes;
}

Expected<std::span<const std::byte>> unpack_within_memory(const UnpackRequest& what,
                                                          const std::vector<std::byte>& packed,
                                                          std::vector<std::byte>& out) {
    try {
        out.resize(static_cast<std::size_t>(what.rows * what.row_bytes));
        const auto done = unpack(what, packed, out);
        return done ? Expected<std::span<const std::byte>>(out) : fail(done.error());
    } catch (const std::bad_alloc&) {
        return fail("it takes more than 2 GiB to unpack");
    }
}

/// One thing after the other, until raks wants no more.
void serve(bool is_caged) {
    UnpackRequest what;
    std::vector<std::byte> packed;
    std::vector<std::byte> out;
    Talk talk = Talk::good;
    while (talk == Talk::good &&
           receive_all(kTalkSocket, std::as_writable_bytes(std::span(&what, 1)), kNever) ==
               Talk::good &&
           is_in_bounds(what)) {
        packed.resize(static_cast<std::size_t>(what.packed_bytes));
        if (receive_all(kTalkSocket, packed, kNever) != Talk::good) {
            return;
        }
        talk = send_answer(kTalkSocket, unpack_within_memory(what, packed, out), is_caged);
    }
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    const auto arguments = arguments_of_raks(argc, argv);
    if (!arguments) {
        std::fputs("raks-unpack: is started by raks, to unpack models; use raks\n", stderr);
        return kWrongUsage;
    }
    try {
        serve(enter_cage(*arguments, kCage));
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "raks-unpack: %s\n", problem.what());
        return 1;
    }
    return 0;
}
