// What a shot shows, whatever the picture's format.
#include "render/scene/shot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "tests/render/scene/staged_music.hpp"

namespace raks::render {
namespace {

constexpr float kFormats[] = {21.0F / 9.0F, 16.0F / 9.0F, 1.0F, 9.0F / 16.0F, 0.4F};
constexpr ShotSize kAllSizes[] = {ShotSize::wide,
                                  ShotSize::low,
                                  ShotSize::full,
                                  ShotSize::knees_up,
                                  ShotSize::upper_body,
                                  ShotSize::face,
                                  ShotSize::feet};

/// From -1 to 1, as OpenGL has it.
glm::vec2 place_in_picture(const Camera& camera, glm::vec3 at, float aspect) {
    const glm::vec4 clip = camera.clip_from_world(aspect) * glm::vec4(at, 1.0F);
    return {clip.x / clip.w, clip.y / clip.w};
}

DancersRoom room_of(std::initializer_list<glm::vec3> places) {
    DancersRoomKeeper keeper;
    return keeper.advance(people_at(places));
}

/// Of the outline, at the box's lower and upper side.
std::vector<glm::vec3> corners_of(const ShotView& view) {
    std::vector<glm::vec3> corners;
    for (const glm::vec2 corner : view.outline) {
        corners.emplace_back(corner.x, view.box.low.y, corner.y);
        corners.emplace_back(corner.x, view.box.high.y, corner.y);
    }
    return corners;
}

TEST(DancersRoom, has_an_outline_around_all_joints_that_is_nowhere_wider_than_its_box) {
    const auto people = people_at({{-0.4F, 0, 0.3F}, {0.5F, 0, 0.7F}});
    const DancersRoom room = DancersRoomKeeper().advance(people);
    for (int i = 0; i < 64; ++i) {
        const float angle = 0.1F * static_cast<float>(i);
        const glm::vec2 along(std::cos(angle), std::sin(angle));
        float outline = -9.0F;
        for (const glm::vec2 corner : room.outline) {
            outline = std::max(outline, glm::dot(corner, along));
        }
        float box = -9.0F;
        for (const glm::vec2 corner : outline_of(room.body)) {
            box = std::max(box, glm::dot(corner, along));
        }
        EXPECT_LE(outline, box + 0.02F) << angle;
        for (const motion::WorldPose& dancer : people) {
            for (const motion::Bone bone : {motion::Bone::left_hand,
                                            motion::Bone::right_hand,
                                            motion::Bone::head,
                                            motion::Bone::left_foot}) {
                const glm::vec3 at = dancer.position(bone);
                EXPECT_GT(outline, glm::dot(glm::vec2(at.x, at.z), along) + 0.05F);
            }
        }
    }
}

TEST(Shot, shows_its_whole_box_in_every_format_from_every_direction) {
    const DancersRoom rooms[] = {room_of({{0, 0, 0}}),
                                 room_of({{-0.4F, 0, 0.3F}, {0.5F, 0, 0.7F}}),
                                 room_of({{-1.3F, 0, 0}, {0, 0, 0}, {1.3F, 0, 0}})};
    for (const DancersRoom& room : rooms) {
        for (const ShotSize size : kAllSizes) {
            for (const float yaw : {-1.3F, -0.4F, 0.0F, 0.2F, 1.2F}) {
                for (const float aspect : kFormats) {
                    const ShotView view = view_of(size, room, yaw);
                    const Camera camera = camera_of(view, aspect);
                    for (const glm::vec3 at : corners_of(view)) {
                        const glm::vec2 seen = place_in_picture(camera, at, aspect);
                        const float most = 1.001F - 2.0F * view.margin;
                        const float aside =
                            1.001F - 2.0F * std::min(view.margin, ShotView::kSideMargin);
                        EXPECT_LE(std::abs(seen.x), aside) << name_of(size) << " " << aspect;
                        EXPECT_LE(std::abs(seen.y), most) << name_of(size) << " " << aspect;
                    }
                }
            }
        }
    }
}

TEST(Shot, stands_no_further_than_its_box_needs) {
    const DancersRoom room = room_of({{0.2F, 0, -0.3F}});
    for (const ShotSize size : kAllSizes) {
        for (const float aspect : kFormats) {
            const ShotView view = view_of(size, room, 0.3F);
            Camera nearer = camera_of(view, aspect);
            nearer.distance *= 0.97F;
            bool is_cut = false;
            for (const glm::vec3 at : corners_of(view)) {
                const glm::vec2 seen = place_in_picture(nearer, at, aspect);
                const float most = 1.0F - 2.0F * view.margin;
                const float aside = 1.0F - 2.0F * std::min(view.margin, ShotView::kSideMargin);
                is_cut = is_cut || std::abs(seen.x) > aside || std::abs(seen.y) > most;
            }
            EXPECT_TRUE(is_cut) << name_of(size) << " " << aspect;
        }
    }
}

TEST(Shot, is_nearer_the_less_of_the_body_it_shows) {
    const DancersRoom room = room_of({{0, 0, 0}});
    const float wide = 16.0F / 9.0F;
    float last = 100.0F;
    for (const ShotSize size : {ShotSize::wide,
                                ShotSize::full,
                                ShotSize::knees_up,
                                ShotSize::upper_body,
                                ShotSize::face}) {
        const Camera camera = camera_of(view_of(size, room, 0.1F), wide);
        const float height = camera.distance * std::tan(0.5F * camera.vertical_fov);
        EXPECT_LT(height, 0.9F * last) << name_of(size);
        last = height;
    }
}

TEST(Shot, cuts_bodies_where_it_means_to) {
    const auto body = people_at({{0, 0, 0}}).front();
    const DancersRoom room = room_of({{0, 0, 0}});
    const auto height_of = [&](ShotSize size, motion::Bone bone) {
        const Camera camera = camera_of(view_of(size, room, 0.1F), 16.0F / 9.0F);
        return place_in_picture(camera, body.position(bone), 16.0F / 9.0F).y;
    };
    using motion::Bone;
    EXPECT_GT(height_of(ShotSize::full, Bone::left_foot), -1.0F);
    EXPECT_LT(height_of(ShotSize::knees_up, Bone::left_foot), -1.05F) << "no feet";
    EXPECT_GT(height_of(ShotSize::knees_up, Bone::left_lower_leg), -1.0F) << "the knees";
    EXPECT_LT(height_of(ShotSize::upper_body, Bone::left_lower_leg), -1.2F);
    EXPECT_GT(height_of(ShotSize::upper_body, Bone::spine), -1.0F) << "the waist";
    EXPECT_GT(height_of(ShotSize::feet, Bone::left_foot), -1.0F);
    EXPECT_GT(height_of(ShotSize::feet, Bone::head), 1.5F);
}

TEST(Shot, asks_for_width_where_the_picture_is_too_narrow) {
    const DancersRoom one = room_of({{0, 0, 0}});
    const DancersRoom three = room_of({{-1.3F, 0, 0}, {0, 0, 0}, {1.3F, 0, 0}});
    EXPECT_EQ(width_demand(view_of(ShotSize::full, one, 0.0F), 16.0F / 9.0F), 1.0F);
    EXPECT_GT(width_demand(view_of(ShotSize::upper_body, one, 0.0F), 9.0F / 16.0F), 1.5F);
    EXPECT_GT(width_demand(view_of(ShotSize::upper_body, three, 0.0F), 16.0F / 9.0F), 1.5F);
}

TEST(DancersRoom, stays_still_around_who_dances_on_the_spot) {
    DancersRoomKeeper keeper;
    StageBox least{glm::vec3(9.0F), glm::vec3(9.0F)};
    StageBox most{glm::vec3(-9.0F), glm::vec3(-9.0F)};
    for (int hop = 0; hop < 1200; ++hop) {
        const float x = 0.2F * std::sin(0.06F * static_cast<float>(hop));
        const StageBox& box = keeper.advance(people_at({{x, 0, 0}})).body;
        if (hop > 400) {
            least = {glm::min(least.low, box.low), glm::min(least.high, box.high)};
            most = {glm::max(most.low, box.low), glm::max(most.high, box.high)};
        }
    }
    EXPECT_LT(most.low.x - least.low.x, 0.06F) << "of steps of 0.4 m";
    EXPECT_LT(most.high.x - least.high.x, 0.06F);
}

TEST(DancersRoom, goes_along_with_who_travels_without_a_kink) {
    DancersRoomKeeper keeper;
    glm::vec3 last{};
    glm::vec3 last_step{};
    for (int hop = 0; hop < 2000; ++hop) {
        // From hop 100 on toward the camera, a metre a second: as fast as a walk.
        const float z = 0.01F * static_cast<float>(std::clamp(hop - 100, 0, 250));
        const auto people = people_at({{0, 0, z}});
        const DancersRoom& room = keeper.advance(people);
        const float toe = people.front().position(motion::Bone::left_foot).z;
        EXPECT_GT(room.body.high.z, toe + 0.05F) << hop;
        const glm::vec3 step = room.body.high - last;
        if (hop > 2) {
            EXPECT_LT(std::abs(step.z - last_step.z), 0.001F) << hop << ": 10 m/s^2";
        }
        last = room.body.high;
        last_step = step;
    }
    EXPECT_NEAR(last.z, 2.5F + 0.45F, 0.1F) << "it is back where the dancer is";
}

}  // namespace
}  // namespace raks::render
