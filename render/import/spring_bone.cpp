// What swings: VRMC_springBone 1.0 with VRMC_springBone_extended_collider, and secondaryAnimation
// of VRM 0.x. A chain that cannot be right is left out with a warning, never the model.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "render/import/lenient.hpp"
#include "render/import/node_tree.hpp"
#include "render/import/vrm_parts.hpp"

#include <glm/geometric.hpp>

namespace raks::render {
namespace {

// What it costs to move a model has a bound: richest known, 28 joints and 8 colliders.
constexpr std::size_t kMostColliders = 1024;
constexpr std::size_t kMostSwinging = 2048;
constexpr std::size_t kMostChains = 2000;  // of a file; the test set has one of 800

constexpr NumberLimits kRadius{0.0F, 1000.0F, 0.0F};  // in the file's unit
constexpr NumberLimits kPlace{-10'000.0F, 10'000.0F, 0.0F};
constexpr NumberLimits kStiffness{0.0F, 1000.0F, 1.0F};
constexpr NumberLimits kGravity{-1000.0F, 1000.0F, 0.0F};
constexpr NumberLimits kDrag{0.0F, 1.0F, 0.5F};
constexpr NumberLimits kDirection{-1000.0F, 1000.0F, 0.0F};

/// Adds chains to the model and keeps the rules that both versions share.
class Springs {
 public:
    explicit Springs(Model& model)
        : model_(model), tree_(model), swings_(model.nodes.size(), false) {}

    [[nodiscard]] const TreeOrder& tree() const noexcept { return tree_; }
    [[nodiscard]] bool swings(int node) const { return swings_[static_cast<std::size_t>(node)]; }
    /// Whether a chain was refused because there are too many joints: none is added after that.
    [[nodiscard]] bool is_full() const noexcept { return is_full_; }

    /// Adds a chain whose joints run from the root to the tip; complains at `from` where one of
    /// them swings already or there are too many.
    void add(const JsonField& from, SpringChain chain) {
        const std::size_t swinging = chain.joints.size() - (chain.has_virtual_tail ? 0 : 1);
        if (swinging == 0) {
            return;  // a tail alone: nothing moves, and nothing is wrong
        }
        for (std::size_t i = 0; i < swinging; ++i) {
            if (swings(chain.joints[i].node)) {
                from.complain(fmt::format("its node {} swings in another spring already",
                                          chain.joints[i].node));
                return;
            }
        }
        is_full_ = is_full_ || joints_ + swinging > kMostSwinging;
        if (is_full_) {
            from.complain(fmt::format("there are more than {} joints that swing", kMostSwinging));
            return;
        }
        joints_ += swinging;
        for (std::size_t i = 0; i < swinging; ++i) {
            swings_[static_cast<std::size_t>(chain.joints[i].node)] = true;
        }
        keep_center(from, chain);
        model_.character.springs.push_back(std::move(chain));
    }

    /// Adds a collider; -1 with a fault where there are too many.
    int add(const JsonField& from, const SpringCollider& collider) {
        std::vector<SpringCollider>& all = model_.character.colliders;
        if (all.size() == kMostColliders) {
            from.complain(fmt::format("there are more than {} colliders", kMostColliders));
            return -1;
        }
        all.push_back(collider);
        return static_cast<int>(all.size() - 1);
    }

 private:
    /// A center must carry the chain: it is its first joint or lies above it.
    void keep_center(const JsonField& from, SpringChain& chain) {
        const int first = chain.joints.front().node;
        if (chain.center >= 0 && chain.center != first && !tree_.is_below(first, chain.center)) {
            warn(model_, from.line("its center does not carry it, so that it swings without one"));
            chain.center = -1;
        }
    }

    Model& model_;
    TreeOrder tree_;
    std::vector<bool> swings_;  // by node
    std::size_t joints_ = 0;
    bool is_full_ = false;
};

// ---- VRM 1.0

SpringCollider read_sphere(const JsonField& sphere, Model& model) {
    SpringCollider collider;
    const bool is_inside = lenient_truth(sphere["inside"], false, model);
    collider.shape = is_inside ? ColliderShape::inside_sphere : ColliderShape::sphere;
    collider.offset = lenient_vector(sphere["offset"], kPlace, glm::vec3(0.0F), model);
    collider.radius = lenient_number(sphere["radius"], kRadius, model);
    return collider;
}

SpringCollider read_capsule(const JsonField& capsule, Model& model) {
    SpringCollider collider = read_sphere(capsule, model);
    collider.shape = collider.shape == ColliderShape::inside_sphere ? ColliderShape::inside_capsule
                                                                    : ColliderShape::capsule;
    collider.tail = lenient_vector(capsule["tail"], kPlace, glm::vec3(0.0F), model);
    return collider;
}

SpringCollider read_plane(const JsonField& plane, Model& model) {
    SpringCollider collider;
    collider.shape = ColliderShape::plane;
    collider.offset = lenient_vector(plane["offset"], kPlace, glm::vec3(0.0F), model);
    collider.normal = lenient_vector(plane["normal"], kDirection, {0.0F, 0.0F, 1.0F}, model);
    const float length = glm::length(collider.normal);
    if (length < 1.0e-6F) {
        plane["normal"].complain("has no direction");
    } else {
        collider.normal /= length;
    }
    return collider;
}

/// The shape of a collider: of the extension where it is there, else the plain one.
SpringCollider read_shape(const JsonField& from, Model& model) {
    const JsonField extended = from["extensions"]["VRMC_springBone_extended_collider"];
    const bool is_extended = extended["shape"].is_object() && is_known_version(extended, model);
    const JsonField shape = is_extended ? extended["shape"] : from["shape"];
    if (shape["sphere"].exists()) {
        return read_sphere(shape["sphere"], model);
    }
    if (shape["capsule"].exists()) {
        return read_capsule(shape["capsule"], model);
    }
    if (is_extended && shape["plane"].exists()) {
        return read_plane(shape["plane"], model);
    }
    shape.complain("is not a shape that is known");
    return {};
}

/// Place in Character::colliders of each collider of the file; -1: left out.
std::vector<int> read_colliders(const JsonField& colliders, Springs& springs, Model& model) {
    std::vector<int> places;
    for (const JsonField& from : colliders.items()) {
        SpringCollider collider;
        int place = -1;
        if (read_part(from, model, [&](const JsonField& own) {
                collider = read_shape(own, model);
                collider.node = own["node"].index(model.nodes.size());
            })) {
            const bool is_added = read_part(
                from, model, [&](const JsonField& own) { place = springs.add(own, collider); });
            static_cast<void>(is_added);
        }
        places.push_back(place);
    }
    return places;
}

/// Colliders of each group of the file.
std::vector<std::vector<int>> read_groups(const JsonField& groups,
                                          const std::vector<int>& places,
                                          Model& model) {
    std::vector<std::vector<int>> all;
    for (const JsonField& from : groups.items()) {
        std::vector<int>& group = all.emplace_back();
        const bool is_good = read_part(from, model, [&](const JsonField& own) {
            for (const JsonField& collider : own["colliders"].items(kMostColliders)) {
                const int index = collider.index(places.size());
                if (!places.empty() && places[static_cast<std::size_t>(index)] >= 0) {
                    group.push_back(places[static_cast<std::size_t>(index)]);
                }
            }
        });
        if (!is_good) {
            group.clear();
        }
    }
    return all;
}

/// Colliders of a spring, each once; an index out of the groups is a fault.
std::vector<int> colliders_of(const JsonField& indices,
                              const std::vector<std::vector<int>>& groups) {
    std::vector<int> colliders;
    for (const JsonField& index : indices.items(kMostColliders)) {
        const int group = index.index(groups.size());
        if (!groups.empty()) {
            const std::vector<int>& more = groups[static_cast<std::size_t>(group)];
            colliders.insert(colliders.end(), more.begin(), more.end());
        }
        if (colliders.size() > 4 * kMostColliders) {
            indices.complain("names too many colliders");
            return {};
        }
    }
    std::sort(colliders.begin(), colliders.end());
    colliders.erase(std::unique(colliders.begin(), colliders.end()), colliders.end());
    return colliders;
}

SpringJoint read_joint(const JsonField& from, Model& model) {
    SpringJoint joint;
    joint.node = from["node"].index(model.nodes.size());
    joint.hit_radius = lenient_number(from["hitRadius"], kRadius, model);
    joint.stiffness = lenient_number(from["stiffness"], kStiffness, model);
    joint.gravity_power = lenient_number(from["gravityPower"], kGravity, model);
    joint.gravity_direction =
        lenient_vector(from["gravityDir"], kDirection, {0.0F, -1.0F, 0.0F}, model);
    joint.drag = lenient_number(from["dragForce"], kDrag, model);
    if (from["extensions"]["VRMC_springBone_limit"].exists()) {
        warn(model, "VRMC_springBone_limit is not known; springs turn as far as they like");
    }
    return joint;
}

SpringChain read_chain(const JsonField& from,
                       const std::vector<std::vector<int>>& groups,
                       const TreeOrder& tree,
                       Model& model) {
    SpringChain chain;
    chain.name = lenient_text(from["name"], model);
    for (const JsonField& joint : from["joints"].items(kMostSwinging)) {
        const SpringJoint read = read_joint(joint, model);
        if (!model.nodes.empty() && !chain.joints.empty() &&
            !tree.is_below(read.node, chain.joints.back().node)) {
            joint["node"].complain("does not lie below the joint before");
        }
        chain.joints.push_back(read);
    }
    if (chain.joints.empty()) {
        from["joints"].complain("has no joints");
    }
    chain.colliders = colliders_of(from["colliderGroups"], groups);
    chain.center = from["center"].index_or_none(model.nodes.size());
    return chain;
}

// ---- VRM 0.x

std::vector<SpringCollider> read_spheres0(const JsonField& group, Model& model) {
    std::vector<SpringCollider> spheres;
    const int node = group["node"].index(model.nodes.size());
    for (const JsonField& sphere : group["colliders"].items(kMostColliders)) {
        SpringCollider& collider = spheres.emplace_back();
        collider.node = node;
        const glm::vec3 offset = lenient_xyz(sphere["offset"], kPlace, model);
        collider.offset = {offset.x, offset.y, -offset.z};  // Unity's z
        collider.radius = lenient_number(sphere["radius"], kRadius, model);
    }
    return spheres;
}

/// Colliders of each group of the file; none of one that is bad.
std::vector<std::vector<int>> read_groups0(const JsonField& from, Springs& springs, Model& model) {
    std::vector<std::vector<int>> groups;
    for (const JsonField& group : from.items()) {
        std::vector<int>& places = groups.emplace_back();
        std::vector<SpringCollider> spheres;
        if (!read_part(
                group, model, [&](const JsonField& own) { spheres = read_spheres0(own, model); })) {
            continue;
        }
        const bool has_room = read_part(group, model, [&](const JsonField& own) {
            for (const SpringCollider& sphere : spheres) {
                if (const int place = springs.add(own, sphere); place >= 0) {
                    places.push_back(place);
                }
            }
        });
        static_cast<void>(has_room);  // said in a warning
    }
    return groups;
}

/// What all joints of a bone group share.
SpringJoint read_joint0(const JsonField& group, Model& model) {
    SpringJoint joint;
    joint.hit_radius = lenient_number(group["hitRadius"], {0.0F, 1000.0F, 0.02F}, model);
    joint.stiffness = lenient_number(group["stiffiness"], kStiffness, model);  // its spelling
    joint.gravity_power = lenient_number(group["gravityPower"], kGravity, model);
    joint.drag = lenient_number(group["dragForce"], {0.0F, 1.0F, 0.4F}, model);
    if (const JsonField direction = group["gravityDir"]; direction.exists()) {
        // Unity's world, seen with the figure facing +z: x runs the other way.
        const glm::vec3 unity = lenient_xyz(direction, kDirection, model);
        joint.gravity_direction = {-unity.x, unity.y, unity.z};
    }
    return joint;
}

/// The subtree below `root` as chains: each goes on with a node's first child, and every other
/// child begins one of its own. A chain ends at a leaf, which swings about a virtual tail, or at
/// what swings already, which is only its tail.
void add_subtree(const JsonField& from,
                 int root,
                 const SpringChain& like,
                 Springs& springs,
                 const Model& model) {
    const SpringJoint joint = like.joints.front();
    if (springs.swings(root)) {
        from.complain(fmt::format("its node {} swings in another spring already", root));
        return;
    }
    std::vector<int> roots = {root};
    for (std::size_t next = 0; next < roots.size() && !springs.is_full(); ++next) {
        if (springs.swings(roots[next])) {
            continue;
        }
        SpringChain chain = like;
        chain.joints.clear();
        int node = roots[next];
        while (true) {
            chain.joints.push_back(joint);
            chain.joints.back().node = node;
            const std::vector<int>& children = node_of(model, node).children;
            if (children.empty() || (springs.swings(node) && chain.joints.size() > 1)) {
                chain.has_virtual_tail = children.empty() && !springs.swings(node);
                break;
            }
            roots.insert(roots.end(), children.begin() + 1, children.end());
            node = children.front();
        }
        springs.add(from, std::move(chain));
    }
}

/// What a bone group of the file says: its roots, and a chain of one joint that all are like.
struct BoneGroup {
    std::vector<int> roots;
    SpringChain like;
};

BoneGroup read_group0(const JsonField& from,
                      const std::vector<std::vector<int>>& colliders,
                      Model& model) {
    BoneGroup group;
    group.like.name = lenient_text(from["comment"], model);
    group.like.joints.push_back(read_joint0(from, model));
    group.like.colliders = colliders_of(from["colliderGroups"], colliders);
    const auto nodes = static_cast<std::int64_t>(model.nodes.size());
    group.like.center = static_cast<int>(from["center"].whole_or(-1, -1, nodes - 1));
    for (const JsonField& bone : from["bones"].items(kMostSwinging)) {
        group.roots.push_back(bone.index(model.nodes.size()));
    }
    return group;
}

/// Adds the subtrees of a group; one that cannot swing is left out alone.
void add_group0(const JsonField& from, const BoneGroup& group, Springs& springs, Model& model) {
    for (const int root : group.roots) {
        if (springs.is_full()) {
            return;
        }
        const bool is_added = read_part(from, model, [&](const JsonField& own) {
            add_subtree(own, root, group.like, springs, model);
        });
        static_cast<void>(is_added);  // said in a warning
    }
}

}  // namespace

void read_springs1(const JsonField& springs, Model& model) {
    Springs all(model);
    const bool is_good = read_part(springs, model, [&](const JsonField& own) {
        if (!is_known_version(own, model)) {
            own["specVersion"].complain("is not 1.0");
            return;
        }
        const std::vector<int> places = read_colliders(own["colliders"], all, model);
        const auto groups = read_groups(own["colliderGroups"], places, model);
        for (const JsonField& spring : own["springs"].items(kMostChains)) {
            ++model.character.stated_springs;
            if (all.is_full()) {
                break;
            }
            SpringChain chain;
            if (read_part(spring, model, [&](const JsonField& one) {
                    chain = read_chain(one, groups, all.tree(), model);
                })) {
                const bool is_added = read_part(
                    spring, model, [&](const JsonField& one) { all.add(one, std::move(chain)); });
                static_cast<void>(is_added);  // said in a warning
            }
        }
    });
    static_cast<void>(is_good);  // said in a warning
}

void read_springs0(const JsonField& springs, Model& model) {
    Springs all(model);
    const bool is_good = read_part(springs, model, [&](const JsonField& own) {
        const auto colliders = read_groups0(own["colliderGroups"], all, model);
        for (const JsonField& group : own["boneGroups"].items(kMostChains)) {
            ++model.character.stated_springs;
            BoneGroup read;
            if (read_part(group, model, [&](const JsonField& one) {
                    read = read_group0(one, colliders, model);
                })) {
                add_group0(group, read, all, model);
            }
        }
    });
    static_cast<void>(is_good);  // said in a warning
}

}  // namespace raks::render
