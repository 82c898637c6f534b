#include "motion/dance/baking/trajectory.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numeric>

#include "motion/dance/generator.hpp"
#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "tests/motion/dance/stage.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::motion {
namespace {

using test::basic_step;

TEST(CoupledPath, goes_from_left_to_right_one_state_at_a_time) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const CoupledPath paths = coupled_path(basic_step(), CounterRandom(seed));
        for (const Part part : kParts) {
            const std::vector<std::size_t>& path = paths[static_cast<std::size_t>(part)];
            ASSERT_EQ(path.size(), basic_step().samples());
            EXPECT_EQ(path.front(), 0U);
            for (std::size_t t = 1; t < path.size(); ++t) {
                ASSERT_LE(path[t] - path[t - 1], 1U) << t;
            }
            EXPECT_GE(path.back() + 2, basic_step().part(part).states.size());
        }
    }
}

TEST(CoupledPath, states_come_at_the_counts_of_the_table) {
    constexpr std::uint64_t kRepeats = 60;
    const FigureModel& model = basic_step();
    const auto a_beat = static_cast<std::size_t>(model.samples_per_beat);
    for (const Part which : kParts) {
        const PartModel& part = model.part(which);
        for (std::size_t count = 0; count < 8; ++count) {
            double drawn = 0.0;  // mean state at this count
            for (std::uint64_t seed = 0; seed < kRepeats; ++seed) {
                const CoupledPath paths = coupled_path(model, CounterRandom(seed));
                const auto& path = paths[static_cast<std::size_t>(which)];
                for (std::size_t t = count * a_beat; t < (count + 1) * a_beat; ++t) {
                    drawn += static_cast<double>(path[t]);
                }
            }
            drawn /= static_cast<double>(kRepeats * a_beat);
            double told = 0.0;
            for (std::size_t k = 0; k < part.states.size(); ++k) {
                told += static_cast<double>(k) * part.occurrence[count][k];
            }
            EXPECT_NEAR(drawn, told, 1.0) << kPartNames[static_cast<std::size_t>(which)]
                                          << ", count " << count + 1;  // half a beat
        }
    }
}

TEST(DrawnTracks, repeats_scatter_about_the_states_and_the_same_one_has_the_same_bits) {
    const FigureModel& model = basic_step();
    constexpr std::uint64_t kRepeats = 40;
    std::array<double, 3> mean{};
    for (std::uint64_t repeat = 0; repeat < kRepeats; ++repeat) {
        const FigureTracks tracks = drawn_tracks(model, 0, repeat);
        const FeatureTrack& lower = tracks[static_cast<std::size_t>(Part::lower)];
        for (std::size_t i = 0; i < lower.rows(); ++i) {
            for (std::size_t feature = 0; feature < 3; ++feature) {
                mean[feature] +=
                    lower.row(i)[feature] / static_cast<double>(kRepeats * lower.rows());
            }
        }
    }
    const PartModel& part = model.part(Part::lower);
    for (std::size_t feature = 0; feature < 3; ++feature) {
        double told = 0.0;
        for (const FigureState& state : part.states) {
            told += state.mean[feature] / static_cast<double>(part.states.size());
        }
        EXPECT_NEAR(mean[feature], told, 0.03) << feature;  // radians
    }
    EXPECT_EQ(drawn_tracks(model, 0, 3)[2].values, drawn_tracks(model, 0, 3)[2].values);
    EXPECT_NE(drawn_tracks(model, 0, 3)[2].values, drawn_tracks(model, 0, 4)[2].values);
}

TEST(DrawnTracks, every_kind_of_covariance_is_drawn_from) {
    FigureModel model = basic_step();
    PartModel& upper = model.parts[static_cast<std::size_t>(Part::upper)];
    const auto spread = [&] {
        const FigureTracks tracks = drawn_tracks(model, 0, 0);
        const FeatureTrack& track = tracks[static_cast<std::size_t>(Part::upper)];
        const CoupledPath paths = coupled_path(model, CounterRandom(0, 1000));
        double square = 0.0;
        for (std::size_t i = 0; i < track.rows(); ++i) {
            const double mean =
                upper.states[paths[static_cast<std::size_t>(Part::upper)][i]].mean[0];
            square += (track.row(i)[0] - mean) * (track.row(i)[0] - mean);
        }
        return std::sqrt(square / static_cast<double>(track.rows()));
    };
    const std::size_t size = upper.dimension();
    std::vector<std::vector<double>> tiny(size, std::vector<double>(size, 0.0));
    for (std::size_t i = 0; i < size; ++i) {
        tiny[i][i] = 1e-12;
    }
    const double tied = spread();
    upper.covariance_kind = CovarianceKind::full;
    upper.state_covariances.assign(upper.states.size(), tiny);
    const double full = spread();
    upper.covariance_kind = CovarianceKind::diagonal;
    upper.state_covariances.assign(upper.states.size(), {std::vector<double>(size, 1e-12)});
    const double diagonal = spread();
    EXPECT_LT(full, 0.8 * tied);  // what is left is the smoothing over the states' steps
    EXPECT_NEAR(full, diagonal, 1e-5);
}

TEST(FrameGenerator, dances_without_planting_feet_repeatably_and_in_real_time) {
    const auto library = DanceLibrary::build(
        test::salsa_figures(), mannequin_skeleton(), nullptr, Generator::frames);
    ASSERT_TRUE(library) << library.error().message;
    std::array<std::vector<Pose>, 2> poses;
    for (std::vector<Pose>& round : poses) {
        Dancer dancer;
        ASSERT_TRUE(dancer.prepare(*library, mannequin_skeleton(), 5));
        const auto track = std::make_unique<PoseTrack>();
        round.reserve(3000);
        raks::test::RealtimeScope scope;
        for (HopIndex hop = 0; hop < 3000; ++hop) {
            dancer.advance(test::sure_state(hop, test::steady_grid(172.0)), *track);
            round.push_back(track->at_hop(hop));
        }
        EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
    }
    EXPECT_LT(test::largest_step(poses[0], 0, 3000), test::kFastestStep);
    for (std::size_t hop = 0; hop < poses[0].size(); ++hop) {
        ASSERT_EQ(poses[0][hop].local_rotations, poses[1][hop].local_rotations) << hop;
        if (hop > 500) {
            ASSERT_FALSE(poses[0][hop].foot_contact[0] || poses[0][hop].foot_contact[1]);
        }
    }
}

}  // namespace
}  // namespace raks::motion
