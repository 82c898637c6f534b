// Which joint is which bone: by all naming schemes, by tree and motion alone, and as a person says.
#include "motion/skeleton/body/joint_finder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "motion/skeleton/body/joint_report.hpp"
#include "tests/motion/skeleton/body/dancing_clip.hpp"
#include "tests/motion/skeleton/body/naming_schemes.hpp"

namespace raks::motion {
namespace joint_finder_test {

using body_test::DancingClip;

/// Every bone of the clip was found where it is, and no other but those of fingers.
void expect_all_found(const DancingClip& dancing, const FoundJoints& found, bool with_fingers) {
    for (int i = 0; i < kBoneCount; ++i) {
        const Bone bone = static_cast<Bone>(i);
        const bool is_finger =
            std::min(index_of(bone), index_of(mirrored(bone))) > index_of(Bone::left_hand) &&
            mirrored(bone) != bone;
        if (is_finger && !with_fingers) {
            continue;
        }
        const auto known = dancing.joints.find(bone);
        const auto joint = found.mapping.joint(bone);
        const auto name = [&](std::size_t at) { return dancing.clip.joints[at].name; };
        EXPECT_EQ(joint ? name(*joint) : "-",
                  known != dancing.joints.end() ? name(known->second) : "-")
            << kBoneNames[index_of(bone)];
        EXPECT_EQ(found.reasons[index_of(bone)].empty(), !joint) << kBoneNames[index_of(bone)];
        EXPECT_EQ(found.confidence[index_of(bone)] > 0.0, joint.has_value());
    }
}

std::string refusal_of(const MotionClip& clip) {
    const auto found = find_joints(clip);
    return found ? "found" : found.error().message;
}

bool has_note(const FoundJoints& found, const std::string& part) {
    return std::any_of(found.notes.begin(), found.notes.end(), [&](const std::string& note) {
        return note.find(part) != std::string::npos;
    });
}

TEST(JointFinder, knows_the_names_of_suits_sets_engines_and_programs) {
    for (const body_test::NamingScheme& scheme : body_test::naming_schemes()) {
        SCOPED_TRACE(scheme.tool);
        DancingClip dancing;
        dancing.rename(names_of(scheme));
        const auto found = find_joints(dancing.clip);
        ASSERT_TRUE(found) << found.error().message;
        expect_all_found(dancing, *found, true);
        EXPECT_TRUE(found->notes.empty()) << found->notes.front();
        for (const auto& [bone, joint] : dancing.joints) {
            EXPECT_GE(found->confidence[index_of(bone)], 0.8) << kBoneNames[index_of(bone)];
        }
    }
}

TEST(JointFinder, knows_them_with_fingers_and_helpers_between) {
    for (const body_test::NamingScheme& scheme : body_test::naming_schemes()) {
        SCOPED_TRACE(scheme.tool);
        DancingClip dancing({.fingers = true, .helpers = true});
        dancing.rename(names_of(scheme));
        const auto found = find_joints(dancing.clip);
        ASSERT_TRUE(found) << found.error().message;
        expect_all_found(dancing, *found, false);
    }
}

TEST(JointFinder, takes_the_body_of_a_model_as_its_reader_knows_it) {
    DancingClip dancing;
    KnownBody known;
    for (const auto& [bone, joint] : dancing.joints) {
        if (bone != Bone::left_hand && bone != Bone::right_hand) {
            known.mapping.joints[index_of(bone)] = joint;
            known.reasons[index_of(bone)] = "by its name";
            known.confidence[index_of(bone)] = 0.5;
        }
    }
    // Names that say otherwise are not asked.
    std::swap(dancing.clip.joints[dancing.joints[Bone::left_foot]].name,
              dancing.clip.joints[dancing.joints[Bone::right_hand]].name);
    dancing.clip.known = known;
    const auto search = search_joints(dancing.clip);
    ASSERT_TRUE(search) << search.error().message;
    EXPECT_FALSE(search->refusal) << search->refusal->message;
    EXPECT_EQ(search->found.mapping.joints, known.mapping.joints);
    EXPECT_EQ(search->found.confidence, known.confidence);
    EXPECT_TRUE(search->found.notes.empty());
}

TEST(JointFinder, needs_no_names) {
    for (const body_test::Extras& extras : {body_test::Extras{},
                                            body_test::Extras{.fingers = true},
                                            body_test::Extras{.helpers = true},
                                            body_test::Extras{.fingers = true, .helpers = true},
                                            body_test::Extras{.root = true},
                                            body_test::Extras{.feet = false}}) {
        DancingClip dancing(extras);
        dancing.forget_names();
        const auto found = find_joints(dancing.clip);
        ASSERT_TRUE(found) << found.error().message;
        expect_all_found(dancing, *found, false);
        EXPECT_TRUE(has_note(*found, "by tree and motion"));
        EXPECT_LT(found->confidence[index_of(Bone::left_upper_leg)], 0.9);
    }
}

TEST(JointFinder, does_not_ask_for_axis_unit_or_rest_pose) {
    DancingClip dancing;
    dancing.forget_names();
    // Frames of the joints turned by any angle: the rest pose is a heap, the poses are the same.
    MotionClip& clip = dancing.clip;
    const glm::dquat lying = glm::angleAxis(M_PI / 2.0, glm::dvec3(1, 0, 0));
    std::vector<glm::dquat> turns;
    for (std::size_t joint = 0; joint < clip.joints.size(); ++joint) {
        const glm::dvec3 axis(std::sin(1.0 * double(joint)), 0.5, std::cos(2.0 * double(joint)));
        turns.push_back(glm::angleAxis(2.5, glm::normalize(axis)));
    }
    const std::size_t count = clip.joints.size();
    for (std::size_t joint = 0; joint < count; ++joint) {
        const std::size_t parent = clip.joints[joint].parent;
        const glm::dquat above = parent == joint ? glm::inverse(lying) : turns[parent];
        for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
            glm::dquat& rotation = clip.rotations[frame * count + joint];
            rotation = glm::inverse(above) * rotation * turns[joint];
            glm::dvec3& position = clip.positions[frame * count + joint];
            position = 0.3937 * (glm::inverse(above) * position);
        }
        clip.joints[joint].offset = 0.3937 * (glm::inverse(above) * clip.joints[joint].offset);
        if (clip.joints[joint].end_site) {
            *clip.joints[joint].end_site =
                0.3937 * (glm::inverse(turns[joint]) * *clip.joints[joint].end_site);
        }
    }
    const auto found = find_joints(clip);
    ASSERT_TRUE(found) << found.error().message;
    expect_all_found(dancing, *found, true);
}

TEST(JointFinder, counts_the_trunk_in_its_chain_whatever_it_is_called) {
    DancingClip dancing;
    dancing.rename({{Bone::spine, "Chest3"}, {Bone::chest, "Belly"}, {Bone::upper_chest, "Waist"}});
    const auto found = find_joints(dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    expect_all_found(dancing, *found, true);
    EXPECT_EQ(found->reasons[index_of(Bone::chest)], "2 of 3 between hips and arms");
}

TEST(JointFinder, swaps_a_left_that_lies_right_and_says_so) {
    DancingClip dancing({.turned = -1.0});
    const auto found = find_joints(dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(has_note(*found, "left and right are swapped"));
    EXPECT_EQ(found->mapping.joint(Bone::left_hand), dancing.joints.at(Bone::right_hand));
    EXPECT_NE(found->reasons[index_of(Bone::left_hand)].find("swapped"), std::string::npos);
    // Names that are mirrored as well are right again.
    DancingClip twice({.turned = -1.0});
    std::map<Bone, std::string> names;
    for (const auto& [bone, joint] : twice.joints) {
        names[bone] = std::string(kBoneNames[index_of(mirrored(bone))]);
    }
    twice.rename(names);
    const auto again = find_joints(twice.clip);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_TRUE(again->notes.empty());
    EXPECT_EQ(again->mapping.joint(Bone::left_hand), twice.joints.at(Bone::right_hand));
}

TEST(JointFinder, swaps_arms_that_hang_on_the_other_legs_side) {
    DancingClip dancing;
    std::map<Bone, std::string> names;
    for (const Bone left :
         {Bone::left_shoulder, Bone::left_upper_arm, Bone::left_lower_arm, Bone::left_hand}) {
        for (const Side side : kSides) {
            names[on_side(left, side)] =
                std::string(kBoneNames[index_of(mirrored(on_side(left, side)))]);
        }
    }
    dancing.rename(names);
    const auto found = find_joints(dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    expect_all_found(dancing, *found, true);
    EXPECT_TRUE(has_note(*found, "the arms are swapped"));
}

TEST(JointFinder, does_not_believe_names_that_put_arms_on_legs) {
    DancingClip dancing;
    std::map<Bone, std::string> names;
    for (const auto& [leg, arm] : {std::pair{Bone::left_upper_leg, Bone::left_upper_arm},
                                   std::pair{Bone::left_lower_leg, Bone::left_lower_arm},
                                   std::pair{Bone::left_foot, Bone::left_hand}}) {
        for (const Side side : kSides) {
            names[on_side(leg, side)] = kBoneNames[index_of(on_side(arm, side))];
            names[on_side(arm, side)] = kBoneNames[index_of(on_side(leg, side))];
        }
    }
    dancing.rename(names);
    const auto found = find_joints(dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    expect_all_found(dancing, *found, true);
    EXPECT_TRUE(has_note(*found, "they are not believed"));
}

TEST(JointFinder, does_as_a_person_says) {
    DancingClip dancing({.helpers = true});
    dancing.clip.labels = {.joints = {{Bone::left_lower_arm, "twist"}}, .source = "--joint"};
    EXPECT_EQ(refusal_of(dancing.clip), "--joint: leftLowerArm: two joints are called \"twist\"");
    for (std::size_t joint = 0; joint < dancing.clip.joints.size(); ++joint) {
        if (dancing.clip.joints[joint].name == "twist") {
            dancing.clip.joints[joint].name = "elbow helper";
            break;
        }
    }
    dancing.clip.labels.joints[0].joint = "elbow helper";
    const auto found = find_joints(dancing.clip);
    ASSERT_TRUE(found) << found.error().message;
    const auto joint = found->mapping.joint(Bone::left_lower_arm);
    ASSERT_TRUE(joint);
    EXPECT_EQ(dancing.clip.joints[*joint].name, "elbow helper");
    EXPECT_EQ(found->reasons[index_of(Bone::left_lower_arm)], "said by --joint");
    EXPECT_EQ(found->confidence[index_of(Bone::left_lower_arm)], 1.0);
}

TEST(JointFinder, refuses_labels_that_do_not_fit_the_clip) {
    DancingClip dancing;
    dancing.clip.labels = {.joints = {{Bone::head, "haed"}}, .source = "map.toml"};
    EXPECT_EQ(refusal_of(dancing.clip),
              "map.toml: head: the clip has no joint \"haed\"; did you mean \"head\"?");
    dancing.clip.labels.joints = {{Bone::left_upper_leg, "leftFoot"},
                                  {Bone::left_foot, "leftUpperLeg"}};
    EXPECT_EQ(refusal_of(dancing.clip),
              "map.toml: leftFoot \"leftUpperLeg\" does not hang on leftUpperLeg \"leftFoot\"");
}

TEST(JointFinder, refuses_what_is_no_body_in_one_line) {
    DancingClip half({.arms = false});
    EXPECT_EQ(refusal_of(half.clip),
              "no humanoid: arms not found (found: hips, legs) among 9 joints: hips, leftUpperLeg, "
              "leftLowerLeg, leftFoot, leftToes, rightUpperLeg, rightLowerLeg, rightFoot, "
              "rightToes; half a body teaches no dance; if it has arms, say so with --joint or "
              "--joints");
    half.forget_names();
    const auto search = search_joints(half.clip);
    ASSERT_TRUE(search);
    EXPECT_TRUE(search->refusal);
    EXPECT_TRUE(search->found.mapping.joint(Bone::right_foot));

    MotionClip chain;
    for (std::size_t joint = 0; joint < 5; ++joint) {
        chain.joints.push_back({.name = std::string("b\n") + char('0' + joint),
                                .parent = joint == 0 ? 0 : joint - 1,
                                .offset = {0, 1, 0},
                                .end_site = {}});
        chain.positions.emplace_back(0, 1, 0);
        chain.rotations.emplace_back(1, 0, 0, 0);
    }
    chain.frame_count = 1;
    EXPECT_EQ(refusal_of(chain),
              "no humanoid: its 5 joints are all one chain: b?0, b?1, b?2, b?3, b?4");
}

/// The clip's trunk laid level, its arms brought down: hands and feet stand on one floor.
TEST(JointFinder, refuses_what_goes_on_four_legs) {
    DancingClip dancing;
    MotionClip& clip = dancing.clip;
    const auto rotation = [&](Bone bone, std::size_t frame) -> glm::dquat& {
        return clip.rotations[frame * clip.joints.size() + dancing.joints.at(bone)];
    };
    const glm::dquat lean = glm::angleAxis(M_PI / 2.0, glm::dvec3(1, 0, 0));
    for (std::size_t frame = 0; frame < clip.frame_count; ++frame) {
        rotation(Bone::hips, frame) = lean;
        for (const Side side : kSides) {
            glm::dquat& leg = rotation(on_side(Bone::left_upper_leg, side), frame);
            leg = glm::inverse(lean) * leg;
            const double down = side == Side::left ? -M_PI / 2.0 : M_PI / 2.0;
            rotation(on_side(Bone::left_shoulder, side), frame) = glm::inverse(lean);
            rotation(on_side(Bone::left_upper_arm, side), frame) =
                glm::angleAxis(down, glm::dvec3(0, 0, 1));
            rotation(on_side(Bone::left_lower_arm, side), frame) = glm::dquat(1, 0, 0, 0);
        }
    }
    EXPECT_EQ(refusal_of(clip), "it goes on four legs: no body that dances");
}

TEST(JointFinder, refuses_two_people_in_one_clip) {
    const DancingClip one;
    MotionClip two = one.clip;
    const std::size_t count = one.clip.joints.size();
    two.rotations.clear();
    two.positions.clear();
    for (ClipJoint joint : one.clip.joints) {
        joint.parent += count;
        joint.name = "B:" + joint.name;
        two.joints.push_back(joint);
    }
    for (std::size_t frame = 0; frame < one.clip.frame_count; ++frame) {
        for (const double away : {0.0, 120.0}) {
            for (std::size_t joint = 0; joint < count; ++joint) {
                two.rotations.push_back(one.clip.rotation(frame, joint));
                two.positions.push_back(one.clip.position(frame, joint) +
                                        glm::dvec3(joint == 0 ? away : 0.0, 0, 0));
            }
        }
    }
    EXPECT_EQ(refusal_of(two),
              "two bodies in one clip, with hips \"hips\" and \"B:hips\": keep one");
}

TEST(JointFinder, writes_a_map_that_reads_back) {
    DancingClip half({.arms = false});
    half.clip.joints.back().name = "a \"strange\"\nname";
    const auto search = search_joints(half.clip);
    ASSERT_TRUE(search);
    const std::string text = joint_map_text(half.clip, search->found.mapping);
    EXPECT_NE(text.find("leftUpperArm = \"\"\n"), std::string::npos) << text;
    const auto labels = read_joint_map(text, "map.toml");
    ASSERT_TRUE(labels) << labels.error().message;
    half.clip.labels = *labels;
    const auto again = search_joints(half.clip);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->found.mapping.joints, search->found.mapping.joints);
}

}  // namespace joint_finder_test
}  // namespace raks::motion
