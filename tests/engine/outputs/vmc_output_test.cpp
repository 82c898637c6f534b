#include "engine/outputs/vmc_output.hpp"

#include <gtest/gtest.h>
#include <oscpack/osc/OscReceivedElements.h>

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "base/random.hpp"
#include "engine/outputs/osc_packet.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/avatar_rig.hpp"
#include "tests/render/avatar/tiny_model.hpp"
#include "tests/support/peers.hpp"

namespace raks::engine {
namespace {

using motion::Bone;
using std::chrono::milliseconds;

constexpr glm::vec2 kMiddle{0.0F};

/// What a receiver has after a frame, as it came: Unity's axes.
struct Marionette {
    std::map<std::string, std::pair<glm::vec3, glm::quat>> bones;
    std::map<std::string, float> expressions;  // as applied
    glm::vec3 root{0.0F};
    int oks = 0;  // messages; the last one's value is `is_loaded`
    int is_loaded = -1;
    float seconds = -1.0F;
    std::size_t packets = 0;
    std::size_t longest = 0;  // bytes

    void take(const std::string& bytes) {
        ++packets;
        longest = std::max(longest, bytes.size());
        const osc::ReceivedBundle bundle(osc::ReceivedPacket(
            bytes.data(), static_cast<osc::osc_bundle_element_size_t>(bytes.size())));
        EXPECT_EQ(bundle.TimeTag(), 1U) << "at once";
        for (auto each = bundle.ElementsBegin(); each != bundle.ElementsEnd(); ++each) {
            take(osc::ReceivedMessage(*each));
        }
    }

 private:
    std::map<std::string, float> values_;  // not applied yet

    void take(const osc::ReceivedMessage& message) {
        const std::string address = message.AddressPattern();
        const std::string types = message.TypeTags() != nullptr ? message.TypeTags() : "";
        auto argument = message.ArgumentsBegin();
        const auto number = [&] { return (argument++)->AsFloat(); };
        if (address == "/VMC/Ext/OK") {
            EXPECT_EQ(types, "i");
            ++oks;
            is_loaded = argument->AsInt32();
        } else if (address == "/VMC/Ext/T") {
            EXPECT_EQ(types, "f");
            seconds = number();
        } else if (address == "/VMC/Ext/Blend/Val") {
            EXPECT_EQ(types, "sf");
            const std::string name = (argument++)->AsString();
            values_[name] = number();
        } else if (address == "/VMC/Ext/Blend/Apply") {
            EXPECT_EQ(types, "");
            expressions = std::exchange(values_, {});
        } else {
            EXPECT_EQ(types, "sfffffff") << address;
            const std::string name = (argument++)->AsString();
            const float x = number(), y = number(), z = number();
            const float qx = number(), qy = number(), qz = number(), qw = number();
            if (address == "/VMC/Ext/Root/Pos") {
                EXPECT_EQ(name, "root");
                root = {x, y, z};
            } else {
                EXPECT_EQ(address, "/VMC/Ext/Bone/Pos");
                bones[name] = {{x, y, z}, {qw, qx, qy, qz}};
            }
        }
    }
};

/// Unity's name of a bone, from how Unity's manual lists them.
std::string unity_name(Bone bone) {
    static const std::map<std::string, std::string> kThumbs = {
        {"leftThumbMetacarpal", "LeftThumbProximal"},
        {"leftThumbProximal", "LeftThumbIntermediate"},
        {"rightThumbMetacarpal", "RightThumbProximal"},
        {"rightThumbProximal", "RightThumbIntermediate"}};
    std::string name(motion::kBoneNames[motion::index_of(bone)]);
    if (const auto thumb = kThumbs.find(name); thumb != kThumbs.end()) {
        return thumb->second;
    }
    name[0] = static_cast<char>(std::toupper(name[0]));
    return name;
}

/// Where the bones of a marionette are, each on its humanoid parent, with the axes turned back.
std::map<Bone, glm::vec3> places_of(const Marionette& puppet) {
    std::map<Bone, glm::vec3> places;
    std::array<glm::vec3, motion::kBoneCount> at{};
    std::array<glm::quat, motion::kBoneCount> turned{};
    for (std::size_t b = 0; b < motion::kBoneCount; ++b) {
        const auto bone = static_cast<Bone>(b);
        const auto& [position, rotation] = puppet.bones.at(unity_name(bone));
        const glm::vec3 offset(-position.x, position.y, position.z);
        const glm::quat turn(rotation.w, rotation.x, -rotation.y, -rotation.z);
        const std::size_t above = motion::kBoneParents[b];
        at[b] = b == 0 ? offset : at[above] + turned[above] * offset;
        turned[b] = b == 0 ? turn : turned[above] * turn;
        places[bone] = at[b] + glm::vec3(-puppet.root.x, puppet.root.y, puppet.root.z);
    }
    return places;
}

float farthest(const std::map<Bone, glm::vec3>& got, const motion::WorldPose& expected) {
    float most = 0.0F;
    for (const auto& [bone, place] : got) {
        most = std::max(most, glm::distance(place, expected.position(bone)));
    }
    return most;
}

/// A pose in which every bone is turned, another one for each seed.
motion::Pose wild_pose(std::uint64_t seed) {
    motion::Pose pose;
    const CounterRandom random(seed);
    for (std::size_t i = 0; i < motion::kBoneCount; ++i) {
        const glm::vec3 axis(
            random.normal(3 * i), random.normal(3 * i + 1), random.normal(3 * i + 2));
        pose.local_rotations[i] = glm::angleAxis(0.5F, glm::normalize(axis));
    }
    pose.hips_position = {0.3F, 0.8F, -0.2F};
    return pose;
}

std::shared_ptr<const render::Avatar> avatar_of(const render::Model& model) {
    auto avatar = std::make_shared<render::Avatar>();
    avatar->skeleton = motion::mannequin_skeleton();
    avatar->rig = std::make_shared<render::AvatarRig>(render::build_rig(model));
    avatar->vrm = model.character.vrm;
    return avatar;
}

class Vmc : public ::testing::Test {
 protected:
    void open(const std::string& options = "") {
        auto opened = open_vmc(receiver_.place() + options);
        ASSERT_TRUE(opened) << opened.error().message;
        output_ = std::move(*opened);
    }
    /// One dancer, who keeps this pose. The music's time is 1 s.
    void dance(const motion::Pose& pose, glm::vec2 place = kMiddle, std::size_t dancer = 0) {
        stage_->published_at_ns = 1;
        stage_->dancers = dancer + 1;
        stage_->places[dancer] = place;
        stage_->tracks[dancer].clear();
        for (HopIndex hop = 90; hop < 120; ++hop) {
            stage_->tracks[dancer].append_final(hop, pose);
        }
    }
    void turn() {
        HeardLine line;
        line.clock.stream_anchor = StreamTime(std::chrono::seconds(1));
        line.clock.host_anchor = begun_;
        line.clock.is_running = true;
        OutputTurn turn{now_, line};
        turn.dancers.emplace(OutputDancers{*stage_, look_});
        output_->turn(turn);
    }
    Marionette frame() {
        now_ += milliseconds(20);
        turn();
        return received();
    }
    Marionette received() {
        Marionette puppet;
        for (const std::string& packet : receiver_.take_all()) {
            puppet.take(packet);
        }
        return puppet;
    }

    test::UdpReceiver receiver_;
    HostTime begun_ = host_now();
    HostTime now_ = begun_;
    std::unique_ptr<StageState> stage_ = std::make_unique<StageState>();
    OutputLook look_;
    std::unique_ptr<Output> output_;
};

TEST_F(Vmc, a_frame_puts_a_marionette_into_the_pose_that_is_heard) {
    open();
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        dance(wild_pose(seed));
        const Marionette puppet = frame();
        ASSERT_EQ(puppet.bones.size(), static_cast<std::size_t>(motion::kBoneCount));
        const auto expected = motion::world_pose(motion::mannequin_skeleton(), wild_pose(seed));
        EXPECT_LT(farthest(places_of(puppet), expected), 1e-3F) << seed;
        for (const auto& [name, bone] : puppet.bones) {
            EXPECT_GT(glm::length(bone.first), 1e-3F) << name << ": a place at rest is no zero";
            EXPECT_NEAR(glm::length(bone.second), 1.0F, 1e-5F) << name;
        }
        EXPECT_LE(puppet.longest, 1'200U);
        EXPECT_EQ(puppet.packets, 5U);
        EXPECT_EQ(puppet.oks, 1);
        EXPECT_EQ(puppet.is_loaded, 1);
    }
}

TEST_F(Vmc, the_pose_is_that_of_the_moment_between_two_hops_and_earlier_by_the_lead) {
    open(",lead=-30,rate=100");
    motion::Pose pose;
    dance(pose);
    stage_->tracks[0].clear();
    for (HopIndex hop = 90; hop < 120; ++hop) {
        pose.hips_position = {0.01F * static_cast<float>(hop), 1.0F, 0.0F};
        stage_->tracks[0].append_final(hop, pose);
    }
    now_ += milliseconds(55);
    turn();
    EXPECT_NEAR(received().bones.at("Hips").first.x, -1.025F, 1e-5F);
    now_ += milliseconds(16);
    turn();
    const Marionette later = received();
    EXPECT_NEAR(later.bones.at("Hips").first.x, -1.041F, 1e-5F);
    EXPECT_NEAR(later.seconds, 0.016F, 1e-6F) << "since the first frame";
}

// The table of the protocol's page on Unity's axes: a left arm that points up from -x turns to the
// right about +z.
TEST_F(Vmc, a_t_pose_has_no_rotations_and_an_arm_is_raised_as_unity_has_it) {
    open();
    motion::Pose pose;
    pose.hips_position = motion::mannequin_skeleton().offsets[0];
    dance(pose);
    for (const auto& [name, bone] : frame().bones) {
        EXPECT_NEAR(std::abs(bone.second.w), 1.0F, 1e-6F) << name;
    }
    pose.rotation(Bone::left_upper_arm) =
        glm::angleAxis(std::acos(0.0F), glm::vec3(0.0F, 0.0F, 1.0F));
    dance(pose);
    const Marionette raised = frame();
    EXPECT_NEAR(raised.bones.at("LeftUpperArm").second.z, -std::sqrt(0.5F), 1e-6F);
    EXPECT_LT(raised.bones.at("LeftHand").first.x, 0.0F) << "its left is -x";
}

TEST_F(Vmc, the_way_over_the_floor_is_told_where_it_is_asked_for) {
    const motion::Pose pose = wild_pose(1);  // at 0.3, -0.2
    const auto frame_with = [&](const std::string& options) {
        open(options);
        static_cast<void>(receiver_.take_all());
        dance(pose, {1.0F, 0.5F});
        return frame();
    };
    const auto hips = [](const Marionette& puppet) { return puppet.bones.at("Hips").first; };
    EXPECT_LT(glm::distance(hips(frame_with("")), {-0.3F, 0.8F, -0.2F}), 1e-5F);
    EXPECT_LT(glm::distance(hips(frame_with(",way=0.5")), {-0.65F, 0.8F, 0.15F}), 1e-5F)
        << "about its place";
    EXPECT_LT(glm::distance(hips(frame_with(",travel=none")), {-1.0F, 0.8F, 0.5F}), 1e-5F);
    const Marionette rooted = frame_with(",travel=root");
    EXPECT_LT(glm::distance(hips(rooted), {0.0F, 0.8F, 0.0F}), 1e-5F);
    EXPECT_LT(glm::distance(rooted.root, {-0.3F, 0.0F, -0.2F}), 1e-5F);
    EXPECT_EQ(frame_with("").root, glm::vec3(0.0F)) << "in one of both";
}

TEST_F(Vmc, the_dancer_is_turned_as_a_whole) {
    const motion::Pose pose = wild_pose(2);
    open(",yaw=90");
    dance(pose);
    auto expected = motion::world_pose(motion::mannequin_skeleton(), pose);
    for (glm::vec3& place : expected.positions) {
        place = {place.z, place.y, -place.x};
    }
    EXPECT_LT(farthest(places_of(frame()), expected), 1e-3F);
}

TEST_F(Vmc, a_vrm_is_told_so_that_its_own_bones_come_where_raks_draws_them) {
    struct Case {
        const char* name;
        render::VrmVersion vrm;
        const char* options;
        render::Model model;
    };
    for (Case& one : std::vector<Case>{
             {"0.x", render::VrmVersion::vrm0, "", render::test::humanoid_model()},
             {"1.0 raw", render::VrmVersion::vrm1, "", render::test::crooked_humanoid_model()},
             {"1.0 normalised",
              render::VrmVersion::vrm1,
              ",rotations=normalised",
              render::test::crooked_humanoid_model()}}) {
        one.model.character.vrm = one.vrm;
        one.model.character.faces_minus_z = one.vrm == render::VrmVersion::vrm0;
        const auto avatar = avatar_of(one.model);
        look_.avatars = {avatar};
        open(one.options);
        static_cast<void>(receiver_.take_all());
        const motion::Pose pose = wild_pose(3);
        dance(pose);
        const auto places = places_of(frame());
        render::RigState drawn(*avatar->rig);
        render::pose_joints(*avatar->rig, pose, 1.0F, drawn);
        for (const auto& [bone, place] : places) {
            const auto joint = static_cast<std::size_t>(avatar->rig->humanoid.joint(bone));
            EXPECT_LT(glm::distance(place, glm::vec3(drawn.joints.world[joint][3])), 1e-3F)
                << one.name << " " << unity_name(bone);
        }
    }
}

TEST_F(Vmc, raw_rotations_without_a_vrm_1_are_said_once_and_normalised) {
    open(",rotations=raw");
    dance(wild_pose(4));
    const Marionette puppet = frame();
    EXPECT_EQ(output_->take_trouble(),
              receiver_.place() +
                  ": rotations=raw needs a VRM 1.0 that is worn; they are "
                  "normalised");
    frame();
    EXPECT_FALSE(output_->take_trouble());
    EXPECT_LT(
        farthest(places_of(puppet), motion::world_pose(motion::mannequin_skeleton(), wild_pose(4))),
        1e-3F);
}

TEST_F(Vmc, faces_go_with_the_pose) {
    open();
    motion::Feeling happy;
    happy.of(motion::Emotion::happy) = 1.0F;
    dance({});
    stage_->tracks[0].clear();
    for (HopIndex hop = 90; hop < 120; ++hop) {
        stage_->tracks[0].append_final(hop, {}, happy);
    }
    const Marionette puppet = frame();
    EXPECT_EQ(puppet.expressions.size(), render::kFaceExpressionCount);
    EXPECT_GT(puppet.expressions.at("Joy"), 0.2F);
    for (const char* name :
         {"Angry", "Sorrow", "Fun", "A", "I", "U", "E", "O", "Blink", "Blink_L", "Blink_R"}) {
        EXPECT_TRUE(puppet.expressions.contains(name)) << name;
    }
    look_.face.mood = 0.0F;
    EXPECT_EQ(frame().expressions.at("Joy"), 0.0F) << "face_mood off";
}

TEST_F(Vmc, late_frames_are_left_out) {
    open(",rate=50");
    dance(wild_pose(5));
    int frames = 0;
    for (int i = 0; i < 200; ++i) {
        now_ += milliseconds(5);
        turn();
        frames += received().oks;
    }
    EXPECT_EQ(frames, 50);
    now_ += std::chrono::seconds(5);
    for (int i = 0; i < 20; ++i, now_ += milliseconds(5)) {
        turn();
        frames += received().oks;
    }
    EXPECT_EQ(frames, 55) << "nothing is made up for";
}

TEST_F(Vmc, a_dancer_who_is_not_there_is_said_once) {
    open(",dancer=2");
    dance(wild_pose(6));
    const Marionette none = frame();
    EXPECT_EQ(none.is_loaded, 0);
    EXPECT_TRUE(none.bones.empty());
    EXPECT_EQ(output_->take_trouble(),
              receiver_.place() + ": there is no dancer 2: 1 of them dance");
    frame();
    EXPECT_FALSE(output_->take_trouble());
    dance(wild_pose(7), kMiddle, 1);
    EXPECT_LT(farthest(places_of(frame()),
                       motion::world_pose(motion::mannequin_skeleton(), wild_pose(7))),
              1e-3F);
}

TEST_F(Vmc, the_end_is_told_and_leaves_no_face) {
    open();
    dance(wild_pose(8));
    frame();
    output_.reset();
    const Marionette end = received();
    EXPECT_EQ(end.is_loaded, 0);
    EXPECT_EQ(end.packets, 1U);
    EXPECT_LE(end.longest, 1'200U);
    ASSERT_EQ(end.expressions.size(), render::kFaceExpressionCount);
    for (const auto& [name, weight] : end.expressions) {
        EXPECT_EQ(weight, 0.0F) << name;
    }
    open();
    output_.reset();
    EXPECT_EQ(received().packets, 0U) << "where nothing had begun";
}

}  // namespace
}  // namespace raks::engine
