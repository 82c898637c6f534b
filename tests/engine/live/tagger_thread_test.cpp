#include "engine/live/tagger_thread.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <span>
#include <thread>
#include <vector>

#include "audio/genre/tagger_file.hpp"
#include "base/random.hpp"
#include "engine/live/analysis_stage.hpp"
#include "tests/engine/installed.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

std::shared_ptr<const audio::TaggerNetwork> tagger_weights() {
    static const auto network =
        audio::load_tagger(RAKS_SOURCE_DIR "/models/pretrained/msd_musicnn.tagger");
    EXPECT_TRUE(network) << network.error().message;
    return *network;
}

/// Hiss that comes and goes; each sample follows from its number.
audio::TaggerHop hissing(HopIndex hop) {
    const CounterRandom random(7);
    audio::TaggerHop made;
    made.hop = hop;
    for (std::size_t i = 0; i < made.samples.size(); ++i) {
        const auto at = static_cast<std::uint64_t>(hop) * made.samples.size() + i;
        const auto drawn = static_cast<float>(random.below(at, 2001)) - 1000.0F;
        made.samples[i] = drawn * (hop / 25 % 2 == 0 ? 2e-4F : 2e-5F);
    }
    return made;
}

/// Lets the thread work until it has said so many patches, or a minute has gone.
const audio::TaggerWord& wait_for(TaggerThread& tagger, std::uint32_t patches) {
    const HostTime end = host_now() + std::chrono::minutes(1);
    while (tagger.word().patches != patches && host_now() < end) {
        std::this_thread::yield();
    }
    return tagger.word();
}

TEST(TaggerThread, says_the_same_as_the_tagger_and_never_lets_one_wait) {
    audio::HopTagger inline_tagger(tagger_weights());
    TaggerThread tagger(tagger_weights());
    EXPECT_EQ(tagger.word().patches, 0U);
    for (HopIndex hop = 0; hop < 310; ++hop) {
        const audio::TaggerHop made = hissing(hop);
        inline_tagger.hear(made);
        raks::test::RealtimeScope scope;
        tagger.hear(made);
        static_cast<void>(tagger.word());
        ASSERT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    }
    const audio::TaggerWord& word = wait_for(tagger, 1);
    EXPECT_EQ(word.patches, 1U);
    EXPECT_EQ(word.logits, inline_tagger.word().logits);
    EXPECT_EQ(word.embedding, inline_tagger.word().embedding);
    EXPECT_EQ(word.until, inline_tagger.word().until);
    EXPECT_EQ(tagger.dropped(), 0U);
}

TEST(TaggerThread, what_finds_no_room_is_dropped_and_it_goes_on) {
    TaggerThread tagger(tagger_weights());
    HopIndex hop = 0;
    for (; hop < 20'000; ++hop) {
        tagger.hear(hissing(0));  // as fast as it can be: nobody keeps up
    }
    EXPECT_GT(tagger.dropped(), 0U);
    // A jump that may have found no room is told all the same.
    audio::TaggerHop jump = hissing(hop++);
    jump.is_other_music = true;
    tagger.hear(jump);
    const HostTime end = host_now() + std::chrono::minutes(1);
    while (tagger.word().patches != 1 && host_now() < end) {
        tagger.hear(hissing(hop++));
        std::this_thread::yield();
    }
    EXPECT_EQ(tagger.word().patches, 1U);
}

TEST(TaggerThread, all_but_the_dance_is_as_without_it) {
    AnalyzerModels models = installed::models();
    std::vector<std::vector<MusicState>> all;
    for (const bool is_tagged : {false, true}) {
        models.tagger = is_tagged ? tagger_weights() : nullptr;
        auto analysis = AnalysisStage::create(SampleRate(16'000), models);
        ASSERT_TRUE(analysis) << analysis.error().message;
        std::vector<MusicState>& states = all.emplace_back();
        MusicState state;
        for (HopIndex hop = 0; hop < 500; ++hop) {
            (*analysis)->analyze(hissing(hop).samples);
            while ((*analysis)->states().pop(state)) {
                // What a tagger moves, if its first word comes in time.
                state.genre_log_probability = {};
                state.genre_class = 0;
                state.genre = DanceId::none;
                state.tags = {};
                states.push_back(state);
            }
        }
    }
    ASSERT_GT(all[0].size(), 400U);
    EXPECT_TRUE(all[0] == all[1]);
}

}  // namespace
}  // namespace raks::engine
