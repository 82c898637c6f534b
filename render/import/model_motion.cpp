#include "render/import/model_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "base/printable.hpp"
#include "base/suggest.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "render/import/bind_places.hpp"
#include "render/import/body_parents.hpp"
#include "render/import/humanoid_labels.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/import/model_reader.hpp"
#include "render/import/node_tree.hpp"
#include "render/model/animation_channel.hpp"
#include "render/model/model_survey.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace raks::render {
namespace {

constexpr std::size_t kMostClipJoints = 1000;
constexpr double kMostFrames = 2'000'000;  // 9 hours at 60 a second
constexpr double kMostNodeFrames = 4e7;    // what sampling may cost: some ten seconds
constexpr double kLargestPlace = 1e6;      // metres
constexpr double kUsualRate = 60.0;        // frames a second
constexpr double kLeastKeyRate = 10.0;     // of even keys that are frames of a capture
constexpr double kMostKeyRate = 240.0;

// The turn in a matrix that may also scale.
glm::dquat turn_of(const glm::dmat4& matrix) {
    glm::dmat3 axes(matrix);
    for (int i = 0; i < 3; ++i) {
        const double length = glm::length(axes[i]);
        if (!(length > 1e-12)) {
            return {1.0, 0.0, 0.0, 0.0};
        }
        axes[i] /= length;
    }
    if (glm::determinant(axes) < 0.0) {  // mirrored
        axes[0] = -axes[0];
    }
    return glm::normalize(glm::quat_cast(axes));
}

class ModelMotion {
 public:
    ModelMotion(const Model& model, const ModelAnimation& animation)
        : model_(model),
          hung_(body_parents(model).parents),
          order_(parents_first(model)),
          moved_(model.nodes.size()) {
        for (const AnimationChannel& channel : animation.channels) {
            take(channel);
        }
    }

    Expected<ModelClip> clip(std::optional<double> rate) {
        choose_nodes();
        if (nodes_.empty() || !has_keys_) {
            return fail("its clip moves no joints");
        }
        if (nodes_.size() > kMostClipJoints) {
            return fail(fmt::format("has {} joints; at most {}", nodes_.size(), kMostClipJoints));
        }
        clip_.frames_per_second = rate.value_or(rate_of_keys());
        const double span = static_cast<double>(end_) - static_cast<double>(begin_);
        const double frames = std::floor(span * clip_.frames_per_second + 0.5) + 1.0;
        if (!(frames <= kMostFrames) ||
            frames * static_cast<double>(model_.nodes.size()) > kMostNodeFrames) {
            return fail(fmt::format("its clip lasts {:.4g} s, which is too long", span));
        }
        clip_.frame_count = static_cast<std::size_t>(frames);
        clip_.metres_per_unit = 1.0;
        clip_.up = glm::dvec3(0.0, 1.0, 0.0);
        build_skeleton();
        for (std::size_t frame = 0; frame < clip_.frame_count; ++frame) {
            add_frame(begin_ +
                      static_cast<float>(static_cast<double>(frame) / clip_.frames_per_second));
        }
        for (const glm::dvec3& place : clip_.positions) {
            if (!(glm::length(place) <= kLargestPlace)) {
                return fail("its clip has joints farther apart than 1,000 km");
            }
        }
        take_body();
        return ModelClip{std::move(clip_), std::move(nodes_)};
    }

 private:
    void take(const AnimationChannel& channel) {
        if (channel.times.empty() || channel.node < 0) {
            return;
        }
        if (channel.path == ChannelPath::weights) {
            return;
        }
        moved_[static_cast<std::size_t>(channel.node)].take(channel);
        begin_ = has_keys_ ? std::min(begin_, channel.times.front()) : channel.times.front();
        end_ = has_keys_ ? std::max(end_, channel.times.back()) : channel.times.back();
        has_keys_ = true;
        if (keys_ == nullptr || channel.times.size() > keys_->times.size()) {
            keys_ = &channel;
        }
    }

    // The nodes that are joints, parents first.
    void choose_nodes() {
        std::vector<bool> is_joint(model_.nodes.size(), false);
        names_.resize(model_.nodes.size());
        const HumanoidMap& humanoid = model_.character.humanoid;
        is_humanoid_ = humanoid.nodes[0] >= 0 && humanoid.reasons[0] == BoneReason::stated;
        for (std::size_t bone = 0; bone < humanoid.nodes.size() && is_humanoid_; ++bone) {
            if (const int node = humanoid.nodes[bone]; node >= 0) {
                is_joint[static_cast<std::size_t>(node)] = true;
                names_[static_cast<std::size_t>(node)] = motion::kBoneNames[bone];
            }
        }
        if (!is_humanoid_) {
            for (const ModelSkin& skin : model_.skins) {
                for (const int joint : skin.joints) {
                    is_joint[static_cast<std::size_t>(joint)] = true;
                }
            }
            if (std::find(is_joint.begin(), is_joint.end(), true) == is_joint.end()) {
                for (std::size_t node = 0; node < moved_.size(); ++node) {
                    is_joint[node] = moved_[node].is_moved();
                }
            }
            for (const int node : humanoid.nodes) {
                if (node >= 0) {
                    is_joint[static_cast<std::size_t>(node)] = true;
                }
            }
        }
        joint_of_.assign(model_.nodes.size(), -1);
        for (const std::size_t node : parents_first(hung_)) {
            if (is_joint[node]) {
                joint_of_[node] = static_cast<int>(nodes_.size());
                nodes_.push_back(node);
            }
        }
    }

    // The body that was found in the model, as the joints of the clip.
    void take_body() {
        const HumanoidMap& humanoid = model_.character.humanoid;
        if (humanoid.nodes[0] < 0) {
            return;
        }
        motion::KnownBody known;
        for (std::size_t bone = 0; bone < humanoid.nodes.size(); ++bone) {
            if (const int node = humanoid.nodes[bone]; node >= 0) {
                const int joint = joint_of_[static_cast<std::size_t>(node)];
                known.mapping.joints[bone] = static_cast<std::size_t>(joint);
                known.reasons[bone] = words_of(humanoid.reasons[bone]);
                known.confidence[bone] = static_cast<double>(humanoid.confidence[bone]);
            }
        }
        const ModelSurvey measured = survey(model_);
        if (measured.box && measured.box->high.y > measured.box->low.y) {
            known.height = static_cast<double>(measured.box->high.y - measured.box->low.y);
        }
        known.facing = measured.facing_degrees;
        clip_.known = std::move(known);
    }

    // The joint above a node: that of the next node above which is one. -1: none is.
    int joint_above(std::size_t node) const {
        for (int up = hung_[node]; up >= 0; up = hung_[static_cast<std::size_t>(up)]) {
            if (joint_of_[static_cast<std::size_t>(up)] >= 0) {
                return joint_of_[static_cast<std::size_t>(up)];
            }
        }
        return -1;
    }

    // The rate of the most frequent keys where they are even, as of a capture that was baked.
    double rate_of_keys() const {
        const std::vector<float>& times = keys_->times;
        if (times.size() < 3) {
            return kUsualRate;
        }
        const double step =
            (static_cast<double>(times.back()) - static_cast<double>(times.front())) /
            static_cast<double>(times.size() - 1);
        for (std::size_t i = 0; i < times.size(); ++i) {
            const double even = static_cast<double>(times.front()) + step * static_cast<double>(i);
            if (!(std::abs(static_cast<double>(times[i]) - even) <= 0.02 * step)) {
                return kUsualRate;
            }
        }
        const double rate = 1.0 / step;
        return rate >= kLeastKeyRate && rate <= kMostKeyRate ? rate : kUsualRate;
    }

    void build_skeleton() {
        // VRM rests in its T-pose as stored; of others the stored pose may be one of a clip.
        const bool is_bound = !is_humanoid_ && !model_.skins.empty();
        std::vector<glm::dmat4> rest(model_.nodes.size());
        if (is_bound) {
            const std::vector<glm::mat4> bound = bind_world(model_);
            std::copy(bound.begin(), bound.end(), rest.begin());
        } else {
            fill_world(std::nullopt, rest);
        }
        for (const std::size_t node : nodes_) {
            const int above = joint_above(node);
            const std::size_t index = clip_.joints.size();
            const glm::dvec3 place(rest[node][3]);
            motion::ClipJoint joint;
            joint.name = names_[node].empty() ? model_.nodes[node].name : names_[node];
            joint.parent = above < 0 ? index : static_cast<std::size_t>(above);
            joint.offset = above < 0 ? place : place - glm::dvec3(rest[nodes_[joint.parent]][3]);
            joint.end_site = tip_of(node, rest);
            clip_.joints.push_back(std::move(joint));
            rest_turns_.push_back(turn_of(rest[node]));
        }
    }

    // Where a limb ends: at the only node below it, if that is no joint, as modelling programs
    // write the tips of heads, fingers and toes.
    std::optional<glm::dvec3> tip_of(std::size_t node, const std::vector<glm::dmat4>& rest) const {
        const std::vector<int>& children = model_.nodes[node].children;
        if (children.size() != 1 || node_of(model_, children[0]).mesh >= 0 ||
            !node_of(model_, children[0]).children.empty() ||
            joint_of_[static_cast<std::size_t>(children[0])] >= 0) {
            return std::nullopt;
        }
        return glm::dvec3(rest[static_cast<std::size_t>(children[0])][3]) -
               glm::dvec3(rest[node][3]);
    }

    // World from each node at a time of the clip; none: as stored.
    void fill_world(std::optional<float> seconds, std::vector<glm::dmat4>& world) const {
        for (const int index : order_) {
            const auto at = static_cast<std::size_t>(index);
            const ModelNode& node = model_.nodes[at];
            const NodePlace place =
                seconds ? moved_[at].at(node, *seconds) : NodeChannels{}.at(node, 0.0F);
            const glm::dmat4 local =
                glm::translate(glm::dmat4(1.0), glm::dvec3(place.translation)) *
                glm::mat4_cast(glm::normalize(glm::dquat(place.rotation))) *
                glm::scale(glm::dmat4(1.0), glm::dvec3(place.scale));
            world[at] =
                node.parent < 0 ? local : world[static_cast<std::size_t>(node.parent)] * local;
        }
    }

    // Places and turns since rest, each against the joint above.
    void add_frame(float seconds) {
        world_.resize(model_.nodes.size());
        fill_world(seconds, world_);
        std::vector<glm::dquat> turns(nodes_.size());
        for (std::size_t joint = 0; joint < nodes_.size(); ++joint) {
            const glm::dmat4& world = world_[nodes_[joint]];
            turns[joint] = turn_of(world) * glm::inverse(rest_turns_[joint]);
            const std::size_t parent = clip_.joints[joint].parent;
            const glm::dvec3 place(world[3]);
            if (parent == joint) {
                clip_.rotations.push_back(turns[joint]);
                clip_.positions.push_back(place);
                continue;
            }
            const glm::dquat back = glm::inverse(turns[parent]);
            clip_.rotations.push_back(back * turns[joint]);
            clip_.positions.push_back(back * (place - glm::dvec3(world_[nodes_[parent]][3])));
        }
    }

    const Model& model_;
    std::vector<int> hung_;                   // parent of each node, as a body is built
    std::vector<int> order_;                  // nodes, parents first
    std::vector<NodeChannels> moved_;         // by node
    const AnimationChannel* keys_ = nullptr;  // of the most keys
    bool has_keys_ = false;
    float begin_ = 0.0F;  // seconds: the first key
    float end_ = 0.0F;    // the last
    bool is_humanoid_ = false;
    std::vector<std::string> names_;      // by node: of its bone, or empty
    std::vector<int> joint_of_;           // by node; -1: it is none
    std::vector<std::size_t> nodes_;      // by joint
    std::vector<glm::dquat> rest_turns_;  // by joint
    std::vector<glm::dmat4> world_;       // by node, at the frame that is added
    motion::MotionClip clip_;
};

}  // namespace

Expected<std::size_t> find_animation(const Model& model, const std::string& name) {
    if (model.animations.empty()) {
        return fail("there is no clip in it");
    }
    if (name.empty()) {
        return 0;
    }
    std::vector<std::string_view> names;
    for (const ModelAnimation& animation : model.animations) {
        names.push_back(animation.name);
    }
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        return fail(unknown_name("clip", name, names));
    }
    return static_cast<std::size_t>(found - names.begin());
}

std::string first_of_several(const Model& model, const std::string& clip) {
    return clip.empty() && model.animations.size() > 1
               ? fmt::format("holds {} clips; the first, \"{}\", is read (FILE#NAME reads another)",
                             model.animations.size(),
                             model.animations[0].name)
               : std::string();
}

Expected<motion::MotionClip> model_motion(const Model& model,
                                          std::size_t animation,
                                          std::optional<double> frames_per_second) {
    auto moved = model_clip(model, animation, frames_per_second);
    return moved ? Expected<motion::MotionClip>(std::move(moved->clip))
                 : fail(std::move(moved.error()));
}

Expected<ModelClip> model_clip(const Model& model,
                               std::size_t animation,
                               std::optional<double> frames_per_second) {
    return ModelMotion(model, model.animations[animation]).clip(frames_per_second);
}

Expected<motion::MotionClip> read_model_motion(const std::filesystem::path& file,
                                               const std::string& clip,
                                               std::optional<double> frames_per_second) {
    auto model = load_model(file);
    if (!model) {
        return fail(model.error());
    }
    const auto animation = find_animation(*model, clip);
    if (!animation) {
        return fail(Error(animation.error()).in(printable(file.string())));
    }
    std::optional<BoneLabels> labels;
    if (const std::filesystem::path beside = labels_beside(file); !beside.empty()) {
        auto read = load_labels(beside);
        if (!read) {
            return fail(std::move(read.error()));
        }
        labels = std::move(*read);
    }
    // One without a body is motion, too.
    static_cast<void>(map_humanoid(*model, labels ? &*labels : nullptr));
    auto motion = model_motion(*model, *animation, frames_per_second);
    if (!motion) {
        return fail(std::move(motion.error()).in(printable(file.string())));
    }
    motion->warnings = model->warnings;
    if (std::string line = first_of_several(*model, clip); !line.empty()) {
        motion->warnings.push_back(std::move(line));
    }
    return motion;
}

}  // namespace raks::render
