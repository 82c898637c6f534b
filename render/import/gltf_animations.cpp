#include "render/import/gltf_animations.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "base/printable.hpp"
#include "render/import/model_warnings.hpp"

namespace raks::render {
namespace {

constexpr std::size_t kMostAnimations = 10'000;
constexpr std::size_t kMostChannels = 100'000;
constexpr float kKeySlack = 5e-3F;

struct Sampler {
    JsonField field;
    int times = 0;   ///< accessor
    int values = 0;  ///< accessor
    Interpolation interpolation = Interpolation::linear;
};

/// Reads the animations one after the other.
class AnimationReader {
 public:
    AnimationReader(GltfAccessors& accessors, const JsonField& nodes, Model& model)
        : accessors_(accessors), model_(model) {
        for (const JsonField& node : nodes.items()) {
            has_matrix_.push_back(node["matrix"].exists());
        }
    }

    ModelAnimation read(const JsonField& field) {
        ModelAnimation animation;
        animation.name = printable(field["name"].text_or(""), 100);
        std::vector<Sampler> samplers;
        for (const JsonField& sampler : field["samplers"].objects(kMostChannels)) {
            samplers.push_back(read_sampler(sampler));
        }
        const std::vector<JsonField> channels = field["channels"].objects(kMostChannels);
        if (samplers.empty() || channels.empty()) {
            field.complain("has no samplers or no channels");
            return animation;
        }
        std::set<std::pair<int, ChannelPath>> taken;
        for (const JsonField& channel : channels) {
            auto read = read_channel(channel, samplers);
            if (!read) {
                continue;
            }
            if (!taken.emplace(read->node, read->path).second) {
                warn(model_, channel.line("moves the same thing as another channel; left out"));
                continue;
            }
            animation.channels.push_back(std::move(*read));
        }
        return animation;
    }

 private:
    Sampler read_sampler(const JsonField& field) {
        Sampler sampler{.field = field};
        sampler.times = field["input"].index(accessors_.size());
        sampler.values = field["output"].index(accessors_.size());
        constexpr Interpolation kWays[] = {
            Interpolation::linear, Interpolation::step, Interpolation::cubic};
        sampler.interpolation =
            kWays[field["interpolation"].choice_or(0, {"LINEAR", "STEP", "CUBICSPLINE"})];
        if (accessors_.size() > 0) {
            check_times(sampler);
        }
        return sampler;
    }

    void check_times(const Sampler& sampler) {
        const GltfAccessor& times = accessors_[sampler.times];
        accessors_.use(sampler.times, ViewUse::animation);
        accessors_.use(sampler.values, ViewUse::animation);
        if (times.element != ElementType::scalar || times.component != ComponentType::float32) {
            sampler.field["input"].complain("must be floats of type SCALAR");
        }
        if (!times.has_bounds) {
            warn(model_, times.field.line("its times have no min and max"));
        }
        if (sampler.interpolation == Interpolation::cubic && times.count < 2) {
            warn(model_, sampler.field.line("has CUBICSPLINE with a single time"));
        }
    }

    /// A channel; none where it moves nothing that there is.
    std::optional<AnimationChannel> read_channel(const JsonField& field,
                                                 const std::vector<Sampler>& samplers) {
        const Sampler& sampler =
            samplers[static_cast<std::size_t>(field["sampler"].index(samplers.size()))];
        const JsonField target = field["target"];
        if (!target.is_object()) {
            target.complain("is missing or no object");
            return std::nullopt;
        }
        AnimationChannel channel;
        channel.node = target["node"].index_or_none(model_.nodes.size());
        channel.interpolation = sampler.interpolation;
        const std::string_view path = target["path"].text();
        constexpr std::string_view kPaths[] = {"translation", "rotation", "scale", "weights"};
        const auto* const known = std::find(std::begin(kPaths), std::end(kPaths), path);
        if (channel.node < 0 || model_.nodes.empty() || known == std::end(kPaths)) {
            if (known == std::end(kPaths)) {
                warn(model_, target["path"].line(fmt::format("\"{}\" is left out", path)));
            }
            return std::nullopt;
        }
        channel.path = static_cast<ChannelPath>(known - std::begin(kPaths));
        return accessors_.size() > 0 ? filled(channel, sampler, field) : std::nullopt;
    }

    /// Numbers at each time; none where they have another form, or there is nothing to move.
    std::size_t width_of(const AnimationChannel& channel,
                         const GltfAccessor& values,
                         const JsonField& field) {
        const ModelNode& node = model_.nodes[static_cast<std::size_t>(channel.node)];
        if (has_matrix_[static_cast<std::size_t>(channel.node)] &&
            channel.path != ChannelPath::weights) {
            warn(model_, field.line("moves a node that has a matrix, which glTF does not allow"));
        }
        const bool is_weights = channel.path == ChannelPath::weights;
        const ElementType wanted = is_weights                              ? ElementType::scalar
                                   : channel.path == ChannelPath::rotation ? ElementType::vec4
                                                                           : ElementType::vec3;
        if (values.element != wanted) {
            field.complain(fmt::format("values are {}, not {}",
                                       GltfAccessors::name_of(values.element),
                                       GltfAccessors::name_of(wanted)));
            return 0;
        }
        if (values.component != ComponentType::float32 && !values.is_normalized) {
            warn(model_, values.field.line("its values are integers that are not normalized"));
        }
        if (!is_weights) {
            return GltfAccessors::width(wanted);
        }
        const std::size_t morphs =
            node.mesh < 0 ? 0
                          : model_.meshes[static_cast<std::size_t>(node.mesh)].morph_weights.size();
        if (morphs == 0) {
            warn(model_, field.line("moves morph targets of a node that has none; left out"));
        }
        return morphs;
    }

    std::optional<AnimationChannel> filled(AnimationChannel channel,
                                           const Sampler& sampler,
                                           const JsonField& field) {
        const GltfAccessor& values = accessors_[sampler.values];
        const std::size_t width = width_of(channel, values, field);
        if (width == 0) {
            return std::nullopt;
        }
        const std::size_t times = accessors_[sampler.times].count;
        const std::size_t keys = channel.interpolation == Interpolation::cubic ? 3 * times : times;
        if (values.count * GltfAccessors::width(values.element) != keys * width) {
            field.complain(fmt::format("{} values for {} times", values.count, times));
            return std::nullopt;
        }
        channel.times = accessors_.floats(sampler.times);
        channel.values = accessors_.floats(sampler.values);
        if (channel.times.empty() || channel.values.empty() || !are_times(channel.times, sampler)) {
            return std::nullopt;
        }
        if (channel.path == ChannelPath::rotation) {
            make_unit(channel, sampler.field);
        }
        return channel;
    }

    /// Whether they can be played: rising. What is odd is said.
    bool are_times(const std::vector<float>& times, const Sampler& sampler) {
        if (!std::is_sorted(times.begin(), times.end())) {
            warn(model_, sampler.field["input"].line("its times fall; left out"));
            return false;
        }
        if (times.front() < 0.0F || std::adjacent_find(times.begin(), times.end()) != times.end()) {
            warn(model_, sampler.field["input"].line("has times below 0, or one time twice"));
        }
        return true;
    }

    /// Rotations of length 1; tangents of splines are left as they are.
    void make_unit(AnimationChannel& channel, const JsonField& field) {
        const bool is_cubic = channel.interpolation == Interpolation::cubic;
        std::vector<float>& q = channel.values;
        bool is_odd = false;
        for (std::size_t i = is_cubic ? 4 : 0; i + 3 < q.size(); i += is_cubic ? 12 : 4) {
            const float length = std::sqrt(q[i] * q[i] + q[i + 1] * q[i + 1] + q[i + 2] * q[i + 2] +
                                           q[i + 3] * q[i + 3]);
            is_odd = is_odd || std::abs(length - 1.0F) > kKeySlack;
            const bool has_direction = length > 1e-6F && length < 1e6F;
            for (std::size_t c = 0; c < 4; ++c) {
                q[i + c] = has_direction ? q[i + c] / length : (c == 3 ? 1.0F : 0.0F);
            }
        }
        if (is_odd) {
            warn(model_, field.line("has rotations that are not of length 1"));
        }
    }

    GltfAccessors& accessors_;
    Model& model_;
    std::vector<bool> has_matrix_;
};

}  // namespace

void read_animations(const JsonField& root, GltfAccessors& accessors, Model& model) {
    AnimationReader reader(accessors, root["nodes"], model);
    for (const JsonField& field : root["animations"].objects(kMostAnimations)) {
        model.animations.push_back(reader.read(field));
    }
}

}  // namespace raks::render
