#include "motion/capture/camera/lens_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/shared_data.hpp"

namespace raks::capture {
namespace {

const std::string kLensText =
    "%YAML:1.0\n---\ncalibration_time: \"Wed 08 Dec\"\nimage_width: 640\nimage_height: 480\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 5.5e+02, 0., 320.25, 0.,\n       560, 240., 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n"
    "   data: [ -0.25, 0.125, 1e-3, -2.e-03 ]\n"
    "per_view: !!opencv-matrix\n   rows: 1\n   cols: 2\n   dt: f\n   data: [ .Nan, 1. ]\n";

std::string lens_with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(LensFile, is_read_whatever_else_is_in_it) {
    const Expected<Lens> lens = parse_lens_yaml(kLensText, "a.yml");
    ASSERT_TRUE(lens) << lens.error().message;
    const Lens expected{
        640, 480, 550.0, 560.0, 320.25, 240.0, {-0.25, 0.125, 1e-3, -2e-3, 0.0, 0.0, 0.0, 0.0}};
    EXPECT_EQ(*lens, expected);
}

TEST(LensFile, of_ours_reads_back_to_the_same_bits) {
    for (const double k4 : {0.0, 0.1}) {
        const Lens lens{1280,
                        720,
                        1.0 / 3.0 * 1e3,
                        700.1,
                        640.7,
                        1e-7,
                        {-0.1, 0.2 / 3.0, 1e-17, -1e20, 0.3, k4, 0.0, 0.0}};
        const Expected<Lens> again = parse_lens_yaml(lens_yaml_text(lens), "a.yml");
        ASSERT_TRUE(again) << again.error().message;
        EXPECT_EQ(*again, lens);
    }
}

TEST(LensFile, that_is_bad_is_refused_with_its_line) {
    const std::vector<std::pair<std::string, std::string>> faults = {
        {"", "a.yml: line 1: does not begin with %YAML:1.0"},
        {lens_with(kLensText, "image_width: 640", "image_width: 0"),
         "line 4: image_width must be a whole"},
        {lens_with(kLensText, "image_width", "image_with"), "has no image_width"},
        {lens_with(kLensText, "image_height", "image_width"),
         "line 5: key image_width is there twice"},
        {lens_with(kLensText, "rows: 3", "rows: 4"),
         "line 6: camera_matrix has 9 numbers, not 4 x 3"},
        {lens_with(kLensText, "5.5e+02, 0.,", "5.5e+02, 1.,"), "a skewed lens cannot be used"},
        {lens_with(kLensText, "5.5e+02", "-5.5e+02"), "a focal length that is not positive"},
        {lens_with(kLensText, "320.25", "nan"), "\"nan\" is not a number"},
        {lens_with(kLensText, "-0.25, 0.125, 1e-3", "-0.25, 0.125 1e-3"),
         "\"0.125 1e-3\" is not a number"},
        {lens_with(kLensText, "rows: 4\n   cols: 1", "rows: 1e300\n   cols: 1e300"),
         "not 1e+300 x 1e+300"},
        {lens_with(kLensText, "0., 0., 1. ]", "0., 0., 1."),
         "must be an !!opencv-matrix with rows"},
    };
    for (const auto& [text, expected] : faults) {
        const Expected<Lens> lens = parse_lens_yaml(text, "a.yml");
        ASSERT_FALSE(lens) << expected;
        EXPECT_NE(lens.error().message.find(expected), std::string::npos) << lens.error().message;
    }
}

TEST(LensFile, of_opencv_is_read) {
    const std::filesystem::path folder = test::shared_data() / "capture/opencv";
    if (!std::filesystem::is_directory(folder)) {
        GTEST_SKIP() << "skipped: no " << folder;
    }
    const Expected<Lens> left = read_lens_yaml(folder / "left_intrinsics.yml");
    ASSERT_TRUE(left) << left.error().message;
    EXPECT_EQ(left->fx, 5.3591573396163199e+02);
    EXPECT_EQ(left->distortion[4], 2.3839153080878486e-01);
    const Expected<Lens> charuco = read_lens_yaml(folder / "tutorial_camera_charuco.yml");
    ASSERT_TRUE(charuco) << charuco.error().message;
    EXPECT_EQ(charuco->cy, 2.7775155919135995e+02);
    // Two lenses in one file, without their pictures' size.
    EXPECT_FALSE(read_lens_yaml(folder / "intrinsics.yml"));
}

}  // namespace
}  // namespace raks::capture
