#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/smooth_steps.hpp"
#include "motion/dance/baking/banded_system.hpp"
#include "motion/dance/baking/flight.hpp"
#include "motion/dance/baking/free_figure.hpp"
#include "motion/dance/baking/variation.hpp"
#include "motion/dance/body/curves.hpp"
#include "motion/dancer.hpp"
#include "motion/repertoire.hpp"
#include "tests/motion/dance/stage.hpp"

#include <glm/geometric.hpp>

namespace raks::motion {
namespace {

// A foot that rests for kRest samples, flies for kFlight, and rests again, on a closed curve.
constexpr std::size_t kRest = 40;
constexpr std::size_t kFlight = 60;
constexpr std::size_t kSize = 2 * (kRest + kFlight);

bool is_resting(std::size_t i) { return i % (kRest + kFlight) < kRest; }

std::vector<bool> resting() {
    std::vector<bool> rests(kSize);
    for (std::size_t i = 0; i < kSize; ++i) {
        rests[i] = is_resting(i);
    }
    return rests;
}

// The overload that has no ends.
float smoothly(float t) { return smootherstep(t); }

/// Share of the way to the far place, along x, by the share of a flight's time.
template <typename Way>
std::vector<glm::vec3> steps(const Way& way) {
    std::vector<glm::vec3> path(kSize);
    for (std::size_t i = 0; i < kSize; ++i) {
        const std::size_t k = i % (kRest + kFlight);
        const float t = is_resting(i)
                            ? 0.0F
                            : static_cast<float>(k - kRest + 1) / static_cast<float>(kFlight + 1);
        const float gone = way(t);
        path[i].x = i < kRest + kFlight ? gone : 1.0F - gone;
    }
    return path;
}

float largest_jerk(const std::vector<glm::vec3>& path) {
    float largest = 0.0F;
    for (std::size_t i = 0; i + 3 < path.size(); ++i) {
        largest = std::max(
            largest,
            std::abs(path[i + 3].x - 3.0F * path[i + 2].x + 3.0F * path[i + 1].x - path[i].x));
    }
    return largest;
}

TEST(Flight, takes_off_what_is_quick_and_leaves_rests_alone) {
    const auto wiggling = [](float t) {
        return smootherstep(t) + 0.02F * std::sin(100.0F * t) * smootherstep(4.0F * t * (1.0F - t));
    };
    const std::vector<glm::vec3> rough = steps(wiggling);
    std::vector<glm::vec3> path = rough;
    fly(resting(), 0.06, path);
    for (std::size_t i = 0; i < kSize; ++i) {
        if (is_resting(i)) {
            ASSERT_EQ(path[i], rough[i]) << i;
        }
    }
    EXPECT_LT(largest_jerk(path), 0.3F * largest_jerk(rough));
    const std::vector<glm::vec3> smooth = steps(smoothly);
    for (std::size_t i = 0; i < kSize; ++i) {
        ASSERT_NEAR(path[i].x, smooth[i].x, 0.03F) << i;
    }
}

TEST(Flight, keeps_the_path_of_one_reach) {
    const std::vector<glm::vec3> smooth = steps(smoothly);
    std::vector<glm::vec3> path = smooth;
    fly(resting(), 0.06, path);
    for (std::size_t i = 0; i < kSize; ++i) {
        ASSERT_NEAR(path[i].x, smooth[i].x, 2e-3F) << i;
    }
}

TEST(Flight, leaves_a_foot_that_never_rests) {
    const std::vector<glm::vec3> path = steps(smoothly);
    std::vector<glm::vec3> flown = path;
    fly(std::vector<bool>(kSize, false), 0.06, flown);
    EXPECT_EQ(flown, path);
}

std::vector<FootTarget> feet_on(const std::vector<glm::vec3>& path) {
    std::vector<FootTarget> feet(path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        feet[i].ankle = path[i];
    }
    return feet;
}

std::vector<PlannedContact> both_rests() {
    std::vector<PlannedContact> contacts(2);
    contacts[0].window = {0, kRest};
    contacts[1].window = {kRest + kFlight, kRest};
    contacts[0].is_mean = contacts[1].is_mean = true;
    return contacts;
}

/// Slowest step between two samples of the first flight but for its first and last fifth.
float slowest_on_the_way(const std::vector<FootTarget>& feet) {
    float slowest = 1.0F;
    for (std::size_t i = kRest + kFlight / 5; i < kRest + kFlight - kFlight / 5; ++i) {
        slowest = std::min(slowest, glm::distance(feet[i + 1].ankle, feet[i].ankle));
    }
    return slowest;
}

TEST(StepTiming, a_foot_that_halts_on_its_way_goes_on) {
    const auto halting = [](float t) {
        return 0.5F * smootherstep(2.0F * t) + 0.5F * smootherstep(2.0F * t - 1.0F);
    };
    const std::vector<FootTarget> feet = feet_on(steps(halting));
    ASSERT_LT(slowest_on_the_way(feet), 1e-3F);
    const std::vector<FootTarget> going = in_time(both_rests(), feet);
    EXPECT_GT(slowest_on_the_way(going), 0.3F / kFlight);
    EXPECT_EQ(going[kRest - 1].ankle, feet[kRest - 1].ankle);
    EXPECT_EQ(going[kRest + kFlight].ankle, feet[kRest + kFlight].ankle);
}

TEST(StepTiming, a_foot_that_goes_in_one_reach_keeps_its_time) {
    const std::vector<FootTarget> feet = feet_on(steps(smoothly));
    const std::vector<FootTarget> same = in_time(both_rests(), feet);
    for (std::size_t i = 0; i < kSize; ++i) {
        ASSERT_NEAR(same[i].ankle.x, feet[i].ankle.x, 1e-4F) << i;
    }
}

TEST(StepTiming, a_foot_that_slows_on_its_way_rises_once) {
    const auto slowing = [](float t) {
        return 0.7F * smootherstep(1.6F * t) + 0.3F * smootherstep(2.2F * t - 1.2F);
    };
    const std::vector<FootTarget> feet = feet_on(steps(slowing));
    // Samples of the first flight at which the foot is faster than just before, of those after its
    // fastest.
    const auto second_rises = [](const std::vector<FootTarget>& who) {
        std::vector<float> speeds;
        for (std::size_t i = kRest - 1; i < kRest + kFlight; ++i) {
            speeds.push_back(glm::distance(who[i + 1].ankle, who[i].ankle));
        }
        int rises = 0;
        for (auto at = std::max_element(speeds.begin(), speeds.end()); at + 1 != speeds.end();
             ++at) {
            rises += at[1] > at[0] + 1e-4F ? 1 : 0;
        }
        return rises;
    };
    ASSERT_GT(second_rises(feet), 5);
    const std::vector<FootTarget> even = rising_once(both_rests(), feet);
    EXPECT_EQ(second_rises(even), 0);
    EXPECT_EQ(even[kRest - 1].ankle, feet[kRest - 1].ankle);
    EXPECT_EQ(even[kRest + kFlight].ankle, feet[kRest + kFlight].ankle);
    std::vector<PlannedContact> as_learnt = both_rests();
    as_learnt[0].is_mean = as_learnt[1].is_mean = false;
    EXPECT_EQ(rising_once(as_learnt, feet)[kRest + kFlight / 2].ankle,
              feet[kRest + kFlight / 2].ankle);
}

TEST(StepTiming, a_step_that_comes_down_too_soon_waits) {
    const auto early = [](float t) { return smootherstep(1.4F * t); };
    std::vector<PlannedContact> contacts = both_rests();
    const std::vector<FootTarget> feet = feet_on(steps(early));
    const auto first_there = [](const std::vector<FootTarget>& who) {
        std::size_t i = kRest;
        while (who[i].ankle.x < 0.98F) {
            ++i;
        }
        return i;
    };
    const std::size_t soon = first_there(feet);
    contacts[1].arrival = static_cast<double>(soon);
    EXPECT_GT(first_there(in_time(contacts, feet)), soon + 5);
}

TEST(BandedSystem, solves_as_gaussian_elimination_does) {
    constexpr std::size_t kUnknowns = 9;
    BandedSystem<3> system(kUnknowns);
    double dense[kUnknowns][kUnknowns + 1] = {};
    const auto add = [&](std::ptrdiff_t first, const std::array<double, 4>& c, double w, double m) {
        system.add(first, c, w, m);
        for (std::size_t a = 0; a < c.size(); ++a) {
            const std::ptrdiff_t i = first + static_cast<std::ptrdiff_t>(a);
            if (i < 0 || i >= static_cast<std::ptrdiff_t>(kUnknowns)) {
                continue;
            }
            dense[i][kUnknowns] += w * m * c[a];
            for (std::size_t b = 0; b < c.size(); ++b) {
                const std::ptrdiff_t j = first + static_cast<std::ptrdiff_t>(b);
                if (j >= 0 && j < static_cast<std::ptrdiff_t>(kUnknowns)) {
                    dense[i][j] += w * c[a] * c[b];
                }
            }
        }
    };
    for (std::ptrdiff_t i = -3; i < static_cast<std::ptrdiff_t>(kUnknowns); ++i) {
        const auto x = static_cast<double>(i);
        add(i, {-1.0, 3.0, -3.0, 1.0}, 2.0 + std::sin(x), std::cos(2.0 * x));
        add(i, {1.0}, 0.5, x);
    }
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        for (std::size_t r = 0; r < kUnknowns; ++r) {
            const double factor = r == i ? 0.0 : dense[r][i] / dense[i][i];
            for (std::size_t c = i; c <= kUnknowns; ++c) {
                dense[r][c] -= factor * dense[i][c];
            }
        }
    }
    const std::vector<double> solved = system.solve();
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        EXPECT_NEAR(solved[i], dense[i][kUnknowns] / dense[i][i], 1e-9) << i;
    }
}

/// Mean square of the second differences of a torso against what its states say.
double quickness(const PartModel& part, const FeatureTrack& track) {
    double sum = 0.0;
    const std::size_t rows = track.rows();
    for (std::size_t feature = 0; feature < track.columns; ++feature) {
        double own = 0.0;
        double people = 0.0;
        for (std::size_t i = 0; i < rows; ++i) {
            const double second = track.row((i + 1) % rows)[feature] - 2.0 * track.row(i)[feature] +
                                  track.row((i + rows - 1) % rows)[feature];
            const FigureState& state = part.states[part.state_at(i, rows)];
            own += second * second;
            people += state.delta_delta_variance[feature] +
                      state.delta_delta_mean[feature] * state.delta_delta_mean[feature];
        }
        sum += own / people / static_cast<double>(track.columns);
    }
    return sum;
}

TEST(Detail, gives_a_mean_the_accelerations_of_people) {
    const FigureModel& model = test::basic_step();
    FigureTracks tracks = learnt_tracks(model, mannequin_skeleton());
    FeatureTrack& torso = tracks[static_cast<std::size_t>(Part::torso)];
    const FeatureTrack learnt = torso;
    EXPECT_LT(quickness(model.part(Part::torso), torso), 0.2);
    add_detail(model.part(Part::torso), CounterRandom(3, 4), 1.0, torso);
    EXPECT_NEAR(quickness(model.part(Part::torso), torso), 1.0, 0.35);
    FeatureTrack again = learnt;
    add_detail(model.part(Part::torso), CounterRandom(3, 4), 1.0, again);
    EXPECT_EQ(again.values, torso.values);
}

TEST(Detail, is_lost_by_averaging_people_and_not_by_a_written_dance) {
    const Skeleton& skeleton = mannequin_skeleton();
    EXPECT_EQ(detail_lost(test::basic_step(), learnt_tracks(test::basic_step(), skeleton)), 1.0);
    const auto box =
        load_figure(std::string(RAKS_SOURCE_DIR) + "/models/trained/waltz_box_lead.json");
    ASSERT_TRUE(box) << box.error().message;
    EXPECT_EQ(detail_lost(*box, learnt_tracks(*box, skeleton)), 0.0);
}

TEST(Couple, changes_the_octave_together) {
    const auto lead = Repertoire::of_one(test::couple_library(DanceRole::lead));
    const auto follow = Repertoire::of_one(test::couple_library(DanceRole::follow));
    DancerPart part;
    part.is_in_couple = true;
    part.partner = follow;
    Dancer one;
    ASSERT_TRUE(one.prepare(lead, mannequin_skeleton(), part));
    part.partner = lead;
    Dancer other;
    ASSERT_TRUE(other.prepare(follow, mannequin_skeleton(), part));
    PoseTrack tracks[2];
    BeatGrid grid = test::steady_grid(90.0);
    int octaves = 1;
    double last = 0.0;
    for (HopIndex hop = 0; hop < 4000; ++hop) {
        const StreamTime now = time_of_hop(hop);
        grid.anchor_beat = grid.beats_at(now);
        grid.anchor_time = now;
        grid.tempo = Bpm(90.0 * std::exp(0.02 * to_seconds(now)));
        const MusicState music = test::sure_state(hop, grid);
        one.advance(music, tracks[0]);
        other.advance(music, tracks[1]);
        if (one.status().is_dancing && other.status().is_dancing) {
            ASSERT_EQ(one.status().octave, other.status().octave) << hop;
            octaves += last != 0.0 && one.status().octave != last ? 1 : 0;
            last = one.status().octave;
        }
    }
    EXPECT_EQ(octaves, 2);
}

}  // namespace
}  // namespace raks::motion
