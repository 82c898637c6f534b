#include "audio/song/song_plan.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/audio/listen.hpp"
#include "tests/support/dances.hpp"

namespace raks::audio {
namespace {

SongPlan plan_of(std::span<const float> mono, SampleRate rate, std::size_t block = 1024) {
    SongAnalyzer analyzer;
    EXPECT_TRUE(analyzer.prepare(test::as_shipped(rate)));
    for (std::size_t at = 0; at < mono.size(); at += block) {
        analyzer.process(mono.subspan(at, std::min(block, mono.size() - at)));
    }
    return analyzer.finish();
}

const GeneratedMusic& salsa() {
    static const GeneratedMusic piece = test::music(Style::montuno, {{0.0, 180.0}}, 24.0);
    return piece;
}

const SongPlan& plan_of_salsa() {
    static const SongPlan plan = plan_of(salsa().mono(), salsa().rate);
    return plan;
}

TEST(SongPlan, has_a_state_for_each_hop_of_the_song) {
    const SongPlan& plan = plan_of_salsa();
    ASSERT_EQ(plan.states.size(), 2'400U);
    for (std::size_t i = 0; i < plan.states.size(); ++i) {
        ASSERT_EQ(plan.states[i].hop, static_cast<HopIndex>(i));
        ASSERT_TRUE(plan.states[i].ahead.is_known);
    }
}

// A field that is added to MusicState comes through the second pass as the stream has it.
TEST(SongPlan, rewrites_beats_form_and_dance_and_keeps_all_else_of_the_stream) {
    const std::vector<MusicState> stream = test::listen(salsa());
    const SongPlan& plan = plan_of_salsa();
    ASSERT_GT(stream.size(), 2'300U);
    for (std::size_t i = 0; i < std::min(stream.size(), plan.states.size()); ++i) {
        const MusicState& known = plan.states[i];
        MusicState wanted = stream[i];
        wanted.grid = known.grid;
        wanted.rival = known.rival;
        wanted.beat_parts = known.beat_parts;
        wanted.has_beat = known.has_beat;
        wanted.beat = known.beat;
        wanted.has_predicted = known.has_predicted;
        wanted.predicted = known.predicted;
        wanted.genre_log_probability = known.genre_log_probability;
        wanted.genre_class = known.genre_class;
        wanted.genre = known.genre;
        wanted.energy = known.energy;
        wanted.part = known.part;
        wanted.event = known.event;
        wanted.accent = known.accent;
        wanted.ahead = known.ahead;
        ASSERT_TRUE(known == wanted) << i;
    }
}

TEST(SongPlan, knows_every_beat_and_the_dance_from_the_first_hop_on) {
    const SongPlan& plan = plan_of_salsa();
    const test::BeatScore score = test::score_beats(plan.states, salsa().beats, 0.0, 24.0);
    EXPECT_GT(score.f_measure, 0.98);
    EXPECT_LT(std::abs(score.median_error), 0.010);
    EXPECT_LT(score.worst_error, 0.035);
    EXPECT_EQ(plan.states.front().genre, shipped::salsa);
    EXPECT_EQ(plan.states.front().grid.beats_per_bar, 4);
    EXPECT_NEAR(plan.states[20].grid.tempo.bpm(), 180.0, 2.0);
}

// Pieces one after the other, without a pause; where each begins in `begins`, in seconds, and the
// end behind.
struct Medley {
    std::vector<float> mono;
    std::vector<double> begins{0.0};
};
Medley medley(const std::vector<std::pair<Style, double>>& pieces) {
    Medley made;
    for (const auto& [style, bpm] : pieces) {
        const std::vector<float> mono = test::music(style, {{0.0, bpm}}, 30.0, 32'000).mono();
        made.mono.insert(made.mono.end(), mono.begin(), mono.end());
        made.begins.push_back(static_cast<double>(made.mono.size()) / 32'000.0);
    }
    return made;
}

// The dance that is shown in a part of a medley for most of its 20 to 90 %.
void expect_dance(const SongPlan& plan, const Medley& made, std::size_t part, DanceId dance) {
    const double from = made.begins[part];
    const double length = made.begins[part + 1] - from;
    const auto first = static_cast<std::size_t>((from + 0.2 * length) * kHopsPerSecond);
    const auto end = static_cast<std::size_t>((from + 0.9 * length) * kHopsPerSecond);
    for (std::size_t hop = first; hop < end; ++hop) {
        ASSERT_EQ(plan.states[hop].genre, dance)
            << "part " << part << " at " << static_cast<double>(hop) / kHopsPerSecond << " s";
    }
}

TEST(SongPlan, each_song_of_a_medley_has_its_own_dance) {
    const Medley made = medley({{Style::montuno, 184.0}, {Style::four_on_the_floor, 124.0}});
    const SongPlan plan = plan_of(made.mono, SampleRate(32'000));
    ASSERT_EQ(plan.sections.size(), 2U);
    EXPECT_NEAR(static_cast<double>(plan.sections[1].first_hop) / kHopsPerSecond, 30.0, 2.0);
    expect_dance(plan, made, 0, shipped::salsa);
    expect_dance(plan, made, 1, shipped::house);
}

TEST(SongPlan, a_waltz_between_songs_in_four_has_its_own_dance) {
    const Medley made =
        medley({{Style::montuno, 184.0}, {Style::oom_pah_pah, 150.0}, {Style::montuno, 184.0}});
    const SongPlan plan = plan_of(made.mono, SampleRate(32'000));
    ASSERT_EQ(plan.sections.size(), 3U);
    expect_dance(plan, made, 0, shipped::salsa);
    expect_dance(plan, made, 1, shipped::waltz);
    expect_dance(plan, made, 2, shipped::salsa);
}

TEST(SongPlan, a_single_song_stays_one_dance) {
    for (const auto& [style, bpm] : {std::pair(Style::montuno, 184.0),
                                     std::pair(Style::four_on_the_floor, 124.0),
                                     std::pair(Style::oom_pah_pah, 150.0)}) {
        const SongPlan plan =
            plan_of(test::music(style, {{0.0, bpm}}, 75.0, 32'000).mono(), SampleRate(32'000));
        EXPECT_EQ(plan.sections.size(), 1U) << static_cast<int>(style);
    }
}

TEST(SongPlan, begins_on_a_downbeat_of_the_first_bar_and_ends_with_the_music) {
    std::vector<float> mono(3 * 48'000);  // silence before it
    const std::vector<float> music = salsa().mono();
    mono.insert(mono.end(), music.begin(), music.end());
    mono.resize(mono.size() + 4 * 48'000);  // and after it
    const SongPlan plan = plan_of(mono, salsa().rate);
    const Foresight& ahead = plan.states.front().ahead;
    const double bar = 4.0 * 60.0 / 180.0;
    EXPECT_GE(to_seconds(ahead.begins), 2.9);
    EXPECT_LE(to_seconds(ahead.begins), 3.0 + bar);
    EXPECT_NEAR(to_seconds(ahead.ends), 27.0, bar);
    EXPECT_LT(plan.states[100].grid.confidence, 0.35F) << "nothing sounds yet";
    EXPECT_GT(plan.states[400].grid.confidence, 0.35F);
}

TEST(SongPlan, is_the_same_whatever_the_blocks) {
    const SongPlan other = plan_of(salsa().mono(), salsa().rate, 331);
    const SongPlan& plan = plan_of_salsa();
    ASSERT_EQ(other.beats.size(), plan.beats.size());
    for (std::size_t i = 0; i < plan.beats.size(); ++i) {
        ASSERT_EQ(other.beats[i].time, plan.beats[i].time);
        ASSERT_EQ(other.beats[i].place.position, plan.beats[i].place.position);
    }
    EXPECT_EQ(other.joins, plan.joins);
    EXPECT_TRUE(other.states == plan.states);
}

TEST(SongPlan, may_be_taken_over_at_bar_5_and_every_eighth_bar) {
    const SongPlan& plan = plan_of_salsa();
    const StreamTime begins = plan.states.front().ahead.begins;
    const double bar = 4.0 * 60.0 / 180.0;
    ASSERT_GE(plan.joins.size(), 3U);
    EXPECT_NEAR(to_seconds(plan.joins[0] - begins), 4.0 * bar, 0.05);
    EXPECT_NEAR(to_seconds(plan.joins[1] - begins), 7.0 * bar, 0.05);
    EXPECT_NEAR(to_seconds(plan.joins[2] - begins), 15.0 * bar, 0.05);
}

TEST(SongPlan, energy_is_that_of_the_bars_ahead) {
    const std::vector<float> music = salsa().mono();
    std::vector<float> mono = music;
    for (float& sample : mono) {
        sample *= 0.2F;  // -14 dB
    }
    mono.insert(mono.end(), music.begin(), music.end());
    const SongPlan plan = plan_of(mono, salsa().rate);
    EXPECT_LT(plan.states[1'000].ahead.energy, 0.4F);
    EXPECT_GT(plan.states[2'390].ahead.energy, 0.6F) << "before it is loud";
}

TEST(SongPlan, a_place_is_given_at_any_stream_time) {
    const SongPlan& plan = plan_of_salsa();
    const StreamTime place = time_of_hop(1'000) + std::chrono::milliseconds(3);
    const MusicState state = plan.at(place, 77);
    EXPECT_EQ(state.hop, 77);
    EXPECT_EQ(state.time, time_of_hop(77));
    const Nanos shift = state.time - place;
    EXPECT_EQ(state.audio_end - plan.states[1'000].audio_end, shift);
    EXPECT_EQ(state.ahead.ends - plan.states[1'000].ahead.ends, shift);
    EXPECT_NEAR(state.grid.beats_at(state.time).count(),
                plan.states[1'000].grid.beats_at(place).count(),
                1e-6);
    // Before and after the song its ends hold, and the grid goes on.
    EXPECT_FALSE(plan.at(time_of_hop(-100), 0).grid.tempo.bpm() <= 0.0);
    const MusicState after = plan.at(time_of_hop(2'500), 2'500);
    EXPECT_GT(after.grid.beats_at(after.time).count(),
              plan.states.back().grid.beats_at(plan.states.back().time).count() + 2.5);
}

TEST(SongPlan, no_sound_is_no_fault) {
    SongAnalyzer analyzer;
    ASSERT_TRUE(analyzer.prepare(test::as_shipped()));
    const SongPlan none = analyzer.finish();
    EXPECT_TRUE(none.states.empty());
    EXPECT_EQ(none.at(StreamTime{}, 5).hop, 0);
    const SongPlan silence = plan_of(std::vector<float>(96'000), SampleRate(48'000));
    ASSERT_EQ(silence.states.size(), 200U);
    EXPECT_LT(silence.states[100].grid.confidence, 0.1F);
    EXPECT_FALSE(silence.states[100].has_beat);
    const SongPlan instant = plan_of(std::vector<float>(7), SampleRate(48'000));
    EXPECT_EQ(instant.states.size(), 1U);
}

}  // namespace
}  // namespace raks::audio
