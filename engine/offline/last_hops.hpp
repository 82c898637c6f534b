#pragma once

#include <array>

#include "audio/music_analyzer.hpp"
#include "base/time.hpp"

namespace raks::engine {

/// Brings out the states of the last hops before `end`, where the samples of this rate have ended:
/// delay() of silence completes them; one hop more absorbs rounding. `sink.newest`: the time of the
/// state that it got last; it may get some beyond the end.
template <typename Sink>
void bring_last_hops_out(audio::MusicAnalyzer& analyzer,
                         SampleRate rate,
                         StreamTime end,
                         Sink& sink) {
    const std::array<float, 256> silence{};
    for (Nanos fed{}; fed <= analyzer.delay() + kHop && sink.newest + kHop < end;
         fed += rate.time_of(silence.size()).time_since_epoch()) {
        analyzer.process(silence, sink);
    }
}

}  // namespace raks::engine
