// From how much of each expression to morph weights, colours and texture transforms.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/avatar/face.hpp"
#include "render/model/model.hpp"

namespace raks::render {

/// Where the weights of a node's morph targets lie in FaceState::morphs.
struct MorphRange {
    std::size_t first = 0;
    std::size_t count = 0;
};

/// What expressions make of one material.
struct MaterialFace {
    int material = 0;  ///< in Model::materials
    std::array<glm::vec4, 6>
        colours{};                  ///< by ColourBindKind, linear; three components but of base
    float texture_weight = 0.0F;    ///< sum of the weights of texture transforms ...
    glm::vec2 texture_scale{0.0F};  ///< ... and of weight times target
    glm::vec2 texture_offset{0.0F};

    /// A texture of the material as the expressions move it: each moves its transform from what
    /// the file says towards the target, by its weight.
    [[nodiscard]] TextureUse moved(TextureUse use) const noexcept;
};

/// A face as it is drawn. Made by ExpressionRig::make_state.
struct FaceState {
    std::vector<float> weights;           ///< by expression of the model, as they come out
    std::vector<float> morphs;            ///< by MorphRange
    std::vector<MaterialFace> materials;  ///< those that expressions change
};

/// The expressions of a model. Immutable once built.
///
/// As the specification (VRMC_vrm 1.0, expressions.md) says: binary expressions are 0 up to weight
/// 0.5 and 1 above; expressions hold back those of eyelids, gaze and mouth by their override
/// (`block`: whole as soon as there is any weight, `blend`: by the weight; several add up, and
/// what is binary is gone when held back at all); binds of several expressions add up.
class ExpressionRig {
 public:
    ExpressionRig() = default;
    [[nodiscard]] static ExpressionRig build(const Model& model);

    [[nodiscard]] FaceState make_state() const { return rest_; }
    /// Number of expressions.
    [[nodiscard]] std::size_t size() const noexcept { return expressions_.size(); }
    /// Name of expression `i`.
    [[nodiscard]] const std::string& name(std::size_t i) const noexcept {
        return expressions_[i].name;
    }
    /// Expression of a name; -1: none.
    [[nodiscard]] int find(std::string_view name) const noexcept;
    /// Morph weights of a node's mesh.
    [[nodiscard]] MorphRange morphs_of(int node) const noexcept {
        return ranges_[static_cast<std::size_t>(node)];
    }

    /// Index in FaceState::materials of a material; -1: expressions leave it as it is.
    [[nodiscard]] int face_of_material(int material) const noexcept {
        return face_of_material_[static_cast<std::size_t>(material)];
    }

    /// Puts the weights of a face into `weights`, by expression of the model; its own others are 0.
    /// Of a model that lacks surprised, relaxed or happy another expression shows some of it.
    /// Threads: any. Real-time: yes.
    void spread(const Face& face, std::span<float> weights) const noexcept;

    /// Face for weights by expression (0..1, clamped). `state` must be of this rig.
    /// Threads: any. Real-time: yes.
    void apply(std::span<const float> weights, FaceState& state) const noexcept;

 private:
    // Which overrides hold an expression back.
    enum class Group : std::uint8_t { none, blink, look_at, mouth };
    static constexpr std::size_t kGroupCount = 4;

    struct Slot {
        std::size_t index = 0;  // in FaceState::morphs
        float weight = 1.0F;
    };
    struct Colour {
        std::size_t material = 0;  // in FaceState::materials
        ColourBindKind kind = ColourBindKind::base;
        glm::vec4 change{0.0F};
    };
    struct Texture {
        std::size_t material = 0;
        glm::vec2 scale{1.0F};
        glm::vec2 offset{0.0F};
    };
    struct StandIn {
        std::size_t lacking = 0;  // FaceExpression
        std::size_t shown = 0;    // in expressions_
        float share = 1.0F;
    };
    struct Built {
        std::string name;
        Group group = Group::none;
        bool is_binary = false;
        std::array<ExpressionOverride, kGroupCount> overrides{};  // by Group
        std::vector<Slot> morphs;
        std::vector<Colour> colours;
        std::vector<Texture> textures;
    };

    static Group group_of(const Expression& expression) noexcept;
    void add_morphs(const Model& model, const ModelNode& node);
    void add(const Model& model, const Expression& expression);
    void add_morph_binds(const Expression& expression, Built& built);
    void find_stand_ins();
    std::size_t material_face(const Model& model, int material);
    void weigh(std::span<const float> weights, std::span<float> out) const noexcept;
    void add_binds(const Built& expression, float weight, FaceState& state) const noexcept;

    std::vector<Built> expressions_;
    std::vector<MorphRange> ranges_;                   // by node
    std::vector<std::size_t> bound_;                   // morphs that expressions set
    std::array<int, kFaceExpressionCount> presets_{};  // expression; -1: none
    std::vector<StandIn> stand_ins_;
    std::vector<int> face_of_material_;  // in rest_.materials; -1: none
    FaceState rest_;
};

}  // namespace raks::render
