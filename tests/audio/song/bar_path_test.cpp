#include "audio/song/bar_path.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.hpp"

namespace raks::audio {
namespace {

// Beats whose every `metre`-th from `first` on looks like a downbeat.
std::vector<BarLikelihood> counted(int metre, int first, int beats) {
    std::vector<BarLikelihood> likelihoods;
    for (int i = 0; i < beats; ++i) {
        const bool is_first = (i - first) % metre == 0;
        likelihoods.push_back(BarLikelihood::of_downbeat(is_first ? 0.9F : 0.05F));
    }
    return likelihoods;
}

TEST(BarPath, counts_from_the_first_beat_on) {
    for (const int metre : {3, 4}) {
        const auto bars = find_bars(counted(metre, 2, 40));
        for (int i = 0; i < 40; ++i) {
            const BarPlace& place = bars[static_cast<std::size_t>(i)];
            EXPECT_EQ(place.beats_per_bar, metre) << i;
            EXPECT_EQ(place.position, (i + metre - 2 % metre) % metre) << metre << " " << i;
        }
    }
}

TEST(BarPath, the_metre_changes_where_the_music_changes_it) {
    auto beats = counted(4, 0, 40);
    const auto waltz = counted(3, 0, 42);
    beats.insert(beats.end(), waltz.begin(), waltz.end());
    const auto bars = find_bars(beats);
    EXPECT_EQ(bars[38].beats_per_bar, 4);
    EXPECT_EQ(bars[40].beats_per_bar, 3);
    EXPECT_EQ(bars[40].position, 0);
}

TEST(BarPath, no_beats_have_no_bars) { EXPECT_TRUE(find_bars({}).empty()); }

// ln probability of a row of places, as BarBelief's model has it.
double score_of(const std::vector<BarPlace>& row, const std::vector<BarLikelihood>& beats) {
    double score = 0.0;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const double prior =
            static_cast<double>(BarModel::prior_of(row[i].beats_per_bar)) / row[i].beats_per_bar;
        double way = prior;
        if (i > 0) {
            const BarPlace& from = row[i - 1];
            const bool is_same = from.beats_per_bar == row[i].beats_per_bar;
            double follows = 0.0;
            if (from.position + 1 < from.beats_per_bar) {
                follows = is_same && row[i].position == from.position + 1 ? 1.0 : 0.0;
            } else if (row[i].position == 0) {
                follows = (is_same ? 0.98 : 0.0) +
                          0.02 * static_cast<double>(BarModel::prior_of(row[i].beats_per_bar));
            }
            way = 0.997 * follows + 0.003 * prior;
        }
        score += std::log(way) +
                 std::log(static_cast<double>(beats[i].of(row[i].beats_per_bar, row[i].position)));
    }
    return score;
}

TEST(BarPath, is_the_best_of_all_rows) {
    std::vector<BarPlace> places;
    for (const int metre : BarModel::kMetres) {
        for (int position = 0; position < metre; ++position) {
            places.push_back({metre, position});
        }
    }
    const CounterRandom random(7);
    std::vector<BarLikelihood> beats;
    for (std::uint64_t i = 0; i < 4; ++i) {
        beats.push_back({static_cast<float>(0.1 + random.uniform(3 * i)),
                         static_cast<float>(0.1 + random.uniform(3 * i + 1)),
                         static_cast<float>(0.1 + random.uniform(3 * i + 2))});
    }
    double best = -1e300;
    std::vector<BarPlace> row(4);
    for (std::size_t number = 0; number < 15U * 15U * 15U * 15U; ++number) {
        std::size_t rest = number;
        for (BarPlace& place : row) {
            place = places[rest % 15];
            rest /= 15;
        }
        best = std::max(best, score_of(row, beats));
    }
    EXPECT_NEAR(score_of(find_bars(beats), beats), best, 1e-6);
}

}  // namespace
}  // namespace raks::audio
