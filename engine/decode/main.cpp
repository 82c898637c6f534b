// The program raks-decode: decodes sound files and, with --pictures, films for raks, which starts
// it and gives it the open files. Each sound file is decoded in a copy of its own, each film in a
// process of its own, which a damaged or malicious file can at worst end.
#include <sys/mman.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdio>
#include <exception>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/file_window.hpp"
#include "engine/decode/caged_program.hpp"
#include "engine/decode/confine.hpp"
#include "engine/decode/decode_server.hpp"
#include "engine/decode/film_server.hpp"
#include "engine/decode/fork_server.hpp"

namespace raks::engine {
namespace {

constexpr Cage kCageForSound{.more_memory = std::uint64_t{512} << 20U, .seconds = {}};
// A dozen pictures of 8192 x 8192.
constexpr Cage kCageForPictures{.more_memory = std::uint64_t{2} << 30U, .seconds = {}};

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

int serve_films(const CagedArguments& arguments) {
    end_with(audio::kDecodeLifeline);
    const bool is_safe = enter_cage(arguments, kCageForPictures);
    FilmServer(audio::kDecodeSocket, audio::kDecodePictures, is_safe).run();
    return 0;
}

int serve_sound(const CagedArguments& arguments) {
    if (!become_decoder()) {
        return 0;
    }
    audio::DecodeMemory* const memory = map_memory();
    if (memory == nullptr) {
        return kWrongUsage;
    }
    end_with(audio::kDecodeLifeline);
    audio::FileWindow::count_reads(&memory->beat);
    DecodeServer(audio::kDecodeSocket, *memory, enter_cage(arguments, kCageForSound)).run();
    return 0;
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    const auto arguments = arguments_of_raks(argc, argv);
    if (!arguments) {
        std::fputs("raks-decode: is started by raks, to decode sound and films; use raks\n",
                   stderr);
        return kWrongUsage;
    }
    try {
        const bool is_for_films =
            !arguments->words.empty() && arguments->words.front() == "--pictures";
        return is_for_films ? serve_films(*arguments) : serve_sound(*arguments);
    } catch (const std::exception& problem) {
        // No memory within the limit, as a rule.
        std::fprintf(stderr, "raks-decode: %s\n", problem.what());
        return 1;
    }
}
