#include "render/export/glb_writer.hpp"

#include <map>
#include <vector>

#include "render/export/glb_parts.hpp"

namespace raks::render {
namespace {

Json node_json(const ModelNode& node) {
    Json json = Json::object();
    if (!node.name.empty()) {
        json["name"] = node.name;
    }
    if (!node.children.empty()) {
        json["children"] = node.children;
    }
    if (node.translation != glm::vec3(0.0F)) {
        json["translation"] = numbers_of(node.translation);
    }
    if (node.rotation != glm::quat(1.0F, 0.0F, 0.0F, 0.0F)) {
        json["rotation"] = numbers_of(node.rotation);
    }
    if (node.scale != glm::vec3(1.0F)) {
        json["scale"] = numbers_of(node.scale);
    }
    if (node.mesh >= 0) {
        json["mesh"] = node.mesh;
        if (node.skin >= 0) {
            json["skin"] = node.skin;
        }
        if (!node.morph_weights.empty()) {
            json["weights"] = node.morph_weights;
        }
    }
    return json;
}

GlbType type_of(const AnimationChannel& channel) {
    switch (channel.path) {
        case ChannelPath::rotation:
            return GlbType::vec4;
        case ChannelPath::weights:
            return GlbType::scalar;
        case ChannelPath::translation:
        case ChannelPath::scale:
            break;
    }
    return GlbType::vec3;
}

/// Clips of a document. Channels that are moved at the same times share the accessor of them.
class ClipWriter {
 public:
    explicit ClipWriter(GlbDocument& glb) : glb_(glb) {}

    Json json_of(const ModelAnimation& animation) {
        Json channels = Json::array();
        Json samplers = Json::array();
        for (const AnimationChannel& channel : animation.channels) {
            channels.push_back(
                {{"sampler", samplers.size()},
                 {"target", {{"node", channel.node}, {"path", name_of(channel.path)}}}});
            samplers.push_back({{"input", times_of(channel)},
                                {"output", glb_.add_floats(channel.values, type_of(channel))},
                                {"interpolation", name_of(channel.interpolation)}});
        }
        Json json = Json::object();
        if (!animation.name.empty()) {
            json["name"] = animation.name;
        }
        if (!animation.sound.empty()) {
            json["extras"] = {{"sound", animation.sound}};
        }
        json["channels"] = std::move(channels);
        json["samplers"] = std::move(samplers);
        return json;
    }

 private:
    static const char* name_of(ChannelPath path) {
        constexpr std::array kNames = {"translation", "rotation", "scale", "weights"};
        return kNames[static_cast<std::size_t>(path)];
    }

    static const char* name_of(Interpolation interpolation) {
        constexpr std::array kNames = {"STEP", "LINEAR", "CUBICSPLINE"};
        return kNames[static_cast<std::size_t>(interpolation)];
    }

    std::size_t times_of(const AnimationChannel& channel) {
        const auto [place, is_new] = times_.try_emplace(channel.times, 0);
        if (is_new) {
            place->second = glb_.add_floats(channel.times, GlbType::scalar, GlbUse::values, true);
        }
        return place->second;
    }

    GlbDocument& glb_;
    std::map<std::vector<float>, std::size_t> times_;
};

}  // namespace

void add_nodes(const Model& model, GlbDocument& glb) {
    Json& json = glb.json();
    if (model.nodes.empty()) {
        return;
    }
    json["scene"] = 0;
    json["scenes"] = {{{"nodes", model.roots}}};
    for (const ModelNode& node : model.nodes) {
        json["nodes"].push_back(node_json(node));
    }
}

void add_skins(const Model& model, GlbDocument& glb) {
    for (const ModelSkin& skin : model.skins) {
        Json json = {{"joints", skin.joints}};
        if (!skin.inverse_bind.empty()) {
            json["inverseBindMatrices"] =
                glb.add_floats(floats_of(skin.inverse_bind), GlbType::mat4);
        }
        glb.json()["skins"].push_back(std::move(json));
    }
}

void add_animations(const Model& model, GlbDocument& glb) {
    ClipWriter writer(glb);
    for (const ModelAnimation& animation : model.animations) {
        if (!animation.channels.empty()) {
            glb.json()["animations"].push_back(writer.json_of(animation));
        }
    }
}

void add_model(const Model& model, GlbDocument& glb) {
    add_nodes(model, glb);
    add_meshes(model, glb);
    add_skins(model, glb);
    add_materials(model, glb);
    add_animations(model, glb);
}

Expected<std::string> glb_bytes(const Model& model) {
    GlbDocument glb;
    add_model(model, glb);
    return glb.bytes();
}

}  // namespace raks::render
