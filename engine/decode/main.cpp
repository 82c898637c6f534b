// The program raks-decode: decodes sound files and, with --pictures, films for raks, which starts
// it and gives it the open files. Each sound file is decoded in a copy of its own, each film in a
// process of its own, which a damaged or malicious file can at worst end.
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string_view>
#include <vector>

#include "audio/io/decode_protocol.hpp"
#include "audio/io/file_window.hpp"
#include "engine/decode/confine.hpp"
#include "engine/decode/decode_server.hpp"
#include "engine/decode/film_server.hpp"
#include "engine/decode/fork_server.hpp"

namespace raks::engine {
namespace {

constexpr int kWrongUsage = 2;

// Bytes of memory beside what the libraries take.
constexpr std::uint64_t kMemoryForSound = std::uint64_t{512} << 20U;
constexpr std::uint64_t kMemoryForPictures = std::uint64_t{2} << 30U;  // a dozen of 8192 x 8192

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

// Whether what is to be confined is.
bool is_caged(bool is_to_be, std::uint64_t memory) {
    return !is_to_be || confine(memory) == Confinement::whole;
}

int serve_films(bool is_confined) {
    end_with(audio::kDecodeLifeline);
    const bool is_safe = is_caged(is_confined, kMemoryForPictures);
    FilmServer(audio::kDecodeSocket, audio::kDecodePictures, is_safe).run();
    return 0;
}

int serve_sound(bool is_confined) {
    if (!become_decoder()) {
        return 0;
    }
    audio::DecodeMemory* const memory = map_memory();
    if (memory == nullptr) {
        return kWrongUsage;
    }
    end_with(audio::kDecodeLifeline);
    audio::FileWindow::count_reads(&memory->beat);
    DecodeServer(audio::kDecodeSocket, *memory, is_caged(is_confined, kMemoryForSound)).run();
    return 0;
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    const std::vector<std::string_view> words(argv + 1, argv + std::max(argc, 1));
    const auto is_given = [&words](std::string_view word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    const bool is_confined = !is_given("--no-sandbox");
    if (!raks::engine::is_started_by_raks()) {
        std::fputs("raks-decode: is started by raks, to decode sound and films; use raks\n",
                   stderr);
        return raks::engine::kWrongUsage;
    }
    try {
        return is_given("--pictures") ? raks::engine::serve_films(is_confined)
                                      : raks::engine::serve_sound(is_confined);
    } catch (const std::exception& problem) {
        // No memory within the limit, as a rule.
        std::fprintf(stderr, "raks-decode: %s\n", problem.what());
        return 1;
    }
}
