#include "engine/show/dancer_face.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/show/danced_faces.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::engine {
namespace {

using render::FaceExpression;

const motion::Skeleton& skeleton() { return motion::mannequin_skeleton(); }

motion::Pose standing() {
    motion::Pose pose;
    pose.hips_position = skeleton().offsets[0];
    return pose;
}

StreamTime at(double seconds) { return stream_time_from_seconds(seconds); }

struct Blink {
    double start = 0.0;   // more than half shut
    double length = 0.0;  // s
};

std::vector<Blink> blinks_of(std::uint64_t seed, double seconds) {
    std::vector<Blink> blinks;
    bool is_shut = false;
    for (double t = 0.0; t < seconds; t += 0.001) {
        const bool was_shut = is_shut;
        is_shut = blink_at(at(t), seed) > 0.5F;
        if (is_shut && !was_shut) {
            blinks.push_back({.start = t});
        } else if (!is_shut && was_shut) {
            blinks.back().length = t - blinks.back().start;
        }
    }
    return blinks;
}

TEST(DancerFace, blinks_are_2_to_6_s_apart_and_0_1_to_0_2_s_long) {
    for (const std::uint64_t seed : {1U, 2U, 77U}) {
        const std::vector<Blink> blinks = blinks_of(seed, 120.0);
        EXPECT_EQ(blinks.size(), 30U);
        for (std::size_t i = 0; i < blinks.size(); ++i) {
            EXPECT_GT(blinks[i].length, 0.095) << i;
            EXPECT_LT(blinks[i].length, 0.205) << i;
            if (i > 0) {
                EXPECT_GT(blinks[i].start - blinks[i - 1].start, 1.99) << i;
                EXPECT_LT(blinks[i].start - blinks[i - 1].start, 6.01) << i;
            }
        }
    }
}

TEST(DancerFace, each_seed_blinks_at_times_of_its_own_and_always_the_same) {
    const std::vector<Blink> one = blinks_of(1, 20.0);
    const std::vector<Blink> again = blinks_of(1, 20.0);
    const std::vector<Blink> other = blinks_of(2, 20.0);
    ASSERT_EQ(one.size(), other.size());
    EXPECT_EQ(one[3].start, again[3].start);
    EXPECT_NE(one[3].start, other[3].start);
}

float mouth_after(const std::vector<float>& levels, double step, FaceHabits habits = {}) {
    DancerFace face(1, habits);
    float mouth = 0.0F;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        const FaceMoment moment{.time = at(step * static_cast<double>(i)),
                                .level_dbfs = levels[i],
                                .loudness_lufs = -14.0F};
        mouth = face.face_at(moment, skeleton(), standing()).weight(FaceExpression::aa);
    }
    return mouth;
}

TEST(DancerFace, the_mouth_opens_with_what_is_louder_than_the_rest) {
    const float quiet = mouth_after({-30, -30, -30}, 0.05);
    const float middle = mouth_after({-13, -13, -13}, 0.05);
    const float loud = mouth_after({-5, -5, -5}, 0.05);
    EXPECT_EQ(quiet, 0.0F);
    EXPECT_GT(middle, 0.05F);
    EXPECT_GT(loud, 1.5F * middle);
    EXPECT_LE(loud, 0.5F);
}

TEST(DancerFace, the_mouth_does_not_leap_and_shows_the_same_at_any_rate_of_pictures) {
    const std::vector<float> slow = {-30, -5, -5};
    const std::vector<float> fast = {-30, -5, -5, -5, -5};
    // From the second picture on it is loud, 40 ms in both.
    const float a = mouth_after({-30, -5}, 0.04);
    DancerFace face(1);
    float b = 0.0F;
    for (int i = 0; i <= 4; ++i) {
        const FaceMoment moment{
            .time = at(0.01 * i), .level_dbfs = i == 0 ? -30.0F : -5.0F, .loudness_lufs = -14.0F};
        b = face.face_at(moment, skeleton(), standing()).weight(FaceExpression::aa);
    }
    EXPECT_NEAR(a, b, 1e-5F);
    EXPECT_LT(a, 0.6F * mouth_after(slow, 1.0));
    EXPECT_EQ(mouth_after(slow, 10.0), mouth_after(fast, 10.0));
}

TEST(DancerFace, without_music_the_mouth_is_shut) {
    DancerFace face(1);
    const FaceMoment silence{.time = at(1.0)};
    EXPECT_EQ(face.face_at(silence, skeleton(), standing()).weight(FaceExpression::aa), 0.0F);
}

TEST(DancerFace, the_eyes_follow_what_is_before_them_and_leave_what_is_behind) {
    const glm::vec3 head = head_place(skeleton(), standing());
    EXPECT_NEAR(head.y, 1.5F, 0.1F);
    const auto gaze_to = [&](const glm::vec3& towards) {
        DancerFace face(1);
        return face.face_at({.gaze_target = head + towards}, skeleton(), standing()).gaze;
    };
    EXPECT_EQ(gaze_to({0, 0, 3}), 1.0F);
    EXPECT_EQ(gaze_to({1, 0, 2}), 1.0F);
    EXPECT_EQ(gaze_to({0, 0, -3}), 0.0F);
    EXPECT_EQ(gaze_to({3, 0, 0}), 0.0F);
    const float beside = gaze_to({1.9F, 0, 1});
    EXPECT_GT(beside, 0.0F);
    EXPECT_LT(beside, 1.0F);
}

// A track whose head turns by so many degrees within 0.1 s, from the middle on.
motion::PoseTrack turning(float degrees) {
    motion::PoseTrack track;
    for (HopIndex hop = 0; hop < 60; ++hop) {
        const float share = std::clamp((static_cast<float>(hop) - 30.0F) / 10.0F, 0.0F, 1.0F);
        motion::Pose pose = standing();
        const float half = 0.5F * share * degrees * static_cast<float>(M_PI) / 180.0F;
        pose.rotation(motion::Bone::head) = {std::cos(half), 0.0F, std::sin(half), 0.0F};
        track.append_final(hop, pose);
    }
    return track;
}

TEST(DancerFace, the_eyes_go_before_the_head) {
    const motion::PoseTrack track = turning(60.0F);
    const glm::vec3 head = head_place(skeleton(), standing());
    DancerFace face(1);
    const auto eyes_at = [&](double seconds) {
        const FaceMoment moment{.time = at(seconds),
                                .gaze_target = head + glm::vec3(0, 0, 3),
                                .head = head_turn_at(track, at(seconds))};
        return face.face_at(moment, skeleton(), track.at(at(seconds))).gaze_target - head;
    };
    EXPECT_LT(eyes_at(0.10).x, 0.01F) << "at who watches";
    EXPECT_GT(eyes_at(0.28).x, 1.5F) << "to the left, while the head is still";
    EXPECT_EQ(track.at(at(0.28)).rotation(motion::Bone::head), motion::kNoRotation);
}

TEST(DancerFace, a_far_turn_of_the_head_makes_it_blink_once) {
    for (const float degrees : {15.0F, 20.0F, 30.0F, 90.0F, 170.0F}) {
        const motion::PoseTrack track = turning(degrees);
        int shut = 0;
        bool was_shut = false;
        for (int i = 0; i < 390; ++i) {
            const bool is_shut = head_turn_at(track, at(0.001 * i)).blink > 0.5F;
            shut += is_shut && !was_shut ? 1 : 0;
            was_shut = is_shut;
        }
        EXPECT_EQ(shut, degrees > 25.0F ? 1 : 0) << degrees;
    }
}

render::Face face_of(const motion::Feeling& feeling, FaceHabits habits = {}) {
    DancerFace face(1, habits);
    return face.face_at({.feeling = feeling}, skeleton(), standing());
}

TEST(DancerFace, shows_what_is_felt_as_much_as_the_mood_says) {
    motion::Feeling feeling;
    feeling.of(motion::Emotion::happy) = 0.5F;
    feeling.brows = -0.5F;
    feeling.teeth = 1.0F;
    const render::Face shown = face_of(feeling);
    EXPECT_EQ(shown.weight(FaceExpression::happy), 0.5F);
    EXPECT_EQ(shown.weight(FaceExpression::brow_up_right), 0.5F);
    EXPECT_EQ(shown.weight(FaceExpression::brow_up_left), 0.0F);
    EXPECT_GT(shown.weight(FaceExpression::ee), 0.5F);
    const auto happy = [&](std::string_view mood) {
        return face_of(feeling, {.mood = mood_size(mood)}).weight(FaceExpression::happy);
    };
    EXPECT_EQ(happy("off"), 0.0F);
    EXPECT_LT(happy("calm"), happy("normal"));
    EXPECT_LT(happy("normal"), happy("stage"));
}

TEST(DancerFace, of_a_couple_looks_at_the_partner_and_at_the_audience_when_it_wants) {
    const glm::vec3 head = head_place(skeleton(), standing());
    const glm::vec3 partner = head + glm::vec3(0.3F, 0.0F, 1.0F);
    const glm::vec3 camera = head + glm::vec3(-0.5F, 0.0F, 5.0F);
    const auto looks_at = [&](float audience, bool has_met) {
        DancerFace face(1);
        motion::Feeling feeling;
        feeling.of(motion::Emotion::happy) = 0.4F;
        feeling.audience = audience;
        return face
            .face_at(
                {.gaze_target = camera, .feeling = feeling, .partner = partner, .has_met = has_met},
                skeleton(),
                standing())
            .gaze_target;
    };
    EXPECT_LT(glm::distance(looks_at(0.0F, false), partner), 1e-4F);
    EXPECT_LT(glm::distance(looks_at(1.0F, false), camera), 1e-4F);
    EXPECT_LT(glm::distance(looks_at(1.0F, true), partner), 1e-4F) << "hands have met";
}

TEST(CollectFaces, makes_a_face_at_an_even_rate_and_tracks_of_what_is_shown) {
    CollectFaces faces(10.0, {.blinks = false, .moves_mouth = false});
    motion::PoseTrack track;
    for (HopIndex hop = 0; hop < 100; ++hop) {
        motion::Feeling feeling;
        feeling.of(motion::Emotion::sad) = 0.01F * static_cast<float>(hop);
        track.append_final(hop, standing(), feeling);
        faces.advance({}, std::span(&track, 1));
    }
    const std::vector<render::Face> made = faces.of(0, 12);
    ASSERT_EQ(made.size(), 12U);
    for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_NEAR(made[i].weight(FaceExpression::sad), 0.1F * static_cast<float>(i), 1e-4F);
        EXPECT_EQ(made[i].gaze, 0.0F);
    }
    EXPECT_EQ(made[11].weights, made[9].weights) << "the last one is repeated";
    const auto tracks = expression_tracks(made);
    ASSERT_EQ(tracks.size(), 1U);
    EXPECT_EQ(tracks[0].name, "sad");
    EXPECT_TRUE(tracks[0].is_preset);
    EXPECT_EQ(tracks[0].weights.size(), 12U);
    EXPECT_EQ(faces.of(7, 3).size(), 3U) << "of nobody: at rest";
}

TEST(DancerFace, every_habit_can_be_switched_off) {
    const FaceMoment moment{
        .level_dbfs = 0.0F, .loudness_lufs = -14.0F, .gaze_target = {0, 1.5F, 9}};
    DancerFace still(1, {.blinks = false, .moves_mouth = false, .gazes = false});
    for (int i = 0; i < 600; ++i) {
        FaceMoment now = moment;
        now.time = at(0.01 * i);
        const render::Face face = still.face_at(now, skeleton(), standing());
        EXPECT_TRUE(std::all_of(
            face.weights.begin(), face.weights.end(), [](float w) { return w == 0.0F; }));
        EXPECT_EQ(face.gaze, 0.0F);
    }
}

TEST(DancerFace, making_a_face_is_real_time_safe) {
    DancerFace face(1);
    const motion::Pose pose = standing();
    test::RealtimeScope scope;
    for (int i = 0; i < 100; ++i) {
        static_cast<void>(face.face_at({.time = at(0.01 * i)}, skeleton(), pose));
    }
    EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
}

}  // namespace
}  // namespace raks::engine
