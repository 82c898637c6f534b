// Sound without a beat: none is announced with any confidence, live or of a song that is known.
#include "tests/audio/beatless_sound.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "audio/song/song_plan.hpp"
#include "tests/audio/listen.hpp"

namespace raks::audio {
namespace {

constexpr double kBeatlessSeconds = 25.0;
constexpr float kDoubtful = 0.3F;  // at most so sure

struct Beatless {
    std::string name;
    std::vector<float> mono;
};

void PrintTo(const Beatless& sound, std::ostream* out) { *out << sound.name; }

std::vector<float> constant(float value) {
    return std::vector<float>(static_cast<std::size_t>(kBeatlessSeconds * test::kBeatlessRate),
                              value);
}

std::vector<Beatless> beatless_sounds() {
    std::vector<Beatless> sounds = {
        {"silence", constant(0.0F)},
        {"offset", constant(0.5F)},
        {"white_noise", test::white_noise(kBeatlessSeconds, 0.1, 1)},
        {"quiet_white_noise", test::white_noise(kBeatlessSeconds, 0.003, 2)},
        {"pink_noise", test::pink_noise(kBeatlessSeconds, 0.1, 3)},
        {"quiet_pink_noise", test::pink_noise(kBeatlessSeconds, 0.003, 4)},
    };
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const std::string number = std::to_string(seed);
        sounds.push_back(
            {"rare_clicks_" + number, test::irregular_clicks(kBeatlessSeconds, 2.0, seed)});
        sounds.push_back({"clicks_" + number, test::irregular_clicks(kBeatlessSeconds, 6.0, seed)});
        sounds.push_back({"speech_" + number, test::speech(kBeatlessSeconds, seed)});
    }
    return sounds;
}

class BeatlessSound : public ::testing::TestWithParam<Beatless> {
 protected:
    static void expect_doubt(const std::vector<MusicState>& states) {
        int beats = 0;
        int sure = 0;
        float most = 0.0F;
        for (const MusicState& state : states) {
            if (state.has_beat) {
                ++beats;
                sure += state.beat.confidence > kDoubtful ? 1 : 0;
                most = std::max(most, state.beat.confidence);
            }
        }
        EXPECT_EQ(sure, 0) << "of " << beats << " beats, the surest " << most;
    }
};

TEST_P(BeatlessSound, has_no_beat_that_is_announced_with_confidence_live) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped(SampleRate(test::kBeatlessRate))));
    test::Collect collect;
    analyzer.process(GetParam().mono, collect);
    expect_doubt(collect.states);
}

TEST_P(BeatlessSound, has_no_beat_that_is_announced_with_confidence_known_ahead) {
    SongAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped(SampleRate(test::kBeatlessRate))));
    analyzer.process(GetParam().mono);
    expect_doubt(analyzer.finish().states);
}

INSTANTIATE_TEST_SUITE_P(Sounds,
                         BeatlessSound,
                         ::testing::ValuesIn(beatless_sounds()),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace raks::audio
