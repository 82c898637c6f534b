// What the analysis costs, in instructions: 10 s of montuno, fast music with all instruments.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "audio/music_analyzer.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/instruction_count.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

constexpr double kSeconds = 10.0;

// The samples of RAKS_TEST_FILE, 10 ms at a time.
void analyze(const AnalyzerConfig& config) {
    const char* const path = std::getenv("RAKS_TEST_FILE");  // NOLINT(concurrency-mt-unsafe)
    ASSERT_NE(path, nullptr) << "the other tests run this one";
    const auto bytes = read_file(path, std::size_t{1} << 24U);
    ASSERT_TRUE(bytes) << bytes.error().message;
    std::vector<float> samples(bytes->size() / sizeof(float));
    std::memcpy(samples.data(), bytes->data(), samples.size() * sizeof(float));
    MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(config));
    test::Collect collect;
    for (std::size_t at = 0; at + 480 <= samples.size(); at += 480) {
        analyzer.process(std::span(samples).subspan(at, 480), collect);
    }
    EXPECT_NEAR(static_cast<double>(collect.states.size()), kSeconds * kHopsPerSecond, 2.0);
}

// What the other tests run under callgrind, which would take as long again for making the music.
TEST(AnalyzerCost, DISABLED_without_genre) {
    AnalyzerConfig config = test::as_shipped();
    config.genre_model = nullptr;
    analyze(config);
}
TEST(AnalyzerCost, DISABLED_with_genre) { analyze(test::as_shipped()); }

long long instructions_of(const std::string& test) {
    const raks::test::TemporaryFolder folder;
    const std::string path = (folder / "music.raw").string();
    const GeneratedMusic piece = test::music(Style::montuno, {{0.0, 184.0}}, kSeconds);
    const auto* const bytes = reinterpret_cast<const char*>(piece.samples.data());
    EXPECT_TRUE(write_file(path, {bytes, piece.samples.size() * sizeof(float)}));
    return raks::test::instructions_in("raks::audio::MusicAnalyzer::process*", test, path);
}

TEST(AnalyzerCost, without_genre_is_under_60_million_instructions_a_second) {
    if (const std::string reason = raks::test::no_instruction_count(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const auto instructions =
        static_cast<double>(instructions_of("AnalyzerCost.DISABLED_without_genre"));
    EXPECT_LT(instructions, kSeconds * 60e6);
    EXPECT_GT(instructions, kSeconds * 5e6) << "was it counted?";
}

TEST(AnalyzerCost, with_genre_is_under_70_million_instructions_a_second) {
    if (const std::string reason = raks::test::no_instruction_count(); !reason.empty()) {
        GTEST_SKIP() << reason;
    }
    const auto instructions =
        static_cast<double>(instructions_of("AnalyzerCost.DISABLED_with_genre"));
    EXPECT_LT(instructions, kSeconds * 70e6);
    EXPECT_GT(instructions, kSeconds * 5e6) << "was it counted?";
}

}  // namespace
}  // namespace raks::audio
