#include "engine/show/danced_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "motion/skeleton/skeleton.hpp"
#include "render/avatar/avatar.hpp"
#include "render/avatar/model_avatar.hpp"

#include <glm/geometric.hpp>

namespace raks::engine {
namespace {

using render::AnimationChannel;
using render::ChannelPath;

/// Pictures are not needed: the figure's body and rig are.
render::Avatar figure_of(const render::Model& model) {
    return render::build_avatar(model, std::vector<render::Image>(model.images.size()));
}

/// The keys of one joint as they are gathered.
struct JointKeys {
    std::vector<glm::vec3> translations;
    std::vector<glm::quat> rotations;
};

/// The keys of a dance, one a pose.
struct DanceKeys {
    std::vector<JointKeys> joints;           ///< by joint
    std::vector<std::vector<float>> morphs;  ///< weights as render::FaceState has them
};

DanceKeys keys_of(const render::Avatar& avatar,
                  std::span<const motion::Pose> poses,
                  std::span<const render::Face> faces,
                  double rate) {
    constexpr float kOwnBody = 1.0F;  // the pose is on this body already
    const motion::Skeleton& made_for = motion::mannequin_skeleton();
    const auto pose_at = [&](StreamTime time) {
        return render::retargeted(
            motion::pose_between(poses, to_seconds(time) * rate), made_for, avatar);
    };
    render::RigState state(*avatar.rig);
    DanceKeys made;
    made.joints.resize(avatar.rig->tree.joints.size());
    std::vector<JointKeys>& keys = made.joints;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const StreamTime time = stream_time_from_seconds(static_cast<double>(i) / rate);
        render::advance(*avatar.rig, time, kOwnBody, pose_at, state);
        render::pose_avatar(*avatar.rig,
                            render::retargeted(poses[i], made_for, avatar),
                            i < faces.size() ? faces[i] : render::Face{},
                            kOwnBody,
                            state);
        made.morphs.push_back(state.face.morphs);
        for (std::size_t joint = 0; joint < keys.size(); ++joint) {
            keys[joint].translations.push_back(state.joints.translations[joint]);
            // The nearer of the two that mean the same: players interpolate number by number.
            const glm::quat turn = state.joints.rotations[joint];
            std::vector<glm::quat>& turns = keys[joint].rotations;
            turns.push_back(!turns.empty() && glm::dot(turns.back(), turn) < 0.0F ? -turn : turn);
        }
    }
    return made;
}

/// The channel of a node's morph targets; none where the dance leaves them as they are.
std::optional<AnimationChannel> morph_channel(int node,
                                              const render::MorphRange& range,
                                              const std::vector<float>& times,
                                              const std::vector<std::vector<float>>& morphs) {
    AnimationChannel channel{
        .node = node, .path = ChannelPath::weights, .times = times, .values = {}};
    const auto first = static_cast<std::ptrdiff_t>(range.first);
    const auto end = static_cast<std::ptrdiff_t>(range.first + range.count);
    bool moves = false;
    for (const std::vector<float>& weights : morphs) {
        channel.values.insert(channel.values.end(), weights.begin() + first, weights.begin() + end);
        moves = moves ||
                !std::equal(
                    weights.begin() + first, weights.begin() + end, morphs.front().begin() + first);
    }
    return moves ? std::optional(std::move(channel)) : std::nullopt;
}

/// A channel with these values; of one key where none differs from the first.
template <typename Value>
AnimationChannel channel_of(int node,
                            ChannelPath path,
                            const std::vector<float>& times,
                            const std::vector<Value>& values) {
    const bool is_still = std::all_of(
        values.begin(), values.end(), [&](const Value& one) { return one == values.front(); });
    const std::size_t count = is_still ? 1 : values.size();
    AnimationChannel channel{.node = node, .path = path, .times = {}, .values = {}};
    channel.times.assign(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::size_t i = 0; i < count; ++i) {
        for (int k = 0; k < Value::length(); ++k) {
            channel.values.push_back(values[i][k]);
        }
    }
    return channel;
}

/// Whether a value is other than at rest.
template <typename Value>
bool leaves(const Value& rest, const std::vector<Value>& values) {
    return std::any_of(values.begin(), values.end(), [&](const Value& one) { return one != rest; });
}

}  // namespace

motion::Skeleton dance_body_of(const render::Model& model) {
    return render::dance_body(figure_of(model));
}

void put_dance(render::Model& model,
               std::span<const motion::Pose> poses,
               std::span<const render::Face> faces,
               double rate,
               const std::string& name,
               const std::string& sound) {
    const render::Avatar avatar = figure_of(model);
    const DanceKeys made = keys_of(avatar, poses, faces, rate);
    const std::vector<JointKeys>& keys = made.joints;
    std::vector<float> times(poses.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        times[i] = static_cast<float>(static_cast<double>(i) / rate);
    }
    render::ModelAnimation clip{.name = name, .channels = {}, .sound = sound};
    for (std::size_t joint = 0; joint < keys.size(); ++joint) {
        const int node = avatar.rig->tree.nodes[joint];
        const render::ModelNode& rest = model.nodes[static_cast<std::size_t>(node)];
        if (leaves(rest.translation, keys[joint].translations)) {
            clip.channels.push_back(
                channel_of(node, ChannelPath::translation, times, keys[joint].translations));
        }
        if (leaves(rest.rotation, keys[joint].rotations)) {
            clip.channels.push_back(
                channel_of(node, ChannelPath::rotation, times, keys[joint].rotations));
        }
    }
    for (std::size_t node = 0; node < model.nodes.size(); ++node) {
        const auto range = avatar.rig->expressions.morphs_of(static_cast<int>(node));
        if (auto channel = morph_channel(static_cast<int>(node), range, times, made.morphs)) {
            clip.channels.push_back(std::move(*channel));
        }
    }
    model.animations.clear();
    model.animations.push_back(std::move(clip));
}

}  // namespace raks::engine
