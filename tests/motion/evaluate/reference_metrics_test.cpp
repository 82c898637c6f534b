// All metrics of two captured clips against those of the reference program (numpy).
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "motion/evaluate/dance_metrics.hpp"
#include "motion/evaluate/published_metrics.hpp"
#include "motion/figures/label_tables.hpp"
#include "motion/skeleton/formats/bvh.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::motion {
namespace {

namespace fs = std::filesystem;

constexpr double kClipRate = 60.0;
constexpr double kFirstFrame = 973.0;  // of take 03 in its cut

struct Cut {
    const char* name;
    double metres_per_unit;
};

/// Counts of take 03 in seconds from the cut's first frame; those before and behind it as well.
std::vector<double> count_times(const fs::path& file) {
    const auto counts = load_counts(file);
    EXPECT_TRUE(counts) << counts.error().message;
    std::vector<double> times;
    for (const CountTime& count : *counts) {
        if (count.take == "03") {
            times.push_back((count.frame - kFirstFrame) / kClipRate);
        }
    }
    return times;
}

class ReferenceMetrics : public ::testing::TestWithParam<Cut> {};
INSTANTIATE_TEST_SUITE_P(PlainCuts,
                         ReferenceMetrics,
                         ::testing::Values(Cut{"60_03_973_1679", 1.267},
                                           Cut{"61_03_973_1679", 1.17}),
                         [](const auto& cut) { return std::string(cut.param.name); });

TEST_P(ReferenceMetrics, equal_those_of_the_reference_program) {
    const fs::path folder = raks::test::shared_data() / "mocap";
    const std::string name = GetParam().name;
    const fs::path file = folder / "salsa" / (name + ".bvh");
    if (!fs::exists(file)) {
        GTEST_SKIP() << "no clip at " << file;
    }
    std::ifstream stream(folder / ("metrics_" + name + ".json"));
    const nlohmann::json expected = nlohmann::json::parse(stream);
    const auto clip = read_bvh(file, {.frames_per_second = kClipRate});
    ASSERT_TRUE(clip) << clip.error().message;
    const auto track = body_track(*clip, GetParam().metres_per_unit);
    ASSERT_TRUE(track) << track.error().message;
    EXPECT_EQ(track->frames(), expected["frames"].get<std::size_t>());
    const auto near = [](double value, const nlohmann::json& reference, const char* what) {
        // Other order of sums and of rotations: rounding alone may differ.
        const double wanted = reference.get<double>();
        EXPECT_NEAR(value, wanted, 1e-9 * std::abs(wanted)) << what;
    };
    const JerkReport jerk = jerk_of(*track);
    near(jerk.rms, expected["jerk_rms"], "jerk rms");
    near(jerk.p999, expected["jerk_p999"], "jerk p99.9");
    const ContactReport contact = contacts_of(*track);
    const nlohmann::json& reference = expected["contact"];
    EXPECT_EQ(contact.slips.size(), reference["count"].get<std::size_t>());
    near(contact.share, reference["share"], "contact share");
    near(contact.slip_median, reference["slip_median"], "slip median");
    near(contact.slip_p95, reference["slip_p95"], "slip p95");
    near(contact.toe_speed_mean, reference["toe_speed_mean"], "toe speed mean");
    near(contact.toe_speed_p95, reference["toe_speed_p95"], "toe speed p95");
    near(-contact.lowest_toe, reference["toe_lowest_below_floor"], "lowest toe");
    near(physical_foot_contact(*track), expected["pfc"], "PFC");
    near(foot_skating_ratio(*track), expected["foot_skating_ratio"], "foot skating ratio");
    const std::vector<double> counts = count_times(folder / "salsa_counts.tsv");
    near(motion_beat_alignment(*track, counts), expected["bas_fact"], "BAS (FACT)");
    near(music_beat_alignment(*track, counts), expected["bas_bailando"], "BAS (Bailando)");
}

}  // namespace
}  // namespace raks::motion
