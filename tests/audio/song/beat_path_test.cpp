#include "audio/song/beat_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/random.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kSecond = 100;  // hops

// Hops with an onset at each of these places, in hops.
std::vector<SongHop> clicks(const std::vector<double>& places, std::size_t hops) {
    std::vector<SongHop> song(hops);
    for (const double place : places) {
        const auto at = static_cast<std::size_t>(std::lround(place));
        if (at < hops) {
            song[at].onset_strength = 8.0F;
        }
    }
    return song;
}

std::vector<double> steady(double first, double period, double end) {
    std::vector<double> places;
    for (double place = first; place < end; place += period) {
        places.push_back(place);
    }
    return places;
}

// Largest distance of a place from the nearest beat.
double worst_miss(const std::vector<double>& places, const std::vector<PathBeat>& beats) {
    double worst = 0.0;
    for (const double place : places) {
        double nearest = 1e9;
        for (const PathBeat& beat : beats) {
            nearest = std::min(nearest, std::abs(beat.hop - place));
        }
        worst = std::max(worst, nearest);
    }
    return worst;
}

TEST(BeatPath, finds_every_click_from_the_first_on) {
    const std::vector<double> places = steady(30.0, 50.0, 20.0 * kSecond);
    const auto beats = find_beats(clicks(places, 20 * kSecond), PointerStates({}));
    EXPECT_LE(worst_miss(places, beats), 1.0);
    EXPECT_NEAR(static_cast<double>(beats.size()), static_cast<double>(places.size()), 1.0);
}

TEST(BeatPath, follows_a_tempo_that_falls_from_140_to_100) {
    std::vector<double> places;
    for (double place = 20.0, period = 60.0 / 1.4; place < 30.0 * kSecond; place += period) {
        places.push_back(place);
        period = std::min(60.0, period * 1.01);
    }
    const auto beats = find_beats(clicks(places, 30 * kSecond), PointerStates({}));
    EXPECT_LE(worst_miss(places, beats), 2.0);
}

TEST(BeatPath, another_song_is_found_from_its_first_beats_on) {
    std::vector<double> places = steady(10.0, 60.0, 15.0 * kSecond);
    const std::vector<double> second = steady(15.0 * kSecond + 23.0, 36.0, 30.0 * kSecond);
    places.insert(places.end(), second.begin(), second.end());
    const auto beats = find_beats(clicks(places, 30 * kSecond), PointerStates({}));
    EXPECT_LE(worst_miss(places, beats), 2.0);
}

TEST(BeatPath, beats_go_on_where_nothing_sounds) {
    std::vector<SongHop> song = clicks(steady(0.0, 50.0, 10.0 * kSecond), 16 * kSecond);
    for (std::size_t i = 10 * kSecond; i < song.size(); ++i) {
        song[i].is_blind = true;
    }
    const auto beats = find_beats(song, PointerStates({}));
    EXPECT_LE(worst_miss(steady(0.0, 50.0, 15.5 * kSecond), beats), 3.0);
}

TEST(BeatPath, no_hops_have_no_beats) { EXPECT_TRUE(find_beats({}, PointerStates({})).empty()); }

// All paths through a song of three tempi, one after the other.
class AllPaths {
 public:
    AllPaths(const PointerStates& states, const std::vector<SongHop>& song) : states_(states) {
        for (const SongHop& hop : song) {
            std::vector<float> likelihood(states.size(), 1.0F);
            states.weigh(likelihood, likelihood, 0.0F, hop.onset_strength, hop.evidence);
            likelihoods_.push_back(std::move(likelihood));
        }
    }

    [[nodiscard]] std::vector<double> best_beats() {
        for (std::size_t state = 0; state < states_.size(); ++state) {
            std::vector<double> beats;
            walk(0, state, std::log(static_cast<double>(states_.prior()[state])), beats);
        }
        return best_beats_;
    }

 private:
    void walk(std::size_t hop, std::size_t state, double score, std::vector<double> beats) {
        std::size_t tempo = 0;
        while (tempo + 1 < states_.tempi().size() && states_.tempi()[tempo + 1].state(0) <= state) {
            ++tempo;
        }
        const PointerStates::Tempo& here = states_.tempi()[tempo];
        if (state == here.state(0)) {
            beats.push_back(static_cast<double>(hop));
        }
        score += std::log(static_cast<double>(likelihoods_[hop][state]));
        if (hop + 1 == likelihoods_.size()) {
            if (score > best_score_) {
                best_score_ = score;
                best_beats_ = beats;
            }
        } else if (state != here.state(here.hops - 1)) {
            walk(hop + 1, state + 1, score, beats);
        } else {
            for (std::size_t to = 0; to < states_.tempi().size(); ++to) {
                const auto way = static_cast<double>(states_.transitions(tempo)[to]);
                if (way > 0.0) {
                    walk(hop + 1, states_.tempi()[to].state(0), score + std::log(way), beats);
                }
            }
        }
    }

    const PointerStates& states_;
    std::vector<std::vector<float>> likelihoods_;
    double best_score_ = -1e300;
    std::vector<double> best_beats_;
};

TEST(BeatPath, is_the_best_of_all_paths) {
    // Beats of 8, 9 and 10 hops; without a leak there are few enough paths to try them all.
    const PointerStates states({.lowest_bpm = 600.0,
                                .highest_bpm = 750.0,
                                .tempi = 3,
                                .stiffness = 5.0,
                                .leak = 0.0,
                                .centre_bpm = 660.0});
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
        const CounterRandom random(seed);
        std::vector<SongHop> song(36);
        for (std::size_t i = 0; i < song.size(); ++i) {
            song[i].has_evidence = true;
            song[i].onset_strength = static_cast<float>(3.0 * random.uniform(3 * i));
            song[i].evidence = {static_cast<float>(random.uniform(3 * i + 1)),
                                0.0F,
                                static_cast<float>(0.3 * random.uniform(3 * i + 2))};
        }
        std::vector<double> found;
        for (const PathBeat& beat : find_beats(song, states)) {
            if (beat.hop >= 0.0) {  // one may lie a little before the song
                found.push_back(beat.hop);
            }
        }
        EXPECT_EQ(found, AllPaths(states, song).best_beats()) << seed;
    }
}

TEST(SmoothBeats, takes_the_raster_out_of_a_steady_tempo) {
    std::vector<PathBeat> beats;
    const std::vector<double> places = steady(3.3, 43.7, 40.0 * kSecond);
    beats.reserve(places.size());
    for (const double place : places) {
        beats.push_back({std::round(place), false});
    }
    smooth_beats(beats);
    for (std::size_t i = 0; i < places.size(); ++i) {
        EXPECT_NEAR(beats[i].hop, places[i], 0.25) << i;  // of a hop of 10 ms
    }
}

TEST(SmoothBeats, keeps_rows_apart_that_do_not_follow_each_other) {
    std::vector<PathBeat> beats;
    for (const double place : steady(0.0, 50.0, 500.0)) {
        beats.push_back({place, false});
    }
    for (const double place : steady(520.0, 40.0, 1000.0)) {
        beats.push_back({place, place == 520.0});
    }
    const std::vector<PathBeat> before = beats;
    smooth_beats(beats);
    for (std::size_t i = 0; i < beats.size(); ++i) {
        EXPECT_NEAR(beats[i].hop, before[i].hop, 0.1) << i;
    }
}

}  // namespace
}  // namespace raks::audio
