// What is done with sound files: decoded as raks-decode does it, but in this process and without a
// cage, with seeks in between.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "audio/io/decoders.hpp"
#include "audio/io/piped_sound.hpp"
#include "base/random.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

constexpr double kHeardSeconds = 2.0;  // from the start
constexpr std::size_t kChunkFrames = 1024;
constexpr std::size_t kMostSeeks = 6;
constexpr std::size_t kChunksAfterSeek = 4;
constexpr Nanos kLongestWait = std::chrono::seconds(1);  // for a pipe's head

// FNV-1a: what is done with a file follows from its bytes.
std::uint64_t hash_of(std::string_view bytes) {
    std::uint64_t hash = 0xcbf2'9ce4'8422'2325U;
    for (const char byte : bytes) {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100'0000'01b3U;
    }
    return hash;
}

// One file that was opened.
class Listener {
 public:
    explicit Listener(audio::AudioFileReader& reader)
        : reader_(reader), chunk_(kChunkFrames * channels()) {
        must(reader.info().rate.is_supported());
        must(reader.info().channels >= 1 && reader.info().channels <= audio::kMaxFileChannels);
        must_be_one_line(reader.info().format);
    }

    /// Reads so many frames or all; returns how many.
    std::size_t hear(std::size_t frames) {
        std::size_t done = 0;
        while (done < frames) {
            const std::size_t got = reader_.read(chunk_);
            must(got <= kChunkFrames);
            if (got == 0) {
                break;
            }
            done += got;
        }
        must_be_one_line(reader_.warning());
        return done;
    }
    void hear_the_start() {
        heard_ = hear(static_cast<std::size_t>(kHeardSeconds * reader_.info().rate.hertz()));
    }
    /// Seeks back and forth, as keys and sliders do. A seek that fails is one line.
    void seek_about(const CounterRandom& random) {
        std::uint64_t draw = 0;
        const std::size_t seeks = 1 + random.below(draw++, kMostSeeks);
        for (std::size_t i = 0; i < seeks; ++i) {
            const std::int64_t frame = place(random.below(draw, 8), random.below(draw + 1, 1000));
            draw += 2;
            if (const auto sought = reader_.seek(frame); !sought) {
                must_be_one_line(sought.error().message);
            }
            hear(kChunksAfterSeek * kChunkFrames);
        }
    }

 private:
    [[nodiscard]] std::size_t channels() const {
        return static_cast<std::size_t>(std::max(reader_.info().channels, 1));
    }
    /// Mostly within the sound, else at its end, behind it, or where no file reaches.
    [[nodiscard]] std::int64_t place(std::size_t kind, std::size_t thousandth) const {
        const auto heard = static_cast<std::int64_t>(heard_);
        switch (kind) {
            case 0:
                return 0;
            case 1:
                return heard;
            case 2:
                return heard + static_cast<std::int64_t>(thousandth) * 1000;
            case 3:
                return std::numeric_limits<std::int64_t>::max() >> (thousandth % 32);
            default:
                return heard * static_cast<std::int64_t>(thousandth) / 1000;
        }
    }

    audio::AudioFileReader& reader_;
    std::vector<float> chunk_;
    std::size_t heard_ = 0;
};

// True: it could be opened.
bool listen_to(Expected<std::unique_ptr<audio::AudioFileReader>> reader, std::uint64_t seed) {
    if (!reader) {
        must_be_one_line(reader.error().message);
        return false;
    }
    Listener listener(**reader);
    listener.hear_the_start();
    listener.seek_about(CounterRandom(seed));
    return true;
}

}  // namespace

bool read_sound(std::string_view bytes) {
    const MemoryFile file(bytes);
    const std::uint64_t seed = hash_of(bytes);
    const auto window = audio::FileWindow::adopt(dup(file.descriptor()), "x");
    must(window.has_value());
    const bool is_good = listen_to(audio::open_by_decoders("x", *window), seed);
    // Some as from a pipe, which has no seeks.
    if (seed % 4 == 0) {
        static_cast<void>(listen_to(
            audio::PipedSound::open(
                {.name = "x", .descriptor = file.descriptor(), .longest_wait = kLongestWait}),
            seed));
    }
    return is_good;
}

}  // namespace raks::fuzz
