// Two phones, no markers and no board: from drawn films of a dance to the dance, laid beside the
// truth.
#include <gtest/gtest.h>

#include <string>

#include "base/pending_file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

/// Two cameras of small pictures, 85 degrees apart and 1.3 m high, that look at the dancer's hips.
constexpr const char* kRig = R"([cam_0]
name = "left"
size = [640, 360]
matrix = [[487.0, 0.0, 321.0], [0.0, 487.0, 183.5], [0.0, 0.0, 1.0]]
distortions = [0.0, 0.0, 0.0, 0.0, 0.0]
rotation = [-2.8409536074984842, 0.055101909708277, -1.1047864361371869]
translation = [0.0, 0.94528533069949, 4.114478781518305]

[cam_1]
name = "right"
size = [640, 360]
matrix = [[481.0, 0.0, 323.5], [0.0, 481.0, 177.0], [0.0, 0.0, 1.0]]
distortions = [0.0, 0.0, 0.0, 0.0, 0.0]
rotation = [-2.8084441043135038, -0.07473333469257572, 1.0921441817654407]
translation = [0.0, 0.9411448978530307, 4.167042870099275]

[metadata]
unit = "m"
up = "y"
)";

class CaptureMarkerless : public ProgramTest {
 protected:
    /// As `run`, by the program that dances.
    [[nodiscard]] ProcessResult run_raks(std::vector<std::string> arguments) const {
        ProcessPlan dancing = plan(std::move(arguments));
        dancing.command.front() = RAKS_DANCING_PROGRAM;
        return run_process(dancing);
    }
};

// Bars are wide: six seconds of small, coarse pictures. What sharper and longer films give is
// measured by scripts/capture_two_phones.sh.
TEST_F(CaptureMarkerless, a_dance_comes_out_of_two_small_films) {
    const auto song =
        run_raks({"synth", "salsa", "--duration", "6", "--seed", "1", "-o", path("song.wav")});
    ASSERT_EQ(song.exit_code, 0) << song.err;
    const auto danced = run_raks(
        {"dance", path("song.wav"), "--dance", "salsa", "--seed", "1", "-o", path("danced.bvh")});
    ASSERT_EQ(danced.exit_code, 0) << danced.err;
    ASSERT_TRUE(write_file(folder_ / "rig.toml", kRig));
    const auto filmed = run({"simulate",
                             path("danced.bvh"),
                             "-o",
                             path("film"),
                             "--draft",
                             "--no-markers",
                             "--no-board",
                             "--rig",
                             path("rig.toml"),
                             "--rate",
                             "10"});
    ASSERT_EQ(filmed.exit_code, 0) << filmed.err;

    const auto done = run({"run", path("film"), "--markerless"});
    ASSERT_EQ(done.exit_code, 0) << done.err;
    // Films without sound, whose clocks are known: nothing is missed.
    EXPECT_NE(done.err.find("no film has sound: the clocks stay as they are"), std::string::npos)
        << done.err;
    EXPECT_EQ(done.err.find("has no sound track"), std::string::npos) << done.err;
    const std::string line = "raks train figure " + path("film/dance.bvh") + " --once -o mine\n";
    EXPECT_TRUE(done.out.ends_with(line)) << done.out;

    const auto compared =
        run({"compare", path("film/truth/dance.bvh"), path("film/dance.bvh"), "--align", "--json"});
    ASSERT_EQ(compared.exit_code, 0) << compared.err;
    const auto found = nlohmann::json::parse(compared.out, nullptr, false);
    ASSERT_FALSE(found.is_discarded()) << compared.out;
    EXPECT_GT(found["seconds"].get<double>(), 5.0);
    EXPECT_LT(found["world"].get<double>(), 0.06) << compared.out;
    EXPECT_LT(found["legs_angle"].get<double>(), 10.0) << compared.out;
    EXPECT_LT(found["arms_angle"].get<double>(), 18.0) << compared.out;
    EXPECT_LT(found["alignment"]["up_off"].get<double>(), 4.0) << compared.out;
    EXPECT_NEAR(found["alignment"]["scale"].get<double>(), 1.0, 0.05) << compared.out;
}

}  // namespace
}  // namespace raks::test
