// Long runs; label soak: `ctest -L soak`.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>

#include "tests/audio/listen.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::test {
namespace {

class Soak : public ProgramTest {};

/// A 16-bit mono WAV at 8 kHz of ten hours of silence: a sparse file.
void write_ten_hours(const std::filesystem::path& path) {
    constexpr std::uint32_t kBytes = 36'000U * 8'000U * 2U;
    std::string head(
        "RIFF\0\0\0\0WAVEfmt "
        "\x10\0\0\0\x01\0\x01\0\x40\x1f\0\0\x80\x3e\0\0\x02\0\x10\0data\0\0\0\0",
        44);
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) {
            head[at + i] = static_cast<char>((value >> (8 * i)) & 0xFFU);
        }
    };
    put(4, kBytes + 36);
    put(40, kBytes);
    std::ofstream(path, std::ios::binary).write(head.data(), 44);
    std::filesystem::resize_file(path, kBytes + 44ULL);
}

TEST_F(Soak, ten_hours_are_analyzed_in_bounded_memory) {
    write_ten_hours(folder_ / "long.wav");
    ProcessPlan plan = this->plan({"analyze", path("long.wav")});
    plan.address_space_limit = 600L << 20U;
    plan.timeout = std::chrono::seconds(1500);
    const ProcessResult result = run_process(plan);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("36000.0 s"), std::string::npos) << result.out;
}

/// Keeps the beats of a stretch, so that hours need no memory.
class KeepStretch final : public audio::MusicAnalyzer::Sink {
 public:
    KeepStretch() { states.reserve(70'000); }
    void on_state(const MusicState& state) noexcept override {
        if (state.time >= from && state.has_beat && states.size() < states.capacity()) {
            states.push_back(state);
        }
    }
    StreamTime from = StreamTime::max();
    std::vector<MusicState> states;
};

TEST(BeatSoak, six_hours_of_music_do_not_drift_or_allocate) {
    constexpr int kLoops = 36;
    constexpr double kSeconds = 600.0;  // 450 bars at 180 BPM: it loops without a seam in the beat
    const audio::GeneratedMusic piece =
        audio::test::music(audio::Style::montuno, {{0.0, 180.0}}, kSeconds, 32'000);
    audio::MusicAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(audio::test::as_shipped(piece.rate)));
    KeepStretch keep;
    for (int loop = 0; loop < kLoops; ++loop) {
        const double start = loop * kSeconds;
        keep.from = loop + 1 == kLoops ? stream_time_from_seconds(start) : StreamTime::max();
        RealtimeScope scope;
        analyzer.process(piece.samples, keep);
        ASSERT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    }
    std::vector<audio::ReferenceBeat> beats = piece.beats;
    for (audio::ReferenceBeat& beat : beats) {
        beat.time += nanos_from_seconds((kLoops - 1) * kSeconds);
    }
    const double from = (kLoops - 1) * kSeconds + 10.0;
    const auto score = audio::test::score_beats(keep.states, beats, from, kLoops * kSeconds - 5.0);
    EXPECT_GE(score.f_measure, 0.98);
    EXPECT_LE(std::abs(score.median_error), 0.010);
}

}  // namespace
}  // namespace raks::test
