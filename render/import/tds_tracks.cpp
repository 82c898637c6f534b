#include "render/import/tds_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "render/import/model_warnings.hpp"
#include "render/import/tds_meshes.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace raks::render {
namespace {

constexpr float kTdsFramesPerSecond = 30.0F;
constexpr float kMostRounds = 16.0F;  // of a turn between two keys

float seconds_of(std::uint32_t frame) { return static_cast<float>(frame) / kTdsFramesPerSecond; }

/// Turns are clockwise about their axis.
glm::quat rotation_by(float angle, const glm::vec3& axis) {
    const glm::vec3 direction = with_y_up(axis);
    const float length = glm::length(direction);
    constexpr float kNoAxis = 1e-6F;
    return length > kNoAxis ? glm::angleAxis(-angle, direction / length)
                            : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
}

/// Scales have no sign to lose.
glm::vec3 scale_with_y_up(const glm::vec3& v) { return {v.x, v.z, v.y}; }

// ---- curves through keys

/// How a curve comes to a key and leaves it, for a second.
struct Tangents {
    glm::vec3 in{0.0F};
    glm::vec3 out{0.0F};
};

using VectorKeys = std::vector<TdsKey<glm::vec3>>;

float seconds_between(const VectorKeys& keys, std::size_t from) {
    return static_cast<float>(keys[from + 1].frame - keys[from].frame) / kTdsFramesPerSecond;
}

/// Of a key with one on either side (Kochanek and Bartels 1984, with their correction for keys that
/// are not evenly spaced).
Tangents inner_tangents(const VectorKeys& keys, std::size_t at) {
    const TdsKey<glm::vec3>& key = keys[at];
    const glm::vec3 from_before = key.value - keys[at - 1].value;
    const glm::vec3 to_next = keys[at + 1].value - key.value;
    const float slack = (1.0F - key.tension) / 2.0F;
    const float to_before = slack * (1.0F + key.bias);
    const float to_after = slack * (1.0F - key.bias);
    const float per_second = 2.0F / (seconds_between(keys, at - 1) + seconds_between(keys, at));
    const float sharp = 1.0F - key.continuity;
    const float blunt = 1.0F + key.continuity;
    return {.in = per_second * (sharp * to_before * from_before + blunt * to_after * to_next),
            .out = per_second * (blunt * to_before * from_before + sharp * to_after * to_next)};
}

/// Of the first or last key, from its neighbour's: the curve does not bend there.
glm::vec3 end_tangent(const glm::vec3& step, float seconds, float tension, const glm::vec3& next) {
    return (1.0F - tension) * (1.5F * step / seconds - 0.5F * next);
}

std::vector<Tangents> tangents_of(const VectorKeys& keys) {
    std::vector<Tangents> tangents(keys.size());
    for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
        tangents[i] = inner_tangents(keys, i);
    }
    const std::size_t last = keys.size() - 1;
    const glm::vec3 first_step = keys[1].value - keys[0].value;
    const glm::vec3 last_step = keys[last].value - keys[last - 1].value;
    const float first_seconds = seconds_between(keys, 0);
    const float last_seconds = seconds_between(keys, last - 1);
    if (last == 1) {
        tangents[0].out = tangents[1].in = first_step / first_seconds;
        return tangents;
    }
    tangents[0].out = end_tangent(first_step, first_seconds, keys[0].tension, tangents[1].in);
    tangents[last].in =
        end_tangent(last_step, last_seconds, keys[last].tension, tangents[last - 1].out);
    return tangents;
}

template <typename Turned>
AnimationChannel curve(int node, ChannelPath path, const VectorKeys& keys, const Turned& turned) {
    AnimationChannel channel{.node = node,
                             .path = path,
                             .interpolation = Interpolation::cubic,
                             .times = {},
                             .values = {}};
    const std::vector<Tangents> tangents = tangents_of(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        channel.times.push_back(seconds_of(keys[i].frame));
        for (const glm::vec3& part : {tangents[i].in, keys[i].value, tangents[i].out}) {
            const glm::vec3 value = turned(part);
            channel.values.insert(channel.values.end(), {value.x, value.y, value.z});
        }
    }
    return channel;
}

// ---- turns

void push_rotation(float seconds, const glm::quat& rotation, AnimationChannel& channel) {
    channel.times.push_back(seconds);
    channel.values.insert(channel.values.end(), {rotation.x, rotation.y, rotation.z, rotation.w});
}

/// In how many pieces a turn is drawn, so that each is a quarter at most and its way is kept.
float pieces_of(const TdsTurn& turn) {
    constexpr float kMostPieces = 4.0F * kMostRounds;
    return std::clamp(std::ceil(std::abs(turn.angle) / glm::half_pi<float>()), 1.0F, kMostPieces);
}

std::size_t piece_count(const std::vector<TdsKey<TdsTurn>>& keys) {
    std::size_t count = 0;
    for (const TdsKey<TdsTurn>& key : keys) {
        count += static_cast<std::size_t>(pieces_of(key.value));
    }
    return count;
}

AnimationChannel turns(int node, const std::vector<TdsKey<TdsTurn>>& keys, Model& model) {
    AnimationChannel channel{.node = node,
                             .path = ChannelPath::rotation,
                             .interpolation = Interpolation::linear,
                             .times = {},
                             .values = {}};
    glm::quat rotation = rotation_by(keys[0].value.angle, keys[0].value.axis);
    push_rotation(seconds_of(keys[0].frame), rotation, channel);
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const TdsTurn& turn = keys[i].value;
        const float start = seconds_of(keys[i - 1].frame);
        const float end = seconds_of(keys[i].frame);
        const float pieces = pieces_of(turn);
        if (std::abs(turn.angle) > glm::two_pi<float>() * kMostRounds) {
            warn(model, "turns of more than 16 rounds between two keyframes are drawn in part");
        }
        const glm::quat before = rotation;
        for (float piece = 1.0F; piece <= pieces; piece += 1.0F) {
            const float share = piece / pieces;
            // In the axes of the parent: each turn comes after those before.
            rotation = glm::normalize(rotation_by(share * turn.angle, turn.axis) * before);
            const float seconds = share < 1.0F ? start + share * (end - start) : end;
            if (seconds > channel.times.back()) {
                push_rotation(seconds, rotation, channel);
            }
        }
    }
    return channel;
}

}  // namespace

void set_rest(const TdsNode& from, ModelNode& node) {
    if (!from.positions.empty()) {
        node.translation = with_y_up(from.positions.front().value);
    }
    if (!from.turns.empty()) {
        node.rotation = rotation_by(from.turns.front().value.angle, from.turns.front().value.axis);
    }
    if (!from.scales.empty()) {
        node.scale = scale_with_y_up(from.scales.front().value);
    }
}

void add_tds_clip(const TdsFile& file, ImportBudget& budget, Model& model) {
    ModelAnimation clip;
    clip.name = "keyframes";
    constexpr std::size_t kBytesOfCurve = 40;  // for a key
    constexpr std::size_t kBytesOfTurn = 20;   // for a piece
    for (std::size_t i = 0; i < file.nodes.size(); ++i) {
        const TdsNode& node = file.nodes[i];
        const int index = static_cast<int>(i);
        if (!budget.claim(node.positions.size() + node.scales.size(), kBytesOfCurve) ||
            !budget.claim(piece_count(node.turns), kBytesOfTurn)) {
            warn(model, "its movement needs too much memory and is left out");
            break;
        }
        if (node.positions.size() > 1) {
            clip.channels.push_back(
                curve(index, ChannelPath::translation, node.positions, with_y_up));
        }
        if (node.turns.size() > 1) {
            clip.channels.push_back(turns(index, node.turns, model));
        }
        if (node.scales.size() > 1) {
            clip.channels.push_back(curve(index, ChannelPath::scale, node.scales, scale_with_y_up));
        }
    }
    if (!clip.channels.empty()) {
        model.animations.push_back(std::move(clip));
    }
}

}  // namespace raks::render
