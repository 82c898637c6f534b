#include "apps/xbody/spring_view.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

#include "apps/xbody/node_kinds.hpp"
#include "apps/xbody/sight.hpp"
#include "apps/xbody/skeleton_view.hpp"
#include "render/avatar/joint_tree.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using render::ColliderShape;

/// Collects what is seen.
class SpringLook {
 public:
    SpringLook(const ShownModel& model, const ShownPose& shown, Sight sight)
        : model_(model), shown_(shown), sight_(sight) {}

    SeenSprings look() {
        const render::Character& character = model_.figure.model.character;
        for (const render::SpringCollider& collider : character.colliders) {
            add(collider);
        }
        for (const render::SpringChain& chain : character.springs) {
            add(chain);
        }
        return std::move(seen_);
    }

 private:
    // None: the node is not shown.
    [[nodiscard]] const glm::mat4* world_of(int node) const {
        const int joint = model_.avatar->rig->tree.joint_of(node);
        return joint < 0 ? nullptr : &shown_.state.joints.world[static_cast<std::size_t>(joint)];
    }

    void add_ring(const glm::vec3& place, float metres, bool is_collider) {
        if (const auto at = sight_.place_of(place)) {
            seen_.rings.push_back({*at, metres * sight_.units_of_metre(place), is_collider});
        }
    }
    void add_line(const glm::vec3& from, const glm::vec3& to, bool is_collider) {
        const auto first = sight_.place_of(from);
        const auto last = sight_.place_of(to);
        if (first && last) {
            seen_.lines.push_back({*first, *last, is_collider});
        }
    }

    void add(const render::SpringCollider& collider) {
        const glm::mat4* const world = world_of(collider.node);
        if (world == nullptr) {
            return;
        }
        const float metres = collider.radius * render::scale_of(*world);
        const glm::vec3 place(*world * glm::vec4(collider.offset, 1.0F));
        if (collider.shape == ColliderShape::plane) {
            constexpr float kArrow = 0.15F;  // metres
            const glm::vec3 normal(*world * glm::vec4(collider.normal, 0.0F));
            const float length = glm::length(normal);
            add_ring(place, 0.02F, true);
            if (length > 0.0F) {
                add_line(place, place + kArrow / length * normal, true);
            }
            return;
        }
        add_ring(place, metres, true);
        if (collider.shape == ColliderShape::capsule ||
            collider.shape == ColliderShape::inside_capsule) {
            const glm::vec3 tail(*world * glm::vec4(collider.tail, 1.0F));
            add_ring(tail, metres, true);
            add_sides(place, tail, metres);
        }
    }

    // The two sides of a capsule, as they are seen.
    void add_sides(const glm::vec3& from, const glm::vec3& to, float metres) {
        const auto first = sight_.place_of(from);
        const auto last = sight_.place_of(to);
        if (!first || !last || !(glm::distance(*first, *last) > 1.0F)) {
            return;
        }
        const glm::vec2 along = glm::normalize(*last - *first);
        const glm::vec2 across(-along.y, along.x);
        const glm::vec2 here = metres * sight_.units_of_metre(from) * across;
        const glm::vec2 there = metres * sight_.units_of_metre(to) * across;
        seen_.lines.push_back({*first + here, *last + there, true});
        seen_.lines.push_back({*first - here, *last - there, true});
    }

    void add(const render::SpringChain& chain) {
        const glm::mat4* before = nullptr;
        for (const render::SpringJoint& joint : chain.joints) {
            const glm::mat4* const world = world_of(joint.node);
            if (world == nullptr) {
                continue;
            }
            const glm::vec3 place((*world)[3]);
            add_ring(place, joint.hit_radius * render::scale_of(*world), false);
            if (before != nullptr) {
                add_line(glm::vec3((*before)[3]), place, false);
            }
            before = world;
        }
    }

    const ShownModel& model_;
    const ShownPose& shown_;
    Sight sight_;
    SeenSprings seen_;
};

}  // namespace

SeenSprings seen_springs(const ShownModel& model,
                         const ShownPose& shown,
                         const render::Camera& camera,
                         const render::Box& box) {
    return SpringLook(model, shown, Sight(camera, box)).look();
}

void draw_springs(const render::PaneFrame& frame, const SeenSprings& springs) {
    constexpr float kSmallest = 2.0F;  // units
    const auto colour = [](bool is_collider) {
        return colour_of(is_collider ? NodeKind::collider : NodeKind::spring);
    };
    for (const SeenLine& line : springs.lines) {
        frame.pen.line(line.from.x, line.from.y, line.to.x, line.to.y, colour(line.is_collider));
    }
    for (const SeenRing& ring : springs.rings) {
        frame.pen.ring(
            ring.at.x, ring.at.y, std::max(ring.radius, kSmallest), colour(ring.is_collider));
    }
}

}  // namespace raks::apps
