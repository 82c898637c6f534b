// The program raks-decode: decodes sound files for raks, which starts it and gives it the open
// files. Each is decoded in a copy of its own, which a damaged or malicious file can at worst end.
#include <sys/mman.h>
#include <sys/stat.h>

#include <cstdio>
#include <exception>
#include <string_view>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/file_window.hpp"
#include "engine/decode/confine.hpp"
#include "engine/decode/decode_server.hpp"
#include "engine/decode/fork_server.hpp"

namespace raks::engine {
namespace {

constexpr int kWrongUsage = 2;

// The memory that raks made; null where there is none.
audio::DecodeMemory* map_memory() {
    struct stat status {};
    if (fstat(audio::kDecodeMemory, &status) != 0 ||
        status.st_size != static_cast<off_t>(sizeof(audio::DecodeMemory))) {
        return nullptr;
    }
    void* const memory = mmap(nullptr,
                              sizeof(audio::DecodeMemory),
                              PROT_READ | PROT_WRITE,
                              MAP_SHARED,
                              audio::kDecodeMemory,
                              0);
    return memory == MAP_FAILED ? nullptr : static_cast<audio::DecodeMemory*>(memory);
}

// Was this started by raks, which speaks over a socket?
bool is_started_by_raks() {
    struct stat status {};
    return fstat(audio::kDecodeSocket, &status) == 0 && S_ISSOCK(status.st_mode);
}

int serve(bool is_confined) {
    if (!is_started_by_raks()) {
        std::fputs("raks-decode: is started by raks, to decode sound files; use raks\n", stderr);
        return kWrongUsage;
    }
    if (!become_decoder()) {
        return 0;
    }
    audio::DecodeMemory* const memory = map_memory();
    if (memory == nullptr) {
        return kWrongUsage;
    }
    end_with(audio::kDecodeLifeline);
    audio::FileWindow::count_reads(&memory->beat);
    const bool is_filtered = is_confined && confine() == Confinement::whole;
    DecodeServer(audio::kDecodeSocket, *memory, is_filtered || !is_confined).run();
    return 0;
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    const bool is_confined = argc < 2 || std::string_view(argv[1]) != "--no-sandbox";
    try {
        return raks::engine::serve(is_confined);
    } catch (const std::exception& problem) {
        // No memory within the limit, as a rule.
        std::fprintf(stderr, "raks-decode: %s\n", problem.what());
        return 1;
    }
}
