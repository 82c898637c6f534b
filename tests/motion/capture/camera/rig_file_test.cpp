#include "motion/capture/camera/rig_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/shared_data.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

const std::string kCamera =
    "size = [640.0, 480.0]\nmatrix = [[600, 0, 320], [0, 610, 240], [0, 0, 1]]\n"
    "distortions = [0.1, 0.2, 0.3, 0.4]\nrotation = [0.0, 0.0, 0.0]\n";
const std::string kRig = "[cam_10]\n" + kCamera + "translation = [0, 0, 4]\n\n[cam_2]\n" + kCamera +
                         "translation = [2, 0, 4]\nname = \"left\"\n";

std::string rig_with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

Rig odd_ring(int count) {
    Rig rig;
    for (int i = 0; i < count; ++i) {
        const double angle = 6.28 * i / count + 0.1;
        Lens lens{1280, 720, 601.0 + i / 3.0, 599.0, 639.5, 359.5, {}};
        lens.distortion = {-0.1 / 3.0, 0.01, 1e-4, -1e-5, 1e-17, i == 2 ? 0.1 : 0.0, 0.0, 0.0};
        rig.cameras.push_back(looking_at("film \"" + std::to_string(i) + "\"",
                                         lens,
                                         {4.0 * std::cos(angle), 1.5, 4.0 * std::sin(angle)},
                                         {0.0, 0.95, 0.0}));
    }
    return rig;
}

TEST(RigFile, of_ours_reads_back_to_the_same_bits) {
    const Rig rig = odd_ring(12);
    const Expected<RigFile> again = parse_rig(rig_text(rig), "rig.toml");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->rig, rig);
    EXPECT_TRUE(again->notes.empty());
    EXPECT_EQ(rig_text(again->rig), rig_text(rig));
}

TEST(RigFile, says_how_its_floor_is_known) {
    Rig rig = odd_ring(2);
    for (const FloorOrigin floor : {FloorOrigin::known, FloorOrigin::unknown, FloorOrigin::feet}) {
        rig.floor = floor;
        const Expected<RigFile> again = parse_rig(rig_text(rig), "rig.toml");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->rig.floor, floor);
    }
    std::string text = rig_text(rig);
    text.replace(text.find("\"feet\""), 6, "\"moon\"");
    const Expected<RigFile> wrong = parse_rig(text, "rig.toml");
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.error().message.find("moon"), std::string::npos) << wrong.error().message;
}

TEST(RigFile, keeps_the_order_of_the_file_and_names_cameras_by_their_tables) {
    const Expected<RigFile> file = parse_rig(kRig, "a.toml");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->rig.cameras.size(), 2U);
    EXPECT_EQ(file->rig.cameras[0].name, "cam_10");
    EXPECT_EQ(file->rig.cameras[1].name, "left");
    EXPECT_EQ(file->rig.cameras[0].lens.distortion,
              (std::array{0.1, 0.2, 0.3, 0.4, 0.0, 0.0, 0.0, 0.0}));
    ASSERT_EQ(file->notes.size(), 1U);
    EXPECT_EQ(file->notes[0], "the rig does not say its unit: taken as metres");
}

TEST(RigFile, is_turned_into_metres_with_y_up) {
    const auto check = [](const Expected<RigFile>& file) {
        ASSERT_TRUE(file) << file.error().message;
        const Camera& camera = file->rig.cameras[0];
        // The file's camera looks along its own z, which is up; it stands 4 mm below the origin.
        EXPECT_LT(glm::distance(camera.centre(), {0.0, -0.004, 0.0}), 1e-15);
        EXPECT_LT(glm::distance(camera.in_camera({0.0, 1.0, 0.0}), {0.0, 0.0, 1.004}), 1e-15);
        EXPECT_EQ(file->notes.size(), 2U);
    };
    check(parse_rig(kRig, "a.toml", {.metres_per_unit = 0.001, .up = UpAxis::z}));
    check(parse_rig(kRig + "[metadata]\nunit = \"mm\"\nup = \"z\"\n", "a.toml"));
}

TEST(RigFile, of_caliscope_has_matrices_and_may_ignore_cameras) {
    const std::string rows = "rotation = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]\n";
    std::string text = "[cameras.0]\n" + kCamera + "translation = [0, 0, 4]\n[cameras.1]\n" +
                       kCamera + "translation = [1, 0, 4]\n[cameras.2]\n" +
                       rig_with(kCamera, "rotation", "ignore = true\nspare") +
                       "[charuco]\ncolumns = 4\n";
    text = rig_with(text, "rotation = [0.0, 0.0, 0.0]\n", rows);
    const Expected<RigFile> file = parse_rig(text, "a.toml");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->rig.cameras.size(), 2U);
    EXPECT_EQ(file->rig.cameras[0].name, "cam_0");
    EXPECT_EQ(file->rig.cameras[0].rotation * glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_EQ(file->notes[0], "camera \"cam_2\" is marked `ignore`: left out");
}

TEST(RigFile, that_is_bad_is_refused_with_its_line_and_camera) {
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"", "a.toml: has no camera: a table [cam_0]"},
        {"[cam", "a.toml: line 1, column 5"},
        {"[cam_1]\nsize = [1, 2]\n", "line 1: camera \"cam_1\": needs matrix = [[fx, 0, cx]"},
        {rig_with(kRig, "640.0", "640.5"), "line 2: camera \"cam_10\": size must be whole numbers"},
        {rig_with(kRig, "640.0", "-640.0"), "size is -640, must be 1 to 65535"},
        {rig_with(kRig, "[600, 0, 320]", "[600, 1, 320]"), "a skewed lens cannot be used"},
        {rig_with(kRig, "[600, 0, 320]", "[600, 320]"), "matrix must be three rows"},
        {rig_with(kRig, "[600, 0, 320]", "[nan, 0, 320]"), "matrix is nan"},
        {rig_with(kRig, "[600, 0, 320]", "[-600, 0, 320]"), "its focal length is not positive"},
        {rig_with(kRig, "0.3, 0.4]", "0.3]"), "distortions must be 4, 5 or 8 numbers"},
        {rig_with(kRig, "rotation = [0.0, 0.0, 0.0]", "rotation = \"null\""),
         "camera \"cam_10\": has no rotation: it is not calibrated with the others"},
        {rig_with(kRig, "translation = [0, 0, 4]", ""), "camera \"cam_10\": has no translation"},
        {rig_with(kRig, "rotation = [0.0, 0.0, 0.0]", "rotation = [0.0, 0.0]"), "rotation must be"},
        {rig_with(
             kRig, "rotation = [0.0, 0.0, 0.0]", "rotation = [[1, 0, 0], [0, 1, 0], [0, 0, -1]]"),
         "camera \"cam_10\": its rotation is a mirror image"},
        {rig_with(kRig, "translation = [0, 0, 4]", "translation = [0, 0, 4]\nfisheye = true"),
         "a fisheye lens is described by other numbers"},
        {rig_with(kRig,
                  "translation = [0, 0, 4]",
                  "translation = [0, 0, 4]\nrotation_matrix = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]"),
         "rotation and rotation_matrix differ"},
        {rig_with(kRig, "\"left\"", "\"cam_10\""), "two cameras are called \"cam_10\""},
        {kRig + "[metadata]\nunit = \"cm\"\n", "[metadata]: unit \"cm\" is unknown"},
        {"[cam_1]\n" + kCamera + "translation = [0, 0, 4]\n",
         "one camera is too few: where something is, two or more tell"},
    };
    for (const auto& [text, expected] : faults) {
        const Expected<RigFile> file = parse_rig(text, "a.toml");
        ASSERT_FALSE(file) << expected;
        EXPECT_NE(file.error().message.find(expected), std::string::npos) << file.error().message;
    }
}

TEST(RigFile, of_every_program_is_read) {
    const std::filesystem::path folder = test::shared_data() / "capture";
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "skipped: no " << folder;
    }
    const std::vector<std::pair<std::string, std::size_t>> files = {
        {"anipose/calib_motobs_7cam.toml", 7},
        {"pose2sim/Calib_qca.toml", 4},
        {"caliscope/post_optimization/camera_array.toml", 4},
        {"caliscope/4_cam_recording/camera_array.toml", 4}};
    for (const auto& [name, cameras] : files) {
        const Expected<RigFile> file = read_rig(folder / name);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->rig.cameras.size(), cameras) << name;
        const Expected<RigFile> again = parse_rig(rig_text(file->rig), "rig.toml");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(again->rig, file->rig) << name;
    }
    // Millimetres show in how far the cameras seem to be apart.
    const Expected<RigFile> far = read_rig(folder / files[0].first);
    const std::vector<std::string> doubts = rig_doubts(far->rig);
    EXPECT_TRUE(std::any_of(doubts.begin(), doubts.end(), [](const std::string& doubt) {
        return doubt.find("millimetres?") != std::string::npos;
    }));
    const Expected<RigFile> apart = read_rig(folder / "caliscope/bad_not_linked/camera_array.toml");
    ASSERT_FALSE(apart);
    EXPECT_NE(apart.error().message.find("not calibrated with the others"), std::string::npos);
}

}  // namespace
}  // namespace raks::capture
