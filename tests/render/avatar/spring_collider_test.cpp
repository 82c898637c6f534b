#include "render/avatar/spring_collider.hpp"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace raks::render {
namespace {

struct PushCase {
    const char* name;
    JointCollider collider;
    glm::vec3 place;
    glm::vec3 direction;
    float distance;
};

const PushCase kCases[] = {
    {"beside a sphere",
     {.offset = {0, 1, 0}, .radius = 0.5F},
     {2, 1, 0},
     {1, 0, 0},
     2.0F - 0.5F - 0.1F},
    {"in a sphere", {.radius = 0.5F}, {0, 0.2F, 0}, {0, 1, 0}, 0.2F - 0.5F - 0.1F},
    {"beside a capsule",
     {.shape = ColliderShape::capsule, .tail = {0, 2, 0}, .radius = 0.5F},
     {0.3F, 1, 0},
     {1, 0, 0},
     0.3F - 0.5F - 0.1F},
    {"beyond a capsule's end",
     {.shape = ColliderShape::capsule, .tail = {0, 2, 0}, .radius = 0.5F},
     {0, 3, 0},
     {0, 1, 0},
     1.0F - 0.5F - 0.1F},
    {"a capsule without length is a sphere",
     {.shape = ColliderShape::capsule, .radius = 0.5F},
     {0, 3, 0},
     {0, 1, 0},
     3.0F - 0.5F - 0.1F},
    {"within an inside sphere",
     {.shape = ColliderShape::inside_sphere, .radius = 0.5F},
     {0, 0.2F, 0},
     {0, -1, 0},
     0.5F - 0.1F - 0.2F},
    {"out of an inside sphere",
     {.shape = ColliderShape::inside_sphere, .radius = 0.5F},
     {0, 0.6F, 0},
     {0, -1, 0},
     0.5F - 0.1F - 0.6F},
    {"out of an inside capsule",
     {.shape = ColliderShape::inside_capsule, .tail = {0, 2, 0}, .radius = 0.5F},
     {0.6F, 1, 0},
     {-1, 0, 0},
     0.5F - 0.1F - 0.6F},
    {"below a plane",
     {.shape = ColliderShape::plane, .offset = {0, 1, 0}, .normal = {0, 2, 0}},
     {5, 0.5F, 5},
     {0, 1, 0},
     -0.5F - 0.1F},
};

TEST(SpringCollider, spheres_leave_each_shape_by_the_shortest_way) {
    for (const PushCase& c : kCases) {
        const Push push = push_of(c.collider, glm::mat4(1.0F), c.place, 0.1F);
        EXPECT_NEAR(push.distance, c.distance, 1e-6F) << c.name;
        EXPECT_LT(glm::distance(push.direction, c.direction), 1e-6F) << c.name;
    }
}

TEST(SpringCollider, shapes_go_with_their_joints) {
    const glm::mat4 joint = glm::rotate(glm::translate(glm::mat4(1.0F), glm::vec3(0, 1, 0)),
                                        glm::radians(90.0F),
                                        glm::vec3(0, 0, 1));
    for (const PushCase& c : kCases) {
        const glm::vec3 place(joint * glm::vec4(c.place, 1.0F));
        const Push push = push_of(c.collider, joint, place, 0.1F);
        EXPECT_NEAR(push.distance, c.distance, 1e-5F) << c.name;
        EXPECT_LT(glm::distance(push.direction, glm::vec3(joint * glm::vec4(c.direction, 0.0F))),
                  1e-5F)
            << c.name;
    }
}

TEST(SpringCollider, in_the_very_middle_no_direction_leads_out) {
    const Push push = push_of({.radius = 1.0F}, glm::mat4(1.0F), glm::vec3(0.0F), 0.1F);
    EXPECT_GE(push.distance, 0.0F);
}

}  // namespace
}  // namespace raks::render
