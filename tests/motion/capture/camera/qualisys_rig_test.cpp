#include "motion/capture/camera/qualisys_rig.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/mangled.hpp"
#include "tests/support/shared_data.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

/// A camera at (0, -3, 1.5) m that looks along y, upright: its x is the world's, its y the world's
/// z, its backward z the world's -y.
std::string camera(const std::string& serial, const std::string& x) {
    return "<camera active=\"1\" serial=\"" + serial +
           "\"><fov_video bottom=\"743\" left=\"10\" right=\"1289\" top=\"24\"/>"
           "<transform r11=\"1\" r12=\"0\" r13=\"0\" r21=\"0\" r22=\"0\" r23=\"1\" r31=\"0\" "
           "r32=\"-1\" r33=\"0\" x=\"" +
           x +
           "\" y=\"-3000.0\" z=\"1500\"/>"
           "<intrinsic centerPointU=\"41600\" centerPointV=\"24576\" focalLengthU=\"64000.0\" "
           "focalLengthV=\"64640\" radialDistortion1=\"-0.05\" radialDistortion2=\"0.1\" "
           "radialDistortion3=\"0.01\" skew=\"0\" tangentalDistortion1=\"0.001\" "
           "tangentalDistortion2=\"0.002\"/></camera>\n";
}
const std::string kQualisys =
    "<?xml version='1.0'?>\n<calibration><results std-dev=\"0.\"/>\n"
    "<cameras>\n" +
    camera("01", "0") + camera("02", "500") + "</cameras></calibration>\n";

std::string changed(const std::string& from, const std::string& to) {
    std::string text = kQualisys;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(QualisysRig, is_read_in_metres_with_y_up) {
    const auto file = parse_qualisys_rig(kQualisys, "a.qca.txt");
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->rig.cameras.size(), 2U);
    const Camera& first = file->rig.cameras[0];
    EXPECT_EQ(first.name, "01");
    EXPECT_EQ(first.lens,
              (Lens{1280, 720, 1000.0, 1010.0, 640.0, 360.0, {-0.05, 0.1, 0.001, 0.002, 0.01}}));
    EXPECT_LT(glm::distance(first.centre(), glm::dvec3(0.0, 1.5, 3.0)), 1e-12);
    EXPECT_LT(glm::distance(file->rig.cameras[1].centre(), glm::dvec3(0.5, 1.5, 3.0)), 1e-12);
    // What lies before it is seen in the middle, what is higher is higher in the picture.
    EXPECT_LT(glm::distance(*project(first, {0.0, 1.5, 0.0}), glm::dvec2(640.0, 360.0)), 1e-9);
    EXPECT_LT(project(first, {0.0, 1.6, 0.0})->y, 360.0);
    EXPECT_GT(project(first, {0.1, 1.5, 0.0})->x, 640.0);
}

TEST(QualisysRig, that_is_bad_is_refused_in_one_line) {
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"<calibration><cameras>", "at byte"},
        {"<calibration/>", "has no <calibration><cameras><camera>"},
        {changed("serial=\"01\"", "number=\"01\""), "has no serial"},
        {changed("fov_video bottom", "fov bottom"), "has no fov_video left"},
        {changed("right=\"1289\"", "right=\"9\""), "fov_video does not give the size of a picture"},
        {changed("right=\"1289\"", "right=\"1e300\""),
         "fov_video does not give the size of a picture"},
        {changed("x=\"0\"", "x=\"nan\""), "transform x is \"nan\", not a number"},
        {changed("r33=\"0\"", ""), "has no transform r33"},
        {changed("focalLengthU=\"64000.0\"", "focalLengthU=\"-1\""),
         "focal length is not positive"},
        {changed("skew=\"0\"", "skew=\"0.5\""), "skewed lens"},
        {changed("r11=\"1\"", "r11=\"-1\""), "mirror image (determinant -1)"},
        {changed("serial=\"02\"", "serial=\"01\""), "two cameras are called \"01\""},
    };
    for (const auto& [text, part] : faults) {
        const auto file = parse_qualisys_rig(text, "a.xml");
        ASSERT_FALSE(file) << part;
        EXPECT_NE(file.error().message.find(part), std::string::npos) << file.error().message;
        EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
    }
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        static_cast<void>(parse_qualisys_rig(test::mangled(kQualisys, {.seed = seed}), "a"));
    }
}

TEST(QualisysRig, equals_what_pose2sim_makes_of_it_but_for_the_distortion) {
    const std::filesystem::path folder = test::shared_data() / "capture/pose2sim";
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "skipped: no " << folder;
    }
    // Its world stays as it is: z up. Its distortion is a 64th of the true one: their fault.
    const auto ours = read_rig(folder / "Calib.qca.txt", {.metres_per_unit = {}, .up = UpAxis::y});
    const auto theirs = read_rig(folder / "Calib_qca.toml");
    ASSERT_TRUE(ours) << ours.error().message;
    ASSERT_TRUE(theirs) << theirs.error().message;
    ASSERT_EQ(ours->rig.cameras.size(), theirs->rig.cameras.size());
    for (std::size_t i = 0; i < ours->rig.cameras.size(); ++i) {
        const Camera& one = ours->rig.cameras[i];
        const Camera& other = theirs->rig.cameras[i];
        EXPECT_EQ(one.name, other.name);
        EXPECT_EQ(one.lens.fx, other.lens.fx);
        EXPECT_NEAR(one.lens.cx, other.lens.cx, 1e-3);
        EXPECT_NEAR(one.lens.distortion[0], 64.0 * other.lens.distortion[0], 1e-9);
        EXPECT_LT(glm::distance(one.centre(), other.centre()), 1e-6);
        for (glm::length_t column = 0; column < 3; ++column) {
            EXPECT_LT(glm::distance(one.rotation[column], other.rotation[column]), 1e-6);
        }
    }
}

}  // namespace
}  // namespace raks::capture
