#include "motion/capture/angles/body_links.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "motion/capture/solving/frame_fit.hpp"

namespace raks::capture {
namespace {

using motion::Bone;

/// Which limb a bone belongs to: 0 and 1 the arms, 2 and 3 the legs; none: trunk or head.
std::optional<std::size_t> limb_of(Bone bone) {
    if (bone < Bone::left_upper_leg) {
        return std::nullopt;
    }
    const bool is_right = bone >= Bone::right_upper_leg;
    const Bone left = is_right ? motion::mirrored(bone) : bone;
    return (left < Bone::left_shoulder ? 2U : 0U) + (is_right ? 1U : 0U);
}

bool tells_of_trunk(Bone bone) {
    return is_of_trunk(bone) || bone == Bone::neck || bone == Bone::head;
}

void add_variables(const BodyModel& model, std::size_t joint, JointGroup& group) {
    group.joints.push_back(joint);
    for (std::size_t i = 0; i < model.joints()[joint].size(); ++i) {
        group.variables.push_back(model.joints()[joint].first + i);
    }
}

// The links that carry the markers of a group, and those that carry these.
void add_links(const BodyLinks& links, JointGroup& group) {
    std::vector<bool> is_needed(links.links.size());
    for (const std::size_t marker : group.markers) {
        is_needed[links.markers[marker].link] = true;
    }
    for (std::size_t i = links.links.size(); i-- > 0;) {
        if (is_needed[i]) {
            is_needed[links.links[i].parent] = true;
        }
    }
    for (std::size_t i = 0; i < links.links.size(); ++i) {
        if (is_needed[i]) {
            group.links.push_back(i);
        }
    }
}

}  // namespace

bool BodyLinks::moves(std::size_t joint, std::size_t marker) const noexcept {
    std::size_t link = markers[marker].link;
    while (links[link].joint != joint && link != links[link].parent) {
        link = links[link].parent;
    }
    return links[link].joint == joint;
}

BodyLinks links_of(const BodyModel& model,
                   const BodyShape& shape,
                   const std::vector<Bone>& marker_bones) {
    BodyLinks body;
    // By bone: the last link that carries it, and where its joint is in the frame of that link.
    std::array<LinkedPoint, motion::kBoneCount> places{};
    for (std::size_t bone = 0; bone < motion::kBoneCount; ++bone) {
        const LinkedPoint& parent = places[motion::kBoneParents[bone]];
        places[bone] = {parent.link, parent.place + shape.offsets[bone]};
        if (bone == 0) {
            places[bone] = {};
        }
        for (const BodyModel::Part& part : model.parts()) {
            if (index_of(part.bone) == bone) {
                const TurningJoint& joint = model.joints()[part.joint];
                body.links.push_back({places[bone].link,
                                      part.joint,
                                      places[bone].place,
                                      1.0 / static_cast<double>(joint.count)});
                places[bone] = {body.links.size() - 1, glm::dvec3(0.0)};
            }
        }
    }
    for (std::size_t i = 0; i < marker_bones.size(); ++i) {
        const LinkedPoint& bone = places[index_of(marker_bones[i])];
        body.markers.push_back({bone.link, bone.place + shape.marker_places[i]});
    }
    return body;
}

BodyDivision divide(const BodyModel& model,
                    const BodyLinks& links,
                    const std::vector<Bone>& marker_bones) {
    BodyDivision division;
    division.limbs.resize(4);
    for (const std::size_t axis : {0U, 1U, 2U}) {
        division.trunk.variables.push_back(kHipsPlace + axis);
        division.whole.variables.push_back(kHipsPlace + axis);
    }
    for (std::size_t joint = 0; joint < model.joints().size(); ++joint) {
        const auto limb = limb_of(model.joints()[joint].bones[0]);
        add_variables(model, joint, limb ? division.limbs[*limb] : division.trunk);
        add_variables(model, joint, division.whole);
    }
    for (std::size_t marker = 0; marker < marker_bones.size(); ++marker) {
        division.whole.markers.push_back(marker);
        if (tells_of_trunk(marker_bones[marker])) {
            division.trunk.markers.push_back(marker);
        }
        for (JointGroup& limb : division.limbs) {
            if (std::any_of(limb.joints.begin(), limb.joints.end(), [&](std::size_t joint) {
                    return links.moves(joint, marker);
                })) {
                limb.markers.push_back(marker);
            }
        }
    }
    std::erase_if(division.limbs, [](const JointGroup& limb) { return limb.markers.empty(); });
    add_links(links, division.trunk);
    add_links(links, division.whole);
    for (JointGroup& limb : division.limbs) {
        add_links(links, limb);
    }
    return division;
}

}  // namespace raks::capture
