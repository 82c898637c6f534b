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
    count(lost.underruns, "wait for the file", "waits for the file");
    count(lost.dropped_states, "moment that was not danced", "moments that were not danced");
    return words;
}

}  // namespace raks::engine
