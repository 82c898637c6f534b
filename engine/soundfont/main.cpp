// The program raks-soundfont: plays one piece with soundfonts for raks-train, which starts it with
// their paths. It opens them, enters a cage, and reads them there, where a damaged or malicious
// soundfont can at worst end it.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "audio/music/instruments/soundfont_player.hpp"
#include "audio/music/instruments/soundfont_protocol.hpp"
#include "base/talking_child.hpp"
#include "engine/decode/confine.hpp"

namespace raks::engine {
namespace {

using audio::kSoundfontSocket;

constexpr std::uint64_t kMemory = std::uint64_t{2} << 30U;  // bytes, beside what libraries take
constexpr rlim_t kSeconds = 300;                            // of the processor
constexpr std::uint64_t kMostNotes = 10'000'000;

// raks-train, which waits, knows when it is too late.
constexpr TalkDeadline kNever = TalkDeadline::max();

bool is_started_by_raks() {
    struct stat status {};
    return fstat(kSoundfontSocket, &status) == 0 && S_ISSOCK(status.st_mode);
}

Expected<std::vector<audio::SoundfontFile>> open_files(std::span<const std::string_view> paths) {
    std::vector<audio::SoundfontFile> files;
    for (const std::string_view path : paths) {
        const std::string name(path);
        const int descriptor = ::open(name.c_str(), O_RDONLY | O_CLOEXEC);
        if (descriptor < 0) {
            return fail(name + ": cannot be opened: " + std::generic_category().message(errno));
        }
        files.push_back({.name = name, .descriptor = descriptor});
    }
    return files;
}

template <typename T>
bool receive(std::span<T> into) {
    return receive_all(kSoundfontSocket, std::as_writable_bytes(into), kNever) == Talk::good;
}

void answer(audio::SoundfontAnswer head, std::span<const std::byte> bytes) {
    if (send_all(kSoundfontSocket, std::as_bytes(std::span(&head, 1)), kNever) == Talk::good) {
        static_cast<void>(send_all(kSoundfontSocket, bytes, kNever));
    }
}

void refuse(std::string_view why) {
    const std::string_view words = why.substr(0, audio::kMostSoundfontWords);
    answer({.words = static_cast<std::uint32_t>(words.size())}, std::as_bytes(std::span(words)));
}

void play(audio::SoundfontPlayer& player,
          const Expected<std::vector<audio::SoundfontFile>>& files) {
    audio::SoundfontPiece piece;
    if (!receive(std::span(&piece, 1)) || piece.magic != audio::SoundfontPiece().magic ||
        piece.notes > kMostNotes) {
        return;
    }
    audio::Performance performance;
    performance.seconds = piece.seconds;
    performance.notes.resize(static_cast<std::size_t>(piece.notes));
    if (!receive(std::span(performance.notes))) {
        return;
    }
    const auto loaded = files ? player.load(*files) : fail(files.error());
    if (!loaded) {
        refuse(loaded.error().message);
        return;
    }
    const std::vector<float> samples = piece.has_band != 0
                                           ? player.play(performance, piece.room, piece.band)
                                           : player.play(performance, piece.room);
    answer({.is_good = 1}, std::as_bytes(std::span(samples)));
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    if (!is_started_by_raks()) {
        std::fputs("raks-soundfont: is started by raks train, to play soundfonts; use raks train\n",
                   stderr);
        return 2;
    }
    std::vector<std::string_view> paths(argv + 1, argv + argc);
    const bool is_to_be_caged = paths.empty() || paths.back() != "--no-sandbox";
    if (!is_to_be_caged) {
        paths.pop_back();
    }
    try {
        const auto files = open_files(paths);
        raks::audio::SoundfontPlayer player;  // its settings look at the machine
        const rlimit processor{kSeconds, kSeconds};
        static_cast<void>(setrlimit(RLIMIT_CPU, &processor));
        if (is_to_be_caged) {
            static_cast<void>(confine(kMemory));
        }
        play(player, files);
    } catch (const std::bad_alloc&) {
        refuse("a soundfont takes more than 2 GiB to play");
    } catch (const std::exception& problem) {
        refuse(problem.what());
    }
    // What a soundfont has broken need not be taken down in order.
    _exit(0);
}
