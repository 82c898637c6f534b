#include "engine/offline/last_hops.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {
namespace {

class CountHops final : public audio::MusicAnalyzer::Sink {
 public:
    void on_state(const MusicState& state) noexcept override {
        newest = state.time;
        ++hops;
    }
    StreamTime newest{Nanos(-1)};
    int hops = 0;
};

TEST(LastHops, all_come_out_and_few_of_the_silence_behind_them) {
    for (const int hertz : {8'000, 44'100, 48'000}) {
        const SampleRate rate(hertz);
        auto analyzer = make_analyzer(rate, {nullptr, nullptr, nullptr}, audio::BeatMethod::paper);
        ASSERT_TRUE(analyzer) << analyzer.error().message;
        for (const int samples : {0, 1, hertz / 100, hertz, hertz + 7}) {
            analyzer->reset();
            CountHops count;
            analyzer->process(std::vector<float>(static_cast<std::size_t>(samples), 0.1F), count);
            const StreamTime end = rate.time_of(samples);
            bring_last_hops_out(*analyzer, rate, end, count);
            EXPECT_GE(count.newest + kHop, end) << hertz << ' ' << samples;
            EXPECT_LE(count.newest, end + 5 * kHop) << hertz << ' ' << samples;
            const int hops = count.hops;
            bring_last_hops_out(*analyzer, rate, end, count);
            EXPECT_EQ(count.hops, hops) << "nothing is left";
        }
    }
}

}  // namespace
}  // namespace raks::engine
