#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "engine/import/scene_parts.hpp"

#include <assimp/anim.h>
#include <fmt/format.h>
#include <glm/gtc/quaternion.hpp>

namespace raks::engine {
namespace {

using render::AnimationChannel;
using render::ChannelPath;
using render::ModelAnimation;

constexpr double kUsualRate = 25.0;  // ticks a second where a file says none
constexpr std::size_t kMostKeys = 20'000'000;

/// Values of one channel, which are added in time order; what is not finite, or no later than what
/// was added before, is left out.
class ChannelKeys {
 public:
    ChannelKeys(int node, ChannelPath path) {
        channel_.node = node;
        channel_.path = path;
    }

    void add(double seconds, std::initializer_list<float> values) {
        add(seconds, std::vector<float>(values));
    }
    void add(double seconds, const std::vector<float>& values) {
        const auto time = static_cast<float>(seconds);
        const bool is_later = channel_.times.empty() || time > channel_.times.back();
        const bool is_good =
            std::isfinite(time) && std::all_of(values.begin(), values.end(), [](float value) {
                return std::isfinite(value);
            });
        if (is_later && is_good) {
            channel_.times.push_back(time);
            channel_.values.insert(channel_.values.end(), values.begin(), values.end());
        }
    }

    void move_to(ModelAnimation& clip) {
        if (!channel_.times.empty()) {
            clip.channels.push_back(std::move(channel_));
        }
    }

 private:
    AnimationChannel channel_;
};

/// The clips of a scene.
class ClipImport {
 public:
    explicit ClipImport(SceneImport& import) : import_(import) {}

    void run() {
        for (unsigned i = 0; i < import_.scene.mNumAnimations; ++i) {
            const aiAnimation& source = *import_.scene.mAnimations[i];
            ModelAnimation clip;
            clip.name = source.mName.C_Str();
            const bool has_rate =
                source.mTicksPerSecond > 0.0 && std::isfinite(source.mTicksPerSecond);
            const double rate = has_rate ? source.mTicksPerSecond : kUsualRate;
            for (unsigned c = 0; c < source.mNumChannels; ++c) {
                add_node(*source.mChannels[c], rate, clip);
            }
            for (unsigned c = 0; c < source.mNumMorphMeshChannels; ++c) {
                add_morphs(*source.mMorphMeshChannels[c], rate, clip);
            }
            begin_at_zero(clip);
            if (!clip.channels.empty()) {
                import_.model.animations.push_back(std::move(clip));
            }
        }
        if (lost_ > 0) {
            import_.ways.note(
                fmt::format("{} tracks of its clips move nodes that do not exist", lost_));
        }
    }

 private:
    bool has_room(std::size_t keys) {
        keys_ += keys;
        return keys_ <= kMostKeys;
    }

    [[nodiscard]] bool is_root(int node) const {
        return import_.model.nodes[static_cast<std::size_t>(node)].parent < 0;
    }

    [[nodiscard]] bool is_joint(int node) const {
        return std::any_of(import_.model.skins.begin(),
                           import_.model.skins.end(),
                           [node](const render::ModelSkin& skin) {
                               return std::find(skin.joints.begin(), skin.joints.end(), node) !=
                                      skin.joints.end();
                           });
    }

    /// The node that a track names: of several with the name a joint, else the first; -1: none.
    [[nodiscard]] int node_of(std::string_view name) const {
        const auto [first, last] = import_.nodes.equal_range(name);
        if (first == last || std::next(first) == last) {
            return first == last ? -1 : first->second;
        }
        const auto joint =
            std::find_if(first, last, [this](const auto& entry) { return is_joint(entry.second); });
        return joint == last ? first->second : joint->second;
    }

    void add_node(const aiNodeAnim& source, double rate, ModelAnimation& clip) {
        const int node = node_of(source.mNodeName.C_Str());
        if (node < 0 || !has_room(std::size_t{source.mNumPositionKeys} + source.mNumRotationKeys +
                                  source.mNumScalingKeys)) {
            ++lost_;
            return;
        }
        const glm::quat turn = is_root(node) ? import_.turn : glm::quat(1.0F, 0.0F, 0.0F, 0.0F);
        ChannelKeys places(node, ChannelPath::translation);
        for (unsigned k = 0; k < source.mNumPositionKeys; ++k) {
            const aiVectorKey& key = source.mPositionKeys[k];
            const glm::vec3 place =
                import_.scale * (turn * glm::vec3(key.mValue.x, key.mValue.y, key.mValue.z));
            places.add(key.mTime / rate, {place.x, place.y, place.z});
        }
        places.move_to(clip);
        ChannelKeys turns(node, ChannelPath::rotation);
        for (unsigned k = 0; k < source.mNumRotationKeys; ++k) {
            const aiQuatKey& key = source.mRotationKeys[k];
            const glm::quat q =
                glm::normalize(glm::quat(key.mValue.w, key.mValue.x, key.mValue.y, key.mValue.z));
            turns.add(key.mTime / rate, {q.x, q.y, q.z, q.w});
        }
        turns.move_to(clip);
        ChannelKeys scales(node, ChannelPath::scale);
        for (unsigned k = 0; k < source.mNumScalingKeys; ++k) {
            const aiVectorKey& key = source.mScalingKeys[k];
            const glm::vec3 scale = import_.scale_factors[static_cast<std::size_t>(node)] *
                                    glm::vec3(key.mValue.x, key.mValue.y, key.mValue.z);
            scales.add(key.mTime / rate, {scale.x, scale.y, scale.z});
        }
        scales.move_to(clip);
    }

    /// Of every node whose mesh has the name that the track has, up to assimp's "*0".
    void add_morphs(const aiMeshMorphAnim& source, double rate, ModelAnimation& clip) {
        const std::string name = source.mName.C_Str();
        const std::string mesh_name = name.substr(0, name.rfind('*'));
        bool is_used = false;
        for (std::size_t i = 0; i < import_.model.nodes.size(); ++i) {
            const render::ModelNode& node = import_.model.nodes[i];
            if (node.mesh < 0) {
                continue;
            }
            const render::ModelMesh& mesh =
                import_.model.meshes[static_cast<std::size_t>(node.mesh)];
            if ((mesh.name != mesh_name && node.name != mesh_name) || mesh.morph_names.empty() ||
                !has_room(source.mNumKeys * mesh.morph_names.size())) {
                continue;
            }
            is_used = true;
            ChannelKeys weights(static_cast<int>(i), ChannelPath::weights);
            for (unsigned k = 0; k < source.mNumKeys; ++k) {
                const aiMeshMorphKey& key = source.mKeys[k];
                std::vector<float> values(mesh.morph_names.size(), 0.0F);
                for (unsigned v = 0; v < key.mNumValuesAndWeights; ++v) {
                    if (key.mValues[v] < values.size()) {
                        values[key.mValues[v]] = static_cast<float>(key.mWeights[v]);
                    }
                }
                weights.add(key.mTime / rate, values);
            }
            weights.move_to(clip);
        }
        lost_ += is_used ? 0 : 1;
    }

    /// glTF knows no time before 0.
    static void begin_at_zero(ModelAnimation& clip) {
        float first = 0.0F;
        for (const AnimationChannel& channel : clip.channels) {
            first = std::min(first, channel.times.front());
        }
        for (AnimationChannel& channel : clip.channels) {
            for (float& time : channel.times) {
                time -= first;
            }
        }
    }

    SceneImport& import_;
    std::size_t keys_ = 0;
    std::size_t lost_ = 0;
};

}  // namespace

void import_clips(SceneImport& import) { ClipImport(import).run(); }

}  // namespace raks::engine
