// Acclaim: where a bone's joint is, what it turns about, which skeleton belongs to which motion,
// and CMU's salsa lead against the other conversion of the same take.
#include "motion/skeleton/formats/acclaim.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <variant>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::motion::acclaim_test {
namespace {

const std::string kAsf = R"(# two bones: up, then to the left
:version 1.10
:units
  mass 1.0
  length 0.45
  angle deg
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name trunk
     direction 0 1 0
     length 2
     axis 0 0 0 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
  end
  begin
     id 2
     name arm
     direction 1 0 0
     length 3
     axis 0 0 90 XYZ
    dof rx
  end
:hierarchy
  begin
    root trunk
    trunk arm
  end
)";
const std::string kAmc = R"(#!OML:ASF F:\x\DANCER.ASF
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 0 90 0
trunk 0 0 0
arm 0
2
root 0 0 0 0 0 0
trunk 90 0 90
arm 90
)";

std::string with(const std::string& text, const std::string& from, const std::string& to) {
    std::string changed = text;
    const std::size_t at = changed.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? changed : changed.replace(at, from.size(), to);
}

Expected<MotionClip> clip_of(const std::string& asf, const std::string& amc) {
    const auto skeleton = parse_asf(asf, "x.asf");
    if (!skeleton) {
        return fail(skeleton.error());
    }
    return parse_amc(amc, "x.amc", *skeleton, 60.0);
}

void expect_near(const glm::dvec3& place, const glm::dvec3& truth) {
    EXPECT_NEAR(glm::length(place - truth), 0.0, 1e-9)
        << place.x << " " << place.y << " " << place.z;
}

TEST(Acclaim, bones_begin_where_their_parents_end_and_turn_about_their_own_axes) {
    const auto clip = clip_of(kAsf, kAmc);
    ASSERT_TRUE(clip) << clip.error().message;
    ASSERT_EQ(clip->joints.size(), 3U);
    EXPECT_EQ(clip->frame_count, 2U);
    EXPECT_EQ(clip->frames_per_second, 60.0);
    EXPECT_NEAR(*clip->metres_per_unit, 0.0254 / 0.45, 1e-15);
    const auto tip = [&](std::size_t frame) {
        const ClipWorldPose world = world_pose(*clip, frame);
        return world.positions[2] + world.rotations[2] * *clip->joints[2].end_site;
    };
    // A quarter turn about y leads from +x to -z.
    expect_near(world_pose(*clip, 0).positions[2], {1.0, 4.0, 3.0});
    expect_near(tip(0), {1.0, 4.0, 0.0});
    // The trunk: first about x, up to ahead (+z), then about z, which leaves it. The arm's own x is
    // the world's y at rest, so that +x turns to -z there; the trunk turns that to +y, then to -x.
    expect_near(world_pose(*clip, 1).positions[2], {0.0, 0.0, 2.0});
    expect_near(tip(1), {-3.0, 0.0, 2.0});
}

TEST(Acclaim, radians_and_units_of_others_are_as_the_files_say) {
    const auto clip = clip_of(
        with(with(kAsf, "angle deg", "angle rad"), "0 0 90 XYZ", "0 0 1.5707963267948966 XYZ"),
        with(with(with(kAmc, ":DEGREES", ":RADIANS"),
                  "90 0 90",
                  "1.5707963267948966 0 1.5707963267948966"),
             "arm 90",
             "arm 1.5707963267948966"));
    ASSERT_TRUE(clip) << clip.error().message;
    const ClipWorldPose world = world_pose(*clip, 1);
    expect_near(world.positions[2] + world.rotations[2] * *clip->joints[2].end_site,
                {-3.0, 0.0, 2.0});
    EXPECT_EQ(parse_asf(with(kAsf, "length 0.45", "length 1.0"), "x")->metres_per_unit,
              std::nullopt);
}

TEST(Acclaim, without_a_rate_one_is_taken_and_said) {
    const auto clip = parse_amc(kAmc, "x.amc", parse_asf(kAsf, "x.asf").value(), std::nullopt);
    ASSERT_TRUE(clip);
    EXPECT_EQ(clip->frames_per_second, 120.0);
    EXPECT_EQ(
        clip->warnings,
        std::vector<std::string>{"says no frame rate: 120 a second are taken (--fps sets it)"});
}

TEST(Acclaim, what_does_not_fit_is_refused_with_its_line) {
    const struct {
        std::string asf;
        std::string amc;
        const char* part;
    } rows[] = {
        {"", kAmc, "x.asf: has no bones"},
        {"hello", kAmc, "x.asf: line 1: is not an Acclaim skeleton"},
        {with(kAsf, "trunk arm", "trunk leg"), kAmc, "line 34: there is no bone \"leg\""},
        {with(kAsf, "trunk arm", "trunk arm\narm trunk"),
         kAmc,
         "line 35: the bone \"trunk\" has two parents"},
        {with(kAsf, "root trunk\n", ""), kAmc, "2 of its 2 bones do not hang on the root"},
        {with(kAsf, "length 3", ""), kAmc, "the bone \"arm\" needs a direction and a length"},
        {with(kAsf, "length 3", "length nan"), kAmc, "\"nan\""},
        {with(kAsf, "dof rx\n", "dof qx\n"), kAmc, "\"qx\" is not a degree of freedom"},
        {with(kAsf, "90 XYZ", "90 XYW"), kAmc, "\"XYW\" is not an order of axes, such as xyz"},
        {with(kAsf, "name arm", "name trunk"), kAmc, "line 34: there is no bone \"arm\""},
        {kAsf, with(kAmc, "arm 0", "leg 0"), "x.amc: line 7: the skeleton has no bone \"leg\""},
        {kAsf, with(kAmc, "arm 0\n", ""), "frame 1 has no numbers for the bone \"arm\""},
        {kAsf, with(kAmc, "arm 0", "arm 0 1"), "more than its 1 numbers"},
        {kAsf, with(kAmc, "trunk 0 0 0", "trunk 0 0"), "\"\" is not a number"},
        {kAsf, with(kAmc, "1\nroot", "root"), "a frame's number is expected"},
        {kAsf, ":DEGREES\n", "has no frames"},
    };
    for (const auto& row : rows) {
        const auto clip = clip_of(row.asf, row.amc);
        const std::string said = clip ? "read" : clip.error().message;
        EXPECT_NE(said.find(row.part), std::string::npos) << row.part << ": " << said;
    }
}

TEST(Acclaim, the_skeleton_that_belongs_to_a_motion_is_found) {
    const raks::test::TemporaryFolder folder;
    const auto amc = folder / "60_01.amc";
    ASSERT_TRUE(write_file(amc, kAmc));
    const auto message = [&] {
        const auto file = read_motion(amc, {});
        return file ? "read" : file.error().message;
    };
    EXPECT_NE(message().find("needs its skeleton, an .asf; none lie beside it: name it with "
                             "--skeleton"),
              std::string::npos)
        << message();
    // The only one; then by the name that the motion says; by the prefix; by the whole name.
    std::string last;
    for (const char* name : {"a.asf", "b.asf", "dancer.asf", "60.ASF", "60_01.asf"}) {
        ASSERT_TRUE(write_file(folder / name, kAsf));
        const auto found = find_asf(amc, kAmc);
        if (std::string(name) == "b.asf") {
            EXPECT_NE(message().find("2 lie beside it"), std::string::npos);
            continue;
        }
        ASSERT_TRUE(found) << found.error().message;
        EXPECT_EQ(found->filename(), name);
    }
    MotionReadOptions options;
    options.skeleton = folder / "none.asf";
    EXPECT_FALSE(read_motion(amc, options));
}

// The salsa lead of take 01 in its original form, against the clip of the same take that was
// brought to another body: the ankles agree within what that left (1.2 to 1.4 cm rms).
TEST(Acclaim, cmus_salsa_lead_stands_where_the_other_conversion_stands) {
    const auto folder = raks::test::shared_data() / "mocap";
    const raks::test::TemporaryFolder unpacked;
    const auto unpack = [&](const std::string& archive, const std::string& files) {
        const std::string command = "tar -xJf '" + (folder / archive).string() + "' -C '" +
                                    unpacked.path().string() + "' --occurrence=1 " + files;
        return is_there(folder / archive) && std::system(command.c_str()) == 0;  // NOLINT
    };
    if (!unpack("other/cmu_other.tar.xz", "other/60.asf other/60_01.amc") ||
        !unpack("salsa/salsa.tar.xz", "60_01.bvh")) {
        GTEST_SKIP() << "no captures in " << folder;
    }
    const auto original = read_skeleton_motion(unpacked / "other/60_01.amc", {});
    const auto other = read_skeleton_motion(unpacked / "60_01.bvh", {});
    ASSERT_TRUE(original) << original.error().message;
    ASSERT_TRUE(other) << other.error().message;
    ASSERT_EQ(original->frame_count, other->frame_count);
    const auto joint = [](const MotionClip& clip, const std::string& name) {
        const auto found = std::find_if(clip.joints.begin(),
                                        clip.joints.end(),
                                        [&](const auto& each) { return each.name == name; });
        return static_cast<std::size_t>(found - clip.joints.begin());
    };
    constexpr double kOtherUnit = 1.267;  // metres, measured beforehand
    double sum = 0.0;
    glm::dvec3 mean(0.0);
    int count = 0;
    // In the first frames the other conversion leaves its rest pose.
    for (std::size_t frame = 10; frame < original->frame_count; frame += 10) {
        const ClipWorldPose a = world_pose(*original, frame);
        const ClipWorldPose b = world_pose(*other, frame);
        for (const auto& [bone, name] :
             {std::pair("lfoot", "lFoot"), std::pair("rfoot", "rFoot")}) {
            const glm::dvec3 way =
                *original->metres_per_unit * a.positions[joint(*original, bone)] -
                kOtherUnit * b.positions[joint(*other, name)];
            sum += glm::dot(way, way);
            mean += way;
            ++count;
        }
    }
    EXPECT_LT(std::sqrt(sum / count), 0.02);
    EXPECT_LT(glm::length(mean / static_cast<double>(count)), 0.015);
}

}  // namespace
}  // namespace raks::motion::acclaim_test
