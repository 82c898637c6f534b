#include "engine/trials/danced_figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace raks::engine {
namespace {

using motion::DancerStatus;
using motion::FigureModel;

/// What danced_figures returns points into it.
const std::vector<FigureModel>& models() {
    static std::vector<FigureModel> models(2);
    models[0].name = "basic";
    models[0].beats = 8;
    models[1].name = "turn";
    models[1].beats = 4;
    return models;
}

/// Beats of a steady 120 BPM from 0 s on.
std::vector<audio::ReferenceBeat> steady_beats(std::size_t count) {
    std::vector<audio::ReferenceBeat> beats(count);
    for (std::size_t i = 0; i < count; ++i) {
        beats[i].time = stream_time_from_seconds(0.5 * static_cast<double>(i));
    }
    return beats;
}

DancerStatus status_of(const std::string& figure, double phase, double octave = 1.0) {
    DancerStatus status;
    std::copy(figure.begin(), figure.end(), status.figure.begin());
    status.is_dancing = true;
    status.phase = phase;
    status.count = static_cast<int>(phase) + 1;
    status.octave = octave;
    status.rate = 2.0 * octave;
    return status;
}

/// Dances `figure` from hop 200 (beat 4) to `last`, `late` beats behind the music.
std::vector<DancerStatus> dancing(std::size_t last, double late, double octave = 1.0) {
    std::vector<DancerStatus> hops(200);
    for (std::size_t h = 200; h < last; ++h) {
        const double danced = octave * 2.0 * static_cast<double>(h - 200) / 100.0 - late + 8.0;
        hops.push_back(status_of("basic", std::fmod(danced, 8.0), octave));
    }
    return hops;
}

TEST(DancedFigures, hear_their_counts_in_the_music_however_late_the_dancer_is) {
    for (const double late : {-0.3, 0.0, 0.4}) {
        const auto found = danced_figures(dancing(1400, late), steady_beats(60), models());
        ASSERT_GE(found.size(), 2U) << late;
        const auto whole = std::find_if(
            found.begin(), found.end(), [](const auto& figure) { return figure.is_whole; });
        ASSERT_NE(whole, found.end()) << late;
        ASSERT_EQ(whole->count_times.size(), 9U);
        for (std::size_t k = 0; k < 9; ++k) {
            const double from_first = whole->count_times[k] - 2.0;
            EXPECT_NEAR(
                std::fmod(from_first, 4.0), std::fmod(0.5 * static_cast<double>(k), 4.0), 1e-6)
                << late << ' ' << k;
        }
    }
}

TEST(DancedFigures, at_half_the_tempo_have_a_count_on_every_second_beat) {
    const auto found = danced_figures(dancing(1400, 0.0, 0.5), steady_beats(60), models());
    ASSERT_FALSE(found.empty());
    const DancedFigure& figure = found.front();
    EXPECT_EQ(figure.octave, 0.5);
    ASSERT_EQ(figure.count_times.size(), 9U);
    EXPECT_NEAR(figure.count_times[0], 2.0, 1e-6);
    EXPECT_NEAR(figure.count_times[1], 3.0, 1e-6);
    EXPECT_NEAR(figure.count_times[8], 10.0, 1e-6);
}

TEST(DancedFigures, change_with_the_name_and_with_a_new_anchor) {
    std::vector<DancerStatus> hops = dancing(600, 0.0);
    for (std::size_t h = 600; h < 800; ++h) {
        hops.push_back(status_of("turn", 2.0 * static_cast<double>(h - 600) / 100.0));
    }
    for (std::size_t h = 800; h < 900; ++h) {
        hops.push_back(status_of("turn", 1.0 + 2.0 * static_cast<double>(h - 800) / 100.0));
        hops.back().reanchors = 1;
    }
    const auto found = danced_figures(hops, steady_beats(60), models());
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].model->name, "basic");
    EXPECT_TRUE(found[0].is_whole);
    EXPECT_EQ(found[1].model->name, "turn");
    EXPECT_TRUE(found[1].is_whole);
    EXPECT_NEAR(found[1].count_times[0], 6.0, 1e-6);
    EXPECT_FALSE(found[2].is_whole);
    EXPECT_NEAR(found[2].count_times[1], 8.0, 1e-6) << "set anew on count 2 at 8 s";
    EXPECT_EQ(found[2].dance_from, 2.0) << "one dance";
}

// Pieces of one take: beats 2 and 3, then beats 6 and 7.
TEST(DancedFigures, of_a_dance_of_cells_are_pieces_of_takes_with_their_own_counts) {
    std::vector<DancerStatus> hops(200);
    for (std::size_t h = 0; h < 200; ++h) {
        const bool is_second = h >= 100;
        // The dancer is 20 ms late: the second piece begins after its beat.
        const double beats = 2.0 * (static_cast<double>(h % 100) / 100.0 - 0.02);
        hops.push_back(status_of("basic", beats + (is_second ? 6.0 : 2.0)));
        hops.back().number = is_second ? 1 : 0;
    }
    const auto found = danced_figures(hops, steady_beats(60), models());
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(found[0].count_times[2], 2.0, 1e-6);
    EXPECT_NEAR(found[1].count_times[6], 3.0, 1e-6);
    std::vector<std::size_t> counts;
    for (const motion::AudibleCount& count : audible_counts(found, {.blend_in = 0.0})) {
        counts.push_back(count.count);
    }
    EXPECT_EQ(counts, (std::vector<std::size_t>{2, 3, 6, 7}));
}

TEST(DancedFigures, tell_on_which_side_they_are_danced) {
    std::vector<DancerStatus> hops = dancing(600, 0.0);
    for (DancerStatus& status : hops) {
        status.is_mirrored = true;
    }
    const auto found = danced_figures(hops, steady_beats(60), models());
    ASSERT_FALSE(found.empty());
    EXPECT_TRUE(found[0].is_mirrored);
    const auto counts = audible_counts(found, {.blend_in = 0.0});
    ASSERT_FALSE(counts.empty());
    EXPECT_TRUE(counts[0].is_mirrored);
}

TEST(DancedFigures, of_a_name_that_no_model_has_are_left_out) {
    std::vector<DancerStatus> hops(800, status_of("waltz", 1.0));
    EXPECT_TRUE(danced_figures(hops, steady_beats(60), models()).empty());
    EXPECT_TRUE(danced_figures({}, steady_beats(60), models()).empty());
    EXPECT_TRUE(danced_figures(dancing(1000, 0.0), {}, models()).empty());
}

TEST(AudibleCounts, are_those_danced_to_and_sounding) {
    auto beats = steady_beats(60);
    for (std::size_t i = 20; i < 24; ++i) {
        beats[i].is_audible = false;  // 10 s to 12 s
    }
    const auto figures = danced_figures(dancing(2000, 0.0), beats, models());
    const auto counts = audible_counts(figures);
    ASSERT_FALSE(counts.empty());
    EXPECT_NEAR(counts.front().time, 6.0, 1e-6) << "4 s after the start";
    EXPECT_EQ(counts.front().count, 0U);
    EXPECT_NEAR(counts.front().beat, 0.5, 1e-9);
    for (std::size_t i = 0; i < counts.size(); ++i) {
        EXPECT_TRUE(counts[i].time < 9.9 || counts[i].time > 11.9) << counts[i].time;
        EXPECT_LT(counts[i].time, 20.0 - 0.3);
        EXPECT_NEAR(static_cast<double>(counts[i].count),
                    std::fmod((counts[i].time - 2.0) * 2.0, 8.0),
                    1e-6);
        EXPECT_TRUE(i == 0 || counts[i].time > counts[i - 1].time + 0.4) << "each once";
    }
    for (const motion::AudibleCount& count : audible_counts(figures, {.from = 7.0, .to = 9.0})) {
        EXPECT_TRUE(count.time >= 7.0 && count.time < 9.0);
    }
}

}  // namespace
}  // namespace raks::engine
