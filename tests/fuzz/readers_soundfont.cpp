// What is done with soundfonts: loaded and played as raks-soundfont does it, but in this process
// and without a cage.
#include <algorithm>
#include <cmath>
#include <string>

#include "audio/music/instruments/soundfont_player.hpp"
#include "tests/fuzz/memory_file.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

bool read_soundfont(std::string_view bytes) {
    const MemoryFile file(bytes);
    audio::SoundfontPlayer player;
    const audio::SoundfontFile soundfont{.name = "x", .descriptor = file.descriptor()};
    if (const auto loaded = player.load({&soundfont, 1}); !loaded) {
        must_be_one_line(loaded.error().message);
        return false;
    }
    audio::Performance performance;
    performance.notes = {{.time = 0.0, .length = 0.1, .channel = 0, .key = 60},
                         {.time = 0.1, .length = 0.1, .channel = audio::kDrumChannel, .key = 36}};
    performance.seconds = 0.3;
    const auto samples = player.play(performance, {});
    must(samples.size() == static_cast<std::size_t>(0.3 * audio::kPerformanceRate));
    return true;
}

}  // namespace raks::fuzz
