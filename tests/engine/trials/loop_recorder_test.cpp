#include "engine/trials/loop_recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"
#include "engine/trials/shown_landing.hpp"

namespace raks::engine {
namespace {

constexpr SampleRate kSampleRate(48'000);
constexpr std::int64_t kBlock = 256;
constexpr HostTime kStart{std::chrono::seconds(100)};
constexpr Nanos kInputLatency = std::chrono::milliseconds(2);
// As JACK's inputs say it: the block's length less the latency of its first sample.
constexpr Nanos kHeardAfter = kSampleRate.time_of(kBlock).time_since_epoch() - kInputLatency;

audio::GeneratedMusic music() {
    audio::MusicPlan plan;
    plan.style = audio::Style::drums;
    plan.tempo = {{0.0, 150.0}};
    plan.seconds = 12.0;
    plan.first_beat_seconds = 1.0;
    return audio::generate(plan).value();
}

/// The music as it comes back `delay` frames late; every tenth block is 5 ms late, and from
/// `lost_from` on (frames) all are, by `lost`: the device stood still for so long.
LoopRecording looped(const audio::GeneratedMusic& piece,
                     std::int64_t delay,
                     float gain,
                     std::int64_t lost_from = 1'000'000'000,
                     Nanos lost = {}) {
    std::vector<float> samples(static_cast<std::size_t>(delay), 0.0F);
    for (std::size_t i = 0; i < piece.samples.size(); i += 2) {
        samples.push_back(gain * piece.samples[i]);
    }
    constexpr CounterRandom kLateness(3);
    std::vector<BlockClock::Mark> blocks;
    for (std::int64_t frame = 0; frame < std::ssize(samples); frame += kBlock) {
        const auto number = static_cast<std::uint64_t>(frame / kBlock);
        const Nanos late = number % 10 == 0 ? std::chrono::milliseconds(5)
                                            : nanos_from_seconds(5e-5 * kLateness.uniform(number));
        // Behind the block's last sample, which came a block after its first.
        blocks.push_back({frame + kBlock,
                          kStart + kHeardAfter + kSampleRate.time_of(frame).time_since_epoch() +
                              late + (frame >= lost_from ? lost : Nanos{})});
    }
    return {BlockClock(kSampleRate, std::move(blocks)), std::move(samples)};
}

HostTime truth(const audio::GeneratedMusic& piece, std::size_t beat, std::int64_t delay) {
    const std::int64_t frame = kSampleRate.index_at(piece.beats[beat].time) + delay;
    return kStart + kSampleRate.time_of(frame).time_since_epoch() - kInputLatency;
}

TEST(ExcerptBeats, are_found_to_the_sample_and_dated_by_the_blocks_that_were_not_late) {
    const auto piece = music();
    for (const std::int64_t delay : {0, 1, 256, 12'345}) {
        const auto heard = audible_beats(looped(piece, delay, 0.3F), piece);
        ASSERT_GE(heard.size(), piece.beats.size() - 1) << delay;
        for (const AudibleBeat& beat : heard) {
            // The median of lateness within 50 us; one sample is 21 us.
            EXPECT_NEAR(to_seconds(beat.heard - truth(piece, beat.beat, delay)), 5e-5, 6e-5);
        }
    }
}

TEST(ExcerptBeats, follow_a_device_that_stood_still_for_30_ms) {
    const auto piece = music();
    constexpr Nanos kLost = std::chrono::milliseconds(30);
    const auto heard = audible_beats(looped(piece, 256, 1.0F, 6 * 48'000, kLost), piece);
    ASSERT_GE(heard.size(), piece.beats.size() - 1);
    EXPECT_NEAR(to_seconds(heard.front().heard - truth(piece, heard.front().beat, 256)), 0.0, 1e-4);
    EXPECT_NEAR(
        to_seconds(heard.back().heard - truth(piece, heard.back().beat, 256) - kLost), 0.0, 1e-4);
}

TEST(ExcerptBeats, are_none_in_silence_in_noise_and_at_another_rate) {
    const auto piece = music();
    EXPECT_TRUE(audible_beats(looped(piece, 256, 0.0F), piece).empty());

    constexpr CounterRandom kNoise(5);
    std::vector<float> noise(10 * 48'000);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        noise[i] = static_cast<float>(kNoise.uniform(i) - 0.5);
    }
    EXPECT_TRUE(
        audible_beats(LoopRecording(BlockClock(kSampleRate, {{0, kStart}}), noise), piece).empty());
    EXPECT_TRUE(
        audible_beats(LoopRecording(BlockClock(SampleRate(44'100), {{0, kStart}}), noise), piece)
            .empty());
}

TEST(SoundLine, turns_host_time_into_music_and_back) {
    const auto piece = music();
    const auto heard = audible_beats(looped(piece, 256, 1.0F), piece);
    ASSERT_GE(heard.size(), 2U);
    const SoundLine sound(heard, piece);
    for (double seconds = 0.5; seconds < 13.0; seconds += 0.37) {
        EXPECT_NEAR(sound.stream_seconds_at(sound.host_at(seconds)), seconds, 1e-6);
    }
    EXPECT_TRUE(sound.covers(heard[3].heard));
    EXPECT_FALSE(sound.covers(kStart - std::chrono::seconds(1)));
}

TEST(PictureLeads, say_by_how_much_an_assumed_latency_is_wrong) {
    const auto piece = music();
    const auto heard = audible_beats(looped(piece, 256, 1.0F), piece);
    ASSERT_GE(heard.size(), 2U);
    const SoundLine sound(heard, piece);
    // The graph's clock: handed over at kStart; 20 ms are assumed, the truth is 256 frames - 2 ms.
    const engine::ClockLine clock{StreamTime{}, kStart, 1.0, true};
    std::vector<ShownPicture> pictures;
    for (double t = 2.0; t < 10.0; t += 1.0 / 60.0) {
        const HostTime at = kStart + nanos_from_seconds(t);
        pictures.push_back({at,
                            clock.stream_at(at) - std::chrono::milliseconds(20),
                            clock,
                            true,
                            1.0,
                            0,
                            motion::Pose{}});
    }
    const double truth_ms = 1e3 * 256.0 / 48'000.0 - 2.0;
    for (const double lead : picture_leads_ms(pictures, sound)) {
        EXPECT_NEAR(lead, truth_ms - 20.0, 0.15);
    }
    for (const double latency : loop_latencies_ms(heard, piece, pictures)) {
        EXPECT_NEAR(latency, truth_ms, 0.15);
    }
}

}  // namespace
}  // namespace raks::engine
