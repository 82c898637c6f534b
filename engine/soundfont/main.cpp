// The program raks-soundfont: plays one piece with soundfonts for raks-train, which starts it with
// their paths. It opens them, enters a cage, and reads them there, where a damaged or malicious
// soundfont can at worst end it.
#include <fcntl.h>
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
#include "base/talk_answer.hpp"
#include "engine/decode/caged_program.hpp"

namespace raks::engine {
namespace {

constexpr Cage kCage{.more_memory = std::uint64_t{2} << 30U, .seconds = 300};
constexpr std::uint64_t kMostNotes = 10'000'000;

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
    return receive_all(kTalkSocket, std::as_writable_bytes(into), kNever) == Talk::good;
}

void answer(const Expected<std::span<const std::byte>>& made, bool is_caged) {
    static_cast<void>(send_answer(kTalkSocket, made, is_caged));
}

void play(audio::SoundfontPlayer& player,
          const Expected<std::vector<audio::SoundfontFile>>& files,
          bool is_caged) {
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
        answer(fail(loaded.error()), is_caged);
        return;
    }
    const std::vector<float> samples = piece.has_band != 0
                                           ? player.play(performance, piece.room, piece.band)
                                           : player.play(performance, piece.room);
    answer(std::as_bytes(std::span(samples)), is_caged);
}

}  // namespace
}  // namespace raks::engine

int main(int argc, char** argv) {
    using namespace raks::engine;
    const auto arguments = arguments_of_raks(argc, argv);
    if (!arguments) {
        std::fputs("raks-soundfont: is started by raks train, to play soundfonts; use raks train\n",
                   stderr);
        return kWrongUsage;
    }
    bool is_caged = true;  // before it is, nothing is read
    try {
        const auto files = open_files(arguments->words);
        raks::audio::SoundfontPlayer player;  // its settings look at the machine
        is_caged = enter_cage(*arguments, kCage);
        play(player, files, is_caged);
    } catch (const std::bad_alloc&) {
        answer(raks::fail("a soundfont takes more than 2 GiB to play"), is_caged);
    } catch (const std::exception& problem) {
        answer(raks::fail(problem.what()), is_caged);
    }
    // What a soundfont has broken need not be taken down in order.
    _exit(0);
}
