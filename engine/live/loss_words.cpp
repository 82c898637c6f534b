#include "engine/live/loss_words.hpp"

#include <cstdint>

#include <fmt/format.h>

namespace raks::engine {

std::string losses_in_words(const LiveCounters& lost) {
    std::string words;
    const auto count = [&](std::uint64_t number, const char* one, const char* many) {
        if (number > 0) {
            words +=
                fmt::format("{}{} {}", words.empty() ? "" : ", ", number, number == 1 ? one : many);
        }
    };
    count(lost.xruns, "gap in the sound", "gaps in the sound");
    count(lost.underruns, "pause to read the file", "pauses to read the file");
    count(lost.dropped_states, "moment that the dancers missed", "moments that the dancers missed");
    return words;
}

}  // namespace raks::engine
