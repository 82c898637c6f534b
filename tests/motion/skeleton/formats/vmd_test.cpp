// VMD: a dance of ours there and back, curves, names, inverse kinematics, and damaged files.
#include "motion/skeleton/formats/mmd/vmd.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "motion/choreography/figure_evaluation.hpp"
#include "motion/skeleton/body/retarget.hpp"
#include "motion/skeleton/formats/mmd/mmd_clip.hpp"
#include "motion/skeleton/formats/mmd/mmd_text.hpp"
#include "motion/skeleton/formats/mmd/vmd_writer.hpp"
#include "motion/skeleton/formats/mmd/vpd.hpp"
#include "motion/skeleton/formats/motion_file.hpp"
#include "tests/motion/skeleton/formats/vmd_maker.hpp"
#include "tests/support/dances.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::motion::vmd_test {
namespace {

using raks::test::kVmdCenter;
using raks::test::kVmdLeftIndex1;
using raks::test::kVmdLeftLegIk;
using raks::test::kVmdLeftToeIk;
using raks::test::VmdMaker;

std::string name_of(MmdBone bone, MmdCode code = MmdCode::windows_932) {
    return mmd_bytes(mmd_name(bone), code).value();
}

// The first figure of a written dance.
EvaluatedFigure danced(const std::filesystem::path& file) {
    const auto dance = load_authored_dance(file);
    EXPECT_TRUE(dance) << dance.error().message;
    EvaluationOptions options;
    options.written = options.tempo = dance->written;
    options.repeats = 3;
    return evaluate_figure(dance->figures.front(), mannequin_skeleton(), options);
}

// Distances of joints, from the hips, between poses and a file that was written of them; metres,
// sorted.
std::vector<double> distances(const EvaluatedFigure& figure, MmdLegs legs) {
    const auto written =
        vmd_bytes(mannequin_skeleton(), figure.poses, figure.frames_per_second, {}, {.legs = legs});
    EXPECT_TRUE(written) << written.error().message;
    const auto clip = parse_vmd(written->bytes, "x.vmd");
    EXPECT_TRUE(clip) << clip.error().message;
    EXPECT_TRUE(clip->warnings.empty());
    const auto read = retarget(*clip, mannequin_skeleton());
    EXPECT_TRUE(read) << read.error().message;
    std::vector<double> all;
    for (std::size_t frame = 0; frame < read->poses.size(); ++frame) {
        const Pose pose = pose_between(
            figure.poses, static_cast<double>(frame) * figure.frames_per_second / kMmdRate);
        const WorldPose a = world_pose(mannequin_skeleton(), pose);
        const WorldPose b = world_pose(mannequin_skeleton(), read->poses[frame]);
        for (std::size_t bone = 1; bone < a.positions.size(); ++bone) {
            all.push_back(static_cast<double>(glm::length((a.positions[bone] - a.positions[0]) -
                                                          (b.positions[bone] - b.positions[0]))));
        }
    }
    std::sort(all.begin(), all.end());
    return all;
}

// The promise of the round trip: mean 5 mm, 99 of 100 within 15 mm.
TEST(Vmd, a_dance_comes_back_as_it_was_written) {
    for (const auto& file : raks::test::written_dances()) {
        const EvaluatedFigure figure = danced(file);
        for (const MmdLegs legs : {MmdLegs::ik, MmdLegs::fk}) {
            const std::vector<double> far = distances(figure, legs);
            double sum = 0.0;
            for (const double each : far) {
                sum += each;
            }
            const double mean = sum / static_cast<double>(far.size());
            const double p99 = far[far.size() * 99 / 100];
            RecordProperty(file.stem().string(), std::to_string(p99));
            EXPECT_LT(mean, 0.005) << file;
            EXPECT_LT(p99, 0.015) << file;
        }
    }
}

// A body's motion of some keys, one section a call.
VmdMaker small_motion() {
    VmdMaker maker;
    maker.count(3)
        .bone(kVmdCenter, 0, {0, 0, 0})
        .bone(kVmdCenter, 10, {1, 2, 3}, {0, 0.70710678F, 0, 0.70710678F})
        .bone(name_of(MmdBone::left_arm), 4, {0, 0, 0}, {0, 0, 0.5F, 0.8660254F});
    maker.count(1).morph(mmd_bytes("あ", MmdCode::windows_932).value(), 5, 0.75F);
    maker.count(0).count(0).count(0);  // camera, light, shadow
    maker.count(1).switches(0, {{kVmdLeftLegIk, false}, {kVmdLeftToeIk, false}});
    return maker;
}

MotionClip clip_of(const VmdMaker& maker) {
    auto clip = parse_vmd(maker.bytes(), "x.vmd");
    EXPECT_TRUE(clip) << clip.error().message;
    return clip ? std::move(*clip) : MotionClip();
}

std::string fault_of(const std::string& bytes) {
    const auto clip = parse_vmd(bytes, "x.vmd");
    return clip ? "read" : clip.error().message;
}

void expect_near(const glm::dvec3& place, const glm::dvec3& truth, double bound = 1e-5) {
    EXPECT_LT(glm::length(place - truth), bound)
        << place.x << " " << place.y << " " << place.z << " for " << truth.x << " " << truth.y
        << " " << truth.z;
}

TEST(Vmd, names_are_the_bytes_that_the_format_publishes) {
    EXPECT_EQ(name_of(MmdBone::center), kVmdCenter);
    EXPECT_EQ(name_of(MmdBone::left_leg_ik), kVmdLeftLegIk);
    EXPECT_EQ(name_of(MmdBone::left_toe_ik), kVmdLeftToeIk);
    EXPECT_EQ(name_of(MmdBone::left_index1), kVmdLeftIndex1);
    EXPECT_EQ(mmd_bytes("ｳｨﾝｸ２右", MmdCode::windows_932)->substr(0, 4), "\xB3\xA8\xDD\xB8");
    EXPECT_EQ(narrow("左足ＩＫ"), "左足IK");
    EXPECT_EQ(wide("左足IK親"), "左足ＩＫ親");
    // All bones, in all codes, cut as a file cuts them, and followed by what was there before.
    for (std::size_t i = 0; i < kMmdBones; ++i) {
        const auto bone = static_cast<MmdBone>(i);
        for (const MmdCode code : kMmdCodes) {
            std::string bytes = name_of(bone, code).substr(0, kMmdNameBytes);
            if (left_of(bone) == MmdBone::left_waist_cancel && code == MmdCode::utf8) {
                EXPECT_EQ(mmd_bone_named(bytes), std::nullopt);  // its side is cut off
                continue;
            }
            EXPECT_EQ(mmd_bone_named(bytes), bone) << mmd_name(bone);
            bytes.resize(std::min(bytes.size() + 1, kMmdNameBytes), '\0');
            bytes.resize(kMmdNameBytes, 'x');
            EXPECT_EQ(mmd_bone_named(bytes), bone) << mmd_name(bone);
        }
        for (const std::string& spelling : {narrow(mmd_name(bone)), wide(mmd_name(bone))}) {
            EXPECT_EQ(mmd_bone_named(mmd_bytes(spelling, MmdCode::windows_932)->substr(0, 15)),
                      bone)
                << spelling;
        }
    }
    EXPECT_EQ(mmd_bone_named(kVmdLeftLegIk.substr(0, 5)), std::nullopt);  // half a character
    EXPECT_EQ(mmd_bone_named(""), std::nullopt);
}

TEST(Vmd, curves_are_those_of_their_channel_and_never_of_the_first_rows_overwritten_bytes) {
    // Straight, and one that is at x, y = 0.5 at its middle and slow at both ends.
    EXPECT_EQ(mmd_progress({}, 0.3), 0.3);
    const MmdCurve slow = {64, 0, 64, 127};
    EXPECT_NEAR(mmd_progress(slow, 0.5), 0.5, 0.01);
    EXPECT_LT(mmd_progress(slow, 0.1), 0.04);
    EXPECT_GT(mmd_progress(slow, 0.9), 0.96);
    EXPECT_EQ(mmd_progress(slow, 0.0), 0.0);
    EXPECT_EQ(mmd_progress(slow, 1.0), 1.0);
    // (0, 127) and (0, 127): x = t^3 and y = 1 - (1 - t)^3 at t = 1 / 2.
    EXPECT_NEAR(mmd_progress({0, 127, 0, 127}, 0.125), 0.875, 1e-6);

    std::array<std::uint8_t, 64> curves{};
    VmdMaker::set_curve(curves, 0, {20, 20, 107, 107});
    VmdMaker::set_curve(curves, 1, {0, 127, 0, 127});
    VmdMaker::set_curve(curves, 2, {127, 0, 127, 0});
    VmdMaker::set_curve(curves, 3, {64, 0, 64, 127});
    curves[2] = 99;  // physics off
    curves[3] = 15;
    VmdMaker maker;
    maker.count(2)
        .bone(kVmdCenter, 0, {0, 0, 0})
        .bone(kVmdCenter, 8, {8, 8, 8}, {0, 0.70710678F, 0, 0.70710678F}, curves);
    const auto file = read_vmd(maker.bytes());
    ASSERT_TRUE(file);
    MmdSampler sampler(file->motion);
    const MmdPose pose = sampler.pose_at(1);
    const std::size_t center = index_of(MmdBone::center);
    // An eighth of the time: an eighth of x, seven of y, and of z what mirrors y.
    expect_near(pose.places[center] / kMmdMetres,
                {1.0, 7.0, -8.0 * mmd_progress({127, 0, 127, 0}, 0.125)},
                1e-4);
    const double turned = glm::degrees(glm::angle(pose.turns[center]));
    EXPECT_NEAR(turned, 90.0 * mmd_progress(slow, 0.125), 0.01);
}

TEST(Vmd, axes_units_and_turns_become_ours) {
    VmdMaker maker;
    // The file's figure faces -z, so that a step ahead is one along -z; a turn about y by a quarter
    // in its left-handed axes leads -z to -x.
    maker.count(1).bone(kVmdCenter, 0, {0, 0, -12.5F}, {0, 0.70710678F, 0, 0.70710678F});
    const MotionClip clip = clip_of(maker);
    ASSERT_EQ(clip.frame_count, 1U);
    EXPECT_EQ(clip.frames_per_second, 30.0);
    EXPECT_NEAR(clip.position(0, 0).z, 1.0, 1e-5);
    expect_near(clip.rotation(0, 0) * glm::dvec3(0.0, 0.0, 1.0), {-1.0, 0.0, 0.0});
}

TEST(Vmd, arms_hang_at_rest_as_the_option_says) {
    VmdMaker maker;
    maker.count(1).bone(kVmdCenter, 0, {0, 0, 0});
    for (const double angle : {27.0, 35.0, 0.0}) {
        const auto clip = parse_vmd(maker.bytes(), "x.vmd", angle);
        ASSERT_TRUE(clip);
        const ClipWorldPose world = world_pose(*clip, 0);
        const glm::dvec3 arm = world.positions[index_of(Bone::left_hand)] -
                               world.positions[index_of(Bone::left_upper_arm)];
        EXPECT_NEAR(glm::degrees(std::atan2(-arm.y, arm.x)), angle, 1e-6);
    }
}

TEST(Vmd, legs_reach_their_goals_with_the_knee_ahead_and_switches_turn_that_off) {
    const auto made = [](bool is_on) {
        VmdMaker maker;
        // The body sinks by 0.24 m and the left foot's goal goes 0.16 m ahead.
        maker.count(2).bone(kVmdCenter, 0, {0, -3, 0}).bone(kVmdLeftLegIk, 0, {0, 0, -2});
        maker.count(0).count(0).count(0).count(0);
        maker.count(2)
            .switches(0, {{kVmdLeftLegIk, is_on}, {kVmdLeftToeIk, is_on}})
            .switches(5, {{kVmdLeftLegIk, !is_on}});
        return maker;
    };
    const auto ankle_of = [](const MotionClip& clip, std::size_t frame) {
        return world_pose(clip, frame).positions[index_of(Bone::left_foot)];
    };
    const MmdBody body;
    const glm::dvec3 rest = body.world({}).place(MmdBone::left_ankle);
    const MotionClip on = clip_of(made(true));
    expect_near(ankle_of(on, 0), rest + glm::dvec3(0.0, 0.0, 0.16), 1e-4);
    const ClipWorldPose world = world_pose(on, 0);
    const glm::dvec3 hip = world.positions[index_of(Bone::left_upper_leg)];
    const glm::dvec3 knee = world.positions[index_of(Bone::left_lower_leg)];
    EXPECT_GT(knee.z, 0.5 * (hip.z + ankle_of(on, 0).z));
    // The sole stays flat: the foot's goal is not turned.
    expect_near(world.rotations[index_of(Bone::left_foot)] * glm::dvec3(0, 1, 0), {0, 1, 0}, 0.02);

    const MotionClip off = clip_of(made(false));
    expect_near(ankle_of(off, 0), rest - glm::dvec3(0.0, 0.24, 0.0), 1e-5);
    // The right leg has no switch: its solver is on.
    EXPECT_NEAR(world_pose(off, 0).positions[index_of(Bone::right_foot)].y, rest.y, 1e-4);
}

TEST(Vmd, a_switch_holds_from_its_frame_on) {
    VmdMaker maker;
    maker.count(2).bone(kVmdCenter, 0, {0, -3, 0}).bone(kVmdCenter, 9, {0, -3, 0});
    maker.count(0).count(0).count(0).count(0);
    maker.count(2).switches(5, {{kVmdLeftLegIk, false}}).switches(0, {{kVmdLeftLegIk, true}});
    const MotionClip clip = clip_of(maker);
    const auto height = [&](std::size_t frame) {
        return world_pose(clip, frame).positions[index_of(Bone::left_foot)].y;
    };
    EXPECT_NEAR(height(4), 0.0787, 1e-3);
    EXPECT_NEAR(height(5), 0.0787 - 0.24, 1e-3);
}

TEST(Vmd, helpers_hand_their_turns_on) {
    const MmdBody body;
    const glm::dquat turn = glm::angleAxis(0.4, glm::normalize(glm::dvec3(0.2, 0.5, 1.0)));
    MmdPose pose;
    pose.leg_ik = pose.toe_ik = {false, false};
    pose.turns[index_of(MmdBone::left_shoulder_p)] = turn;
    pose.turns[index_of(MmdBone::waist)] = turn;
    pose.turns[index_of(MmdBone::left_leg)] = turn;
    const MmdWorld world = body.world(pose);
    const auto expect_turn = [&](MmdBone bone, const glm::dquat& truth) {
        EXPECT_GT(std::abs(glm::dot(world.turn(bone), truth)), 1.0 - 1e-12) << mmd_name(bone);
    };
    // The shoulder turns and the arm keeps its turn; so do the waist and the legs.
    expect_turn(MmdBone::left_shoulder, turn * turn);
    expect_turn(MmdBone::left_arm, turn);
    expect_turn(MmdBone::lower_body, turn);
    expect_turn(on_side(MmdBone::left_leg, Side::right), glm::dquat(1, 0, 0, 0));
    expect_turn(MmdBone::left_leg_d, turn);
    // A twist turns about the arm alone.
    MmdPose twist;
    twist.turns[index_of(MmdBone::left_arm_twist)] = glm::angleAxis(0.5, glm::dvec3(1.0, 0.0, 0.0));
    EXPECT_LT(glm::length(body.world(twist).place(MmdBone::left_elbow) -
                          body.world({}).place(MmdBone::left_elbow)),
              1e-9);
}

TEST(Vmd, morphs_become_expressions) {
    const MotionClip clip = clip_of(small_motion());
    ASSERT_EQ(clip.expressions.size(), 1U);
    EXPECT_EQ(clip.expressions[0].name, "aa");
    ASSERT_EQ(clip.expressions[0].weights.size(), clip.frame_count);
    EXPECT_EQ(clip.expressions[0].weights[0], 0.75F);  // held before its first key
}

TEST(Vmd, keys_in_any_order_say_the_same_and_the_later_of_two_counts) {
    VmdMaker sorted;
    sorted.count(3)
        .bone(kVmdCenter, 0, {0, 0, 0})
        .bone(kVmdCenter, 5, {1, 0, 0})
        .bone(kVmdCenter, 10, {4, 0, 0});
    VmdMaker mixed;
    mixed.count(4)
        .bone(kVmdCenter, 10, {4, 0, 0})
        .bone(kVmdCenter, 5, {9, 0, 0})
        .bone(kVmdCenter, 0, {0, 0, 0})
        .bone(kVmdCenter, 5, {1, 0, 0});
    const MotionClip a = clip_of(sorted);
    const MotionClip b = clip_of(mixed);
    ASSERT_EQ(a.frame_count, b.frame_count);
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        EXPECT_EQ(a.positions[i], b.positions[i]);
    }
}

TEST(Vmd, old_files_end_after_any_section) {
    VmdMaker old = VmdMaker::old();
    old.count(1).bone(kVmdCenter, 3, {1, 1, 1});
    EXPECT_EQ(clip_of(old).frame_count, 4U);
    old.count(0);
    EXPECT_EQ(clip_of(old).frame_count, 4U);
}

TEST(Vmd, a_file_cut_anywhere_is_read_to_a_sections_end_or_refused_in_one_line) {
    const std::string whole = small_motion().bytes();
    // Behind the bones, the morphs, the camera, the light and the shadow.
    const std::size_t bones = 50 + 4 + 3 * 111;
    const std::vector<std::size_t> ends = {
        bones, bones + 4 + 23, bones + 8 + 23, bones + 12 + 23, bones + 16 + 23};
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const std::string said = fault_of(whole.substr(0, size));
        const bool is_end = std::find(ends.begin(), ends.end(), size) != ends.end();
        EXPECT_EQ(said == "read", is_end) << size << ": " << said;
        EXPECT_EQ(said.find('\n'), std::string::npos);
    }
    EXPECT_EQ(fault_of(whole), "read");
    const auto more = parse_vmd(whole + "more", "x.vmd");
    ASSERT_TRUE(more);
    EXPECT_EQ(more->warnings, std::vector<std::string>{"4 bytes behind its end are left out"});
}

TEST(Vmd, damaged_files_are_refused_with_what_is_wrong) {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const struct {
        VmdMaker maker;
        const char* part;
    } rows[] = {
        {VmdMaker().count(0xFFFFFFFFU).bone(kVmdCenter, 0, {0, 0, 0}),
         "x.vmd: declares 4294967295 keys of its bones, but bytes for 1 are there"},
        {VmdMaker().count(1).bone(kVmdCenter, 7, {0, none, 0}),
         "x.vmd: センター at frame 7: a number is not finite"},
        {VmdMaker().count(1).bone(kVmdCenter, 7, {0, 0, 0}, {none, 0, 0, 1}), "not finite"},
        {VmdMaker().count(1).bone(kVmdCenter, 7, {0, 3e7F, 0}), "impossibly large"},
        {VmdMaker().count(1).bone(kVmdCenter, 4'000'000'000U, {0, 0, 0}), "more than an hour"},
        {VmdMaker().count(0).count(0).count(1).camera(0, -45, {0, 10, 0}, {0, 0, 0}, 30),
         "moves a camera, not a body; give it as --camera-motion"},
        {VmdMaker().count(0).count(1).morph(mmd_bytes("あ", MmdCode::windows_932).value(), 0, 1),
         "moves a face alone"},
        {VmdMaker().count(1).bone("hair", 0, {0, 0, 0}),
         "holds no key of a body's bone; 1 keys of 1 bones that are none of a body"},
        {VmdMaker()
             .count(1)
             .bone(kVmdCenter, 0, {0, 0, 0})
             .count(0)
             .count(0)
             .count(0)
             .count(0)
             .count(1)
             .put(std::uint32_t{0})
             .put(std::uint8_t{1})
             .count(77),
         "ends within its switches"},
    };
    for (const auto& row : rows) {
        const std::string said = fault_of(row.maker.bytes());
        EXPECT_NE(said.find(row.part), std::string::npos) << row.part << ": " << said;
    }
    // No turn at all is none; what is of no use may be anything.
    EXPECT_EQ(fault_of(VmdMaker()
                           .count(2)
                           .bone(kVmdCenter, 0, {0, 0, 0}, {0, 0, 0, 0})
                           .bone("hair", 0, {none, 0, 0})
                           .bytes()),
              "read");
}

TEST(Vmd, a_long_dance_keeps_to_the_keys_that_mikumikudance_holds) {
    const EvaluatedFigure figure = danced(raks::test::written_dances().front());
    const std::vector<Pose>& poses = figure.poses;
    const auto fine = vmd_bytes(mannequin_skeleton(), poses, 60.0);
    ASSERT_TRUE(fine);
    EXPECT_EQ(fine->doublings, 0);
    EXPECT_LT(fine->keys, poses.size() / 2 * 54);  // one a bone and frame
    const auto coarse = vmd_bytes(
        mannequin_skeleton(), poses, 60.0, {}, {.place_tolerance = 0.01, .turn_tolerance = 0.05});
    ASSERT_TRUE(coarse);
    EXPECT_LT(coarse->keys, fine->keys / 2);
    // A body that stands still has a key a bone.
    const std::vector<Pose> still(1000, poses.front());
    const auto one = vmd_bytes(mannequin_skeleton(), still, 60.0);
    ASSERT_TRUE(one);
    EXPECT_LE(one->keys, kMmdBones);
    EXPECT_FALSE(vmd_bytes(mannequin_skeleton(), {}, 60.0));
}

TEST(Vmd, faces_are_written_as_morphs_and_read_again) {
    const std::vector<Pose> poses(61);
    std::vector<float> weights(61, 0.0F);
    std::fill(weights.begin() + 20, weights.begin() + 40, 1.0F);
    const std::vector<ExpressionTrack> face = {{"happy", true, weights},
                                               {"browUpLeft", false, weights}};
    const auto written = vmd_bytes(mannequin_skeleton(), poses, 60.0, face);
    ASSERT_TRUE(written);
    const auto clip = parse_vmd(written->bytes, "x.vmd");
    ASSERT_TRUE(clip) << clip.error().message;
    ASSERT_EQ(clip->expressions.size(), 1U);
    EXPECT_EQ(clip->expressions[0].name, "happy");
    EXPECT_EQ(clip->expressions[0].weights[5], 0.0F);
    EXPECT_EQ(clip->expressions[0].weights[15], 1.0F);
}

const std::string kVpd =
    "Vocaloid Pose Data file\r\n\r\ntest.osm;\t\t// name\r\n2;\t\t\t\t// bones\r\n\r\nBone0{" +
    kVmdCenter +
    "\r\n  0.000000,-1.000000,0.000000;\t\t\t\t// trans x,y,z\r\n"
    "  0.000000,0.000000,0.000000,1.000000;\t\t// Quaternion x,y,z,w\r\n}\r\n\r\nBone1{hair\r\n"
    "  0,0,0;\r\n  0,0,0,1;\r\n}\r\n\r\n";

TEST(Vpd, a_pose_is_a_clip_of_one_frame) {
    const auto file = parse_motion(kVpd, {"x.vpd", ""}, {});
    ASSERT_TRUE(file) << file.error().message;
    const auto& clip = std::get<MotionClip>(*file);
    EXPECT_EQ(clip.frame_count, 1U);
    EXPECT_EQ(clip.warnings.size(), 1U);
    // The body sinks by a unit, and its feet stay on the floor, as near as 40 rounds lead from legs
    // that are straight.
    const ClipWorldPose world = world_pose(clip, 0);
    EXPECT_NEAR(world.positions[0].y, 0.9383 - 0.08, 1e-4);
    EXPECT_NEAR(world.positions[index_of(Bone::left_foot)].y, 0.0787, 3e-3);
}

TEST(Vpd, damaged_poses_are_refused_with_their_line) {
    for (std::size_t size = 0; size < kVpd.size(); ++size) {
        const auto clip = parse_vpd(kVpd.substr(0, size), "x.vpd");
        if (!clip) {
            EXPECT_EQ(clip.error().message.find('\n'), std::string::npos);
        }
    }
    std::string bad = kVpd;
    bad.replace(bad.find("-1.000000"), 9, "nan");
    const auto clip = parse_vpd(bad, "x.vpd");
    ASSERT_FALSE(clip);
    EXPECT_EQ(clip.error().message.rfind("x.vpd: line 7: has not the 3 numbers", 0), 0U)
        << clip.error().message;
}

TEST(Vmd, models_of_mikumikudance_are_refused_with_a_way_out) {
    for (const std::string start : {"PMX \x01", "Pmd\x01"}) {
        const auto file = parse_motion(start + std::string(100, '\0'), {"x.pmx", ""}, {});
        ASSERT_FALSE(file);
        EXPECT_NE(file.error().message.find("convert it to VRM"), std::string::npos);
    }
}

}  // namespace
}  // namespace raks::motion::vmd_test
