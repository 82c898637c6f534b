#include "engine/show/danced_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

/// Of every joint, one a pose.
std::vector<JointKeys> keys_of(const render::Avatar& avatar,
                               std::span<const motion::Pose> poses,
                               double rate) {
    constexpr float kOwnBody = 1.0F;  // the pose is on this body already
    const motion::Skeleton& made_for = motion::mannequin_skeleton();
    const auto pose_at = [&](StreamTime time) {
        return render::retargeted(
            motion::pose_between(poses, to_seconds(time) * rate), made_for, avatar);
    };
    render::RigState state(*avatar.rig);
    std::vector<JointKeys> keys(avatar.rig->tree.joints.size());
    for (std::size_t i = 0; i < poses.size(); ++i) {
        const StreamTime time = stream_time_from_seconds(static_cast<double>(i) / rate);
        render::advance(*avatar.rig, time, kOwnBody, pose_at, state);
        render::pose_avatar(*avatar.rig,
                            render::retargeted(poses[i], made_for, avatar),
                            render::Face{},
                            kOwnBody,
                            state);
        for (std::size_t joint = 0; joint < keys.size(); ++joint) {
            keys[joint].translations.push_back(state.joints.translations[joint]);
            // The nearer of the two that mean the same: players interpolate number by number.
            const glm::quat turn = state.joints.rotations[joint];
            std::vector<glm::quat>& turns = keys[joint].rotations;
            turns.push_back(!turns.empty() && glm::dot(turns.back(), turn) < 0.0F ? -turn : turn);
        }
    }
    return keys;
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
               double rate,
               const std::string& name,
               const std::string& sound) {
    const render::Avatar avatar = figure_of(model);
    const std::vector<JointKeys> keys = keys_of(avatar, poses, rate);
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
    model.animations.clear();
    model.animations.push_back(std::move(clip));
}

}  // namespace raks::engine
