// What the analysis costs, in instructions: 20 s of montuno, fast music with all instruments.
#include <gtest/gtest.h>

#include "audio/music_analyzer.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/instruction_count.hpp"

namespace raks::audio {
namespace {

constexpr double kSeconds = 20.0;
constexpr const char* kProcess = "raks::audio::MusicAnalyzer::process*";

void analyze(const AnalyzerConfig& config) {
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(config));
    test::Collect collect;
    const GeneratedMusic piece = test::music(Style::montuno, {{0.0, 184.0}}, kSeconds);
    // 10 ms at a time.
    for (std::size_t at = 0; at + 480 <= piece.samples.size(); at += 480) {
        analyzer.process(std::span(piece.samples).subspan(at, 480), collect);
    }
    EXPECT_NEAR(static_cast<double>(collect.states.size()), kSeconds * kHopsPerSecond, 2.0);
}

// What the other tests run under callgrind.
TEST(AnalyzerCost, DISABLED_without_genre) {
    AnalyzerConfig config = test::as_shipped();
    config.genre_model = nullptr;
    analyze(config);
}
TEST(AnalyzerCost, DISABLED_with_genre) { analyze(test::as_shipped()); }

TEST(AnalyzerCost, without_genre_is_under_40_million_instructions_a_second) {
    if (const std::string reason = raks::test::no_instruction_count(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const long long instructions =
        raks::test::instructions_in(kProcess, "AnalyzerCost.DISABLED_without_genre");
    EXPECT_LT(instructions, 800'000'000);
    EXPECT_GT(instructions, 100'000'000) << "was it counted?";
}

TEST(AnalyzerCost, with_genre_is_under_50_million_instructions_a_second) {
    if (const std::string reason = raks::test::no_instruction_count(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const long long instructions =
        raks::test::instructions_in(kProcess, "AnalyzerCost.DISABLED_with_genre");
    EXPECT_LT(instructions, 1'000'000'000);
    EXPECT_GT(instructions, 100'000'000) << "was it counted?";
}

}  // namespace
}  // namespace raks::audio
