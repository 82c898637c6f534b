// Points in C3D, TRC and tables: the same places in every form, and what is refused.
#include "motion/skeleton/formats/points.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/file.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "tests/motion/skeleton/formats/motion_writers.hpp"
#include "tests/support/shared_data.hpp"

namespace raks::motion::points_test {
namespace {

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();

// Two points over three frames, one of them once not seen. Multiples of a quarter, which floats and
// whole numbers hold alike.
PointClip truth() {
    PointClip clip;
    clip.names = {"LASI", "RASI"};
    clip.frames_per_second = 100.0;
    clip.frame_count = 3;
    clip.positions = {{1.25, -2.5, 900.0},
                      {-1.0, 0.0, 0.25},
                      {1.5, -2.25, 901.0},
                      glm::dvec3(kUnseen),
                      {1.75, -2.0, 902.0},
                      {-3.0, 0.5, -0.75}};
    return clip;
}

void expect_truth(const Expected<PointClip>& clip, const std::string& what) {
    ASSERT_TRUE(clip) << what << ": " << clip.error().message;
    const PointClip wanted = truth();
    EXPECT_EQ(clip->names, wanted.names) << what;
    EXPECT_NEAR(clip->frames_per_second, 100.0, 1e-9) << what;
    ASSERT_EQ(clip->positions.size(), wanted.positions.size()) << what;
    for (std::size_t i = 0; i < wanted.positions.size(); ++i) {
        const glm::dvec3& a = clip->positions[i];
        const glm::dvec3& b = wanted.positions[i];
        EXPECT_TRUE(a == b || (std::isnan(a.x) && std::isnan(a.z) && std::isnan(b.x)))
            << what << " " << i << ": " << a.x << " " << a.y << " " << a.z;
    }
}

std::string message(const Expected<PointClip>& clip) {
    return clip ? "read" : clip.error().message;
}

TEST(C3d, every_computer_and_kind_of_number_gives_the_same_points) {
    for (const C3dProcessor processor :
         {C3dProcessor::intel, C3dProcessor::dec, C3dProcessor::mips}) {
        for (const bool is_float : {true, false}) {
            for (const std::size_t analogue : {0U, 3U}) {
                raks::test::C3dForm form;
                form.processor = processor;
                form.is_float = is_float;
                form.analogue = analogue;
                const auto clip =
                    parse_c3d(raks::test::c3d_bytes(truth(), form), "x.c3d", std::nullopt);
                expect_truth(clip, std::to_string(static_cast<int>(processor)));
                EXPECT_EQ(clip->metres_per_unit, 0.001);
                EXPECT_EQ(clip->up, glm::dvec3(0.0, 0.0, 1.0));
                EXPECT_TRUE(clip->warnings.empty());
            }
        }
    }
}

TEST(C3d, a_file_that_is_cut_off_gives_the_frames_that_are_there) {
    PointClip many = truth();
    many.frame_count = 40;
    for (std::size_t i = 6; i < 80; ++i) {
        many.positions.push_back({0.0, 0.0, static_cast<double>(i)});
    }
    const std::string whole = raks::test::c3d_bytes(many);
    const std::size_t data = whole.size() - 1536;  // three blocks of points
    const auto clip = parse_c3d(whole.substr(0, data + 10 * 32 + 5), "x.c3d", std::nullopt);
    ASSERT_TRUE(clip) << message(clip);
    EXPECT_EQ(clip->frame_count, 10U);
    EXPECT_EQ(clip->warnings,
              std::vector<std::string>{"40 frames are declared, 10 are there: it is cut off"});
    EXPECT_EQ(message(parse_c3d(whole.substr(0, data), "x.c3d", std::nullopt)),
              "x.c3d: has no frames: it is cut off");
    EXPECT_EQ(message(parse_c3d(whole.substr(0, 700), "x.c3d", std::nullopt)),
              "x.c3d: is not C3D, or is cut off in its header");
}

// The samples of c3d.org (GPL: read there, never copied), with what is known of them.
TEST(C3d, the_samples_are_what_others_say_of_them) {
    const auto folder = raks::test::shared_data() / "capture/c3d";
    if (!is_there(folder / "FP_Type1.c3d")) {
        GTEST_SKIP() << "no samples in " << folder;
    }
    const auto read = [&](const char* name) {
        return parse_c3d(read_file(folder / name).value(), name, std::nullopt);
    };
    const auto first = read("FP_Type1.c3d");
    ASSERT_TRUE(first) << message(first);
    EXPECT_EQ(first->names.size(), 22U);
    EXPECT_EQ(first->frame_count, 634U);
    EXPECT_EQ(first->frames_per_second, 100.0);
    EXPECT_EQ(first->metres_per_unit, 1.0);
    const auto third = read("FP_Type3.c3d");
    ASSERT_TRUE(third) << message(third);
    EXPECT_EQ(third->frame_count, 2U);
    EXPECT_EQ(third->frames_per_second, 250.0);
    EXPECT_EQ(third->metres_per_unit, 0.001);
    const auto cut = read("Optotrak.c3d");
    ASSERT_TRUE(cut) << message(cut);
    EXPECT_EQ(cut->names.size(), 54U);
    EXPECT_FALSE(cut->warnings.empty());
    EXPECT_EQ(message(read("C3DRotationExample.c3d")),
              "C3DRotationExample.c3d: holds no points, only other channels");
}

constexpr std::string_view kTrc =
    "PathFileType\t4\t(X/Y/Z)\tx.trc\n"
    "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\n"
    "100\t100\t3\t2\tmm\t100\n"
    "Frame#\tTime\tLASI\t\t\tRASI\t\t\n"
    "\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
    "\n"
    "1\t0.00\t1.25\t-2.5\t900\t-1\t0\t0.25\n"
    "2\t0.01\t1.5\t-2.25\t901\t\t\t\n"
    "3\t0.02\t1.75\t-2\t902\t-3\t0.5\t-0.75\t\n";

std::string with(std::string_view text, const std::string& from, const std::string& to) {
    std::string changed(text);
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? changed : changed.replace(at, from.size(), to);
}

TEST(Trc, gives_markers_rate_and_unit) {
    const auto clip = parse_trc(kTrc, "x.trc", std::nullopt);
    expect_truth(clip, "TRC");
    EXPECT_EQ(clip->metres_per_unit, 0.001);
    EXPECT_EQ(clip->up, std::nullopt);  // the format does not say it
    // Rows whose end lacks, and a rate that is given.
    const auto other = parse_trc(with(kTrc, "901\t\t\t\n", "901\r\n"), "x.trc", 50.0);
    ASSERT_TRUE(other) << message(other);
    EXPECT_TRUE(std::isnan(other->position(1, 1).y));
    EXPECT_EQ(other->frames_per_second, 50.0);
}

TEST(Trc, what_is_damaged_is_refused_with_its_line) {
    const struct {
        std::string text;
        const char* part;
    } rows[] = {
        {"", "x.trc: is not TRC"},
        {std::string(kTrc.substr(0, 60)), "x.trc: is not TRC, or ends inside its header"},
        {with(kTrc, "901", "x"), "x.trc: line 8: \"x\" is not a number"},
        {std::string(kTrc) + "end of file\n", "does not begin with a frame's number"},
        {std::string(kTrc) + "\t0.03\t1\t2\t3\n", "does not begin with a frame's number"},
        {with(kTrc, "LASI\t\t\tRASI", "\t\t\t"), "line 4: names 0 markers"},
        {with(kTrc, "0.25\n", "0.25\t7\n"), "line 7: 9 cells for 2 markers: at most 8"},
        {with(kTrc, "\n100\t", "\n0\t"), "its frame rate is 0"},
        {with(kTrc, "900", "1e9"), "which is impossible"},
        {std::string(kTrc.substr(0, kTrc.find("1\t0.00"))), "has no frames"},
    };
    for (const auto& row : rows) {
        const std::string said = message(parse_trc(row.text, "x.trc", std::nullopt));
        EXPECT_NE(said.find(row.part), std::string::npos) << row.part << ": " << said;
    }
}

constexpr std::string_view kCsv =
    "frame,time,LASI_x,LASI_y,LASI_z,RASI_x,RASI_y,RASI_z\n"
    "0,0.00,1.25,-2.5,900,-1,0,0.25\n"
    "1,0.01,1.5,-2.25,901,,nan,NaN\n"
    "2,0.02,1.75,-2,902,-3,0.5,-0.75\n";

TEST(PointTable, columns_are_found_by_their_names_whatever_separates_them) {
    expect_truth(parse_points_csv(kCsv, "x.csv", std::nullopt), "commas");
    std::string text(kCsv);
    std::replace(text.begin(), text.end(), ',', '\t');
    expect_truth(parse_points_csv(text, "x.tsv", std::nullopt), "tabs");
    std::replace(text.begin(), text.end(), '\t', ';');
    expect_truth(parse_points_csv("\xEF\xBB\xBF" + text, "x.csv", std::nullopt), "semicolons");
    // Another order, dots and capitals, quotes; rate by option.
    expect_truth(parse_points_csv("\"LASI.Z\",LASI.X,LASI.Y,\"RASI.X\",RASI.Y,RASI.Z\r\n"
                                  "900,1.25,-2.5,-1,0,0.25\r\n901,1.5,-2.25,,,\r\n"
                                  "902,1.75,-2,-3,0.5,-0.75",
                                  "x.csv",
                                  100.0),
                 "dots");
}

TEST(PointTable, what_does_not_fit_is_refused_with_its_line) {
    const struct {
        std::string text;
        const char* part;
    } rows[] = {
        {"", "x.csv: is empty"},
        {"a,b,c\n1,2,3\n", "line 1: has no columns of positions, which are called NAME_x"},
        {with(kCsv, "RASI_y,", ""), "line 1: the point \"RASI\" has no column for y"},
        {with(kCsv, "RASI_y", "RASI_x"), "the column \"RASI_x\" is there twice"},
        {with(kCsv, "0.25\n", "0.25,7\n"), "line 2: has 9 cells for 8 columns"},
        {with(kCsv, "-2.25", "1;5"), "line 3: \"1;5\" is not a number"},
        {with(kCsv, "0.02", "0.01"), "line 4: the time 0.01 does not come after the one before"},
        {with(kCsv, "0.02", "x"), "line 4: \"x\" is not a time"},
        {with(kCsv, "time", "label"),
         "x.csv: has no column \"time\", or only one row; give the rate"},
    };
    for (const auto& row : rows) {
        const std::string said = message(parse_points_csv(row.text, "x.csv", std::nullopt));
        EXPECT_NE(said.find(row.part), std::string::npos) << row.part << ": " << said;
    }
}

TEST(PointTable, what_is_passed_over_is_said) {
    const auto clip = parse_points_csv(
        with(with(kCsv, "frame,", "mood,"), "0.01,", "0.0135,"), "x.csv", std::nullopt);
    ASSERT_TRUE(clip) << message(clip);
    EXPECT_EQ(clip->warnings,
              (std::vector<std::string>{
                  "1 columns that are not positions are left out: mood",
                  "its times are uneven by up to 0.0035 s; frames are taken as even"}));
}

TEST(MotionFile, points_are_no_skeleton) {
    const auto file = parse_motion(kTrc, {"x.dat", ""}, {});
    ASSERT_TRUE(file) << file.error().message;
    EXPECT_TRUE(std::holds_alternative<PointClip>(*file));
}

}  // namespace
}  // namespace raks::motion::points_test
