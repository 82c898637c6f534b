#include "motion/capture/camera/easymocap_rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/pending_file.hpp"
#include "motion/capture/camera/rotation.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

std::string matrix(const std::string& key, int rows, int columns, const std::string& data) {
    return fmt::format("{}: !!opencv-matrix\n  rows: {}\n  cols: {}\n  dt: d\n  data: [{}]\n",
                       key,
                       rows,
                       columns,
                       data);
}

/// The two files as EasyMocap writes them, of two cameras that look at each other's side.
const std::string kHead = "%YAML:1.0\n---\nnames:\n  - \"01\"\n  - \"left one\"\n";
const std::string kLenses =
    kHead +
    matrix("K_01", 3, 3, "1000.000000, 0.000000, 639.500000, 0.0, 1010.0, 359.5, 0., 0., 1.") +
    matrix("dist_01", 1, 5, "-0.100000, 0.020000, 0.001000, 0.002000, 0.000000") +
    matrix("K_left one", 3, 3, "900.0, 0.0, 639.5, 0.0, 900.0, 359.5, 0., 0., 1.") +
    matrix("dist_left one", 5, 1, "0., 0., 0., 0., 0.") + "H_01: 720\nW_01: 1280\n";
const std::string kPlaces = kHead + matrix("R_01", 3, 1, "0.000000, 1.570796, 0.000000") +
                            matrix("Rot_01", 3, 3, "0., 0., 1., 0., 1., 0., -1., 0., 0.") +
                            matrix("T_01", 3, 1, "0.0, 1.0, 4.0") +
                            matrix("R_left one", 3, 1, "0.0, 0.5, 0.0") +
                            matrix("T_left one", 3, 1, "0.1, 1.0, 3.0");

Expected<RigFile> parsed(const std::string& lenses, const std::string& places) {
    return parse_easymocap_rig({lenses, "intri.yml"}, {places, "extri.yml"});
}

std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

TEST(EasyMocapRig, is_read_from_both_files) {
    const auto file = parsed(kLenses, kPlaces);
    ASSERT_TRUE(file) << file.error().message;
    ASSERT_EQ(file->rig.cameras.size(), 2U);
    const Camera& first = file->rig.cameras[0];
    EXPECT_EQ(first.name, "01");
    EXPECT_EQ(first.lens,
              (Lens{1280, 720, 1000.0, 1010.0, 639.5, 359.5, {-0.1, 0.02, 1e-3, 2e-3}}));
    EXPECT_EQ(first.translation, glm::dvec3(0.0, 1.0, 4.0));
    // The matrix counts where both are there: Rodrigues' vector has six decimals.
    EXPECT_EQ(first.rotation * glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(1.0, 0.0, 0.0));
    const Camera& second = file->rig.cameras[1];
    EXPECT_EQ(second.name, "left one");
    EXPECT_EQ(second.rotation, rotation_of({0.0, 0.5, 0.0}));
    // Without a size: twice the principal point.
    EXPECT_EQ(second.lens.width, 1280);
    EXPECT_EQ(second.lens.height, 720);
}

TEST(EasyMocapRig, is_found_beside_the_file_that_is_named) {
    const test::TemporaryFolder folder;
    ASSERT_TRUE(write_file(folder / "intri.yml", kLenses));
    const auto alone = read_rig(folder / "intri.yml");
    ASSERT_FALSE(alone);
    EXPECT_NE(alone.error().message.find("extri.yml is not there"), std::string::npos);
    ASSERT_TRUE(write_file(folder / "extri.yml", kPlaces));
    for (const char* const name : {"intri.yml", "extri.yml"}) {
        const auto file = read_rig(folder / name);
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_EQ(file->rig, parsed(kLenses, kPlaces)->rig);
        // z up, if one says so.
        const auto turned = read_rig(folder / name, {.metres_per_unit = {}, .up = UpAxis::z});
        ASSERT_TRUE(turned);
        const glm::dvec3 centre = file->rig.cameras[0].centre();
        EXPECT_LT(glm::distance(turned->rig.cameras[0].centre(),
                                glm::dvec3(centre.x, centre.z, -centre.y)),
                  1e-12);
    }
}

TEST(EasyMocapRig, that_is_bad_is_refused_in_one_line) {
    const std::vector<std::pair<Expected<RigFile>, std::string>> faults = {
        {parsed("", kPlaces), "intri.yml: line 1: does not begin with %YAML"},
        {parsed(kLenses, "x"), "extri.yml: line 1: does not begin with %YAML"},
        {parsed(with(kLenses, "names:", "nomes:"), kPlaces), "intri.yml: has no names"},
        {parsed(with(kLenses, "  - \"01\"\n  - \"left one\"\n", " 12\n"), kPlaces),
         "names must be a list"},
        {parsed(with(kLenses, "K_01", "K_02"), kPlaces), "intri.yml: has no K_01"},
        {parsed(with(kLenses, "dist_left", "dust_left"), kPlaces), "has no dist_left one"},
        {parsed(with(kLenses, "W_01: 1280", "W_01: 0"), kPlaces), "W_01 must be a whole number"},
        {parsed(with(kLenses, "639.500000", "nan"), kPlaces), "\"nan\" is not a number"},
        {parsed(with(kLenses, "639.500000", "1e9"), kPlaces), "principal point outside"},
        {parsed(kLenses, with(kPlaces, "T_01", "T_1")), "extri.yml: has no T_01"},
        {parsed(kLenses, with(kPlaces, "-1., 0., 0.", "1., 0., 0.")), "mirror image"},
        {parsed(with(kLenses, "\"left one\"", "\"01\""), kPlaces), "two cameras are called \"01\""},
    };
    for (const auto& [file, part] : faults) {
        ASSERT_FALSE(file) << part;
        EXPECT_NE(file.error().message.find(part), std::string::npos) << file.error().message;
        EXPECT_EQ(file.error().message.find('\n'), std::string::npos);
    }
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        static_cast<void>(parsed(test::mangled(kLenses, {.seed = seed}), kPlaces));
        static_cast<void>(parsed(kLenses, test::mangled(kPlaces, {.seed = seed})));
    }
}

}  // namespace
}  // namespace raks::capture
