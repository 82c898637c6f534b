#include "render/model/animation_channel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace raks::render {
namespace {

// Numbers of a value; of weights the first four are enough here.
std::size_t width_of(const AnimationChannel& channel) noexcept {
    switch (channel.path) {
        case ChannelPath::rotation:
            return 4;
        case ChannelPath::translation:
        case ChannelPath::scale:
            return 3;
        case ChannelPath::weights:
            break;
    }
    const std::size_t parts = channel.interpolation == Interpolation::cubic ? 3 : 1;
    return channel.values.size() / (channel.times.size() * parts);
}

// `part`: of cubic keys 0 the tangent before, 1 the value, 2 the tangent after.
glm::vec4 key_value(const AnimationChannel& channel, std::size_t key, std::size_t part) noexcept {
    const std::size_t width = width_of(channel);
    const bool is_cubic = channel.interpolation == Interpolation::cubic;
    const std::size_t first = (is_cubic ? 3 * key + part : key) * width;
    glm::vec4 value(0.0F);
    for (std::size_t i = 0; i < std::min<std::size_t>(width, 4); ++i) {
        value[static_cast<glm::length_t>(i)] = channel.values[first + i];
    }
    return value;
}

glm::vec4 slerped(const glm::vec4& a, const glm::vec4& b, float t) noexcept {
    const glm::quat q = glm::slerp(glm::quat(a.w, a.x, a.y, a.z), glm::quat(b.w, b.x, b.y, b.z), t);
    return {q.x, q.y, q.z, q.w};
}

glm::vec4 between(const AnimationChannel& channel, std::size_t key, float t) noexcept {
    const glm::vec4 a = key_value(channel, key, 1);
    const glm::vec4 b = key_value(channel, key + 1, 1);
    switch (channel.interpolation) {
        case Interpolation::step:
            return a;
        case Interpolation::linear:
            return channel.path == ChannelPath::rotation ? slerped(a, b, t) : a + (b - a) * t;
        case Interpolation::cubic:
            break;
    }
    // glTF 2.0, appendix C: Hermite spline, tangents in units a second.
    const float span = channel.times[key + 1] - channel.times[key];
    const float t2 = t * t;
    const float t3 = t2 * t;
    return (2.0F * t3 - 3.0F * t2 + 1.0F) * a +
           (t3 - 2.0F * t2 + t) * span * key_value(channel, key, 2) + (3.0F * t2 - 2.0F * t3) * b +
           (t3 - t2) * span * key_value(channel, key + 1, 0);
}

glm::vec4 raw_sample(const AnimationChannel& channel, float seconds) noexcept {
    const std::vector<float>& times = channel.times;
    const auto next = std::upper_bound(times.begin(), times.end(), seconds);
    if (next == times.begin()) {
        return key_value(channel, 0, 1);
    }
    if (next == times.end()) {
        return key_value(channel, times.size() - 1, 1);
    }
    const auto key = static_cast<std::size_t>(next - times.begin()) - 1;
    return between(channel, key, (seconds - times[key]) / (times[key + 1] - times[key]));
}

}  // namespace

glm::vec4 sample_channel(const AnimationChannel& channel, float seconds) noexcept {
    if (channel.times.empty()) {
        return channel.path == ChannelPath::rotation ? glm::vec4(0.0F, 0.0F, 0.0F, 1.0F)
                                                     : glm::vec4(0.0F);
    }
    const glm::vec4 value = raw_sample(channel, seconds);
    if (channel.path != ChannelPath::rotation) {
        return value;
    }
    const float length = glm::length(value);
    return length > 0.0F ? value / length : glm::vec4(0.0F, 0.0F, 0.0F, 1.0F);
}

void NodeChannels::take(const AnimationChannel& channel) noexcept {
    switch (channel.path) {
        case ChannelPath::translation:
            translation = &channel;
            break;
        case ChannelPath::rotation:
            rotation = &channel;
            break;
        case ChannelPath::scale:
            scale = &channel;
            break;
        case ChannelPath::weights:
            break;
    }
}

NodePlace NodeChannels::at(const ModelNode& node, float seconds) const noexcept {
    NodePlace place{node.translation, node.rotation, node.scale};
    if (translation != nullptr) {
        place.translation = glm::vec3(sample_channel(*translation, seconds));
    }
    if (rotation != nullptr) {
        const glm::vec4 q = sample_channel(*rotation, seconds);
        place.rotation = {q.w, q.x, q.y, q.z};
    }
    if (scale != nullptr) {
        place.scale = glm::vec3(sample_channel(*scale, seconds));
    }
    return place;
}

}  // namespace raks::render
