// Xbody session: what a person does while looking at a model and labelling it, as a value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "apps/xbody/model_look.hpp"
#include "apps/xbody/model_tree.hpp"
#include "apps/xbody/pose_tuning.hpp"
#include "apps/xbody/xbody_marks.hpp"
#include "base/key.hpp"
#include "engine/show/bone_labelling.hpp"
#include "engine/show/clip_transport.hpp"
#include "motion/skeleton/humanoid.hpp"
#include "render/model/model.hpp"
#include "render/scene/camera.hpp"

namespace raks::apps {

/// What the right pane shows.
enum class XbodyPage : std::uint8_t { bones, pose, meshes, file, film };

/// A person's work on one model. Threads: one.
struct XbodySession {
    const render::Model* model = nullptr;  ///< as it was read; outlives the session
    TreeView tree;
    engine::BoneLabelling labels;
    render::HumanoidMap humanoid;     ///< by the labels as they are now
    engine::ClipTransport transport;  ///< of the motion
    render::Camera camera;
    XbodyPage page = XbodyPage::bones;
    std::optional<int> node;           ///< that is chosen
    std::optional<motion::Bone> bone;  ///< that is chosen
    bool is_node_to_see = false;       ///< the tree is to show it
    std::size_t first_row = 0;         ///< of the tree
    std::size_t first_line = 0;        ///< of the right pane
    bool has_names = false;            ///< beside the bones
    bool has_bones = true;             ///< drawn over the mesh
    bool has_springs = false;          ///< chains and colliders are drawn
    bool is_wireframe = false;         ///< edges of triangles alone
    ModelPaint paint = ModelPaint::own;
    PoseTuning tuning;          ///< by the sliders
    bool is_searching = false;  ///< letters go into the search
    std::string message;        ///< what there is to say; may be empty

    /// Whether labels say anything here: the file does not name its bones itself.
    [[nodiscard]] bool can_label() const;
    /// How the model is drawn.
    [[nodiscard]] ModelLook look() const;
    /// What is drawn over it.
    [[nodiscard]] XbodyMarks marks() const;
};

/// A session that begins with these labels. `model`: as it was read, outlives it.
[[nodiscard]] XbodySession xbody_session(const render::Model& model,
                                         const std::vector<render::BoneLabel>& labels,
                                         engine::ClipTransport transport,
                                         const render::Camera& camera);

/// A node was picked, in the tree or in the view.
struct ChooseNode {
    int node = -1;
};
/// A bone was picked; the node that it has is chosen with it where none was.
struct ChooseBone {
    motion::Bone bone = motion::Bone::hips;
};
/// The chosen node becomes the chosen bone.
struct GiveLabel {};
/// What a label says of the chosen bone is taken away.
struct TakeLabel {};
/// The last step is taken back.
struct UndoLabel {};
/// Or done again.
struct RedoLabel {};
/// The label of the chosen bone says another rest axis: the next of them.
struct NextAxis {};
/// A branch is folded or opened.
struct FoldBranch {
    int node = -1;
};
/// A branch is hidden or shown again.
struct HideBranch {
    int node = -1;
};
/// The tree shows what has this in its name.
struct SearchNodes {
    std::string text;
    bool is_searching = true;
};
/// The right pane shows something else.
struct ShowPage {
    XbodyPage page = XbodyPage::bones;
};
/// A list moves.
struct ScrollTree {
    std::size_t first_row = 0;
};
/// The same of the right pane.
struct ScrollPage {
    std::size_t first_line = 0;
};
/// Another frame, or another rate.
struct GoToFrame {
    std::size_t frame = 0;
};
/// A key that says which frame: as ClipTransport::handle.
struct TransportKey {
    KeyEvent key;
};
/// It plays, or pauses.
struct PlayOrPause {};
/// Multiples of the clip's own rate; -2 to 4.
struct SetRate {
    double rate = 1.0;
};
/// The view is turned, moved or goes nearer.
struct MoveCamera {
    render::Camera camera;
};
/// Names or bones are drawn, or not.
struct DrawNames {
    bool is_on = true;
};
struct DrawBones {
    bool is_on = true;
};

/// Chains and colliders are drawn, or not.
struct DrawSprings {
    bool is_on = true;
};
/// Edges are drawn alone, or not.
struct DrawWireframe {
    bool is_on = true;
};
/// Other colours.
struct PaintModel {
    ModelPaint paint = ModelPaint::own;
};
/// The sliders stand so.
struct TunePose {
    PoseTuning tuning;
};

using XbodyAction = std::variant<ChooseNode,
                                 ChooseBone,
                                 GiveLabel,
                                 TakeLabel,
                                 UndoLabel,
                                 RedoLabel,
                                 NextAxis,
                                 FoldBranch,
                                 HideBranch,
                                 SearchNodes,
                                 ShowPage,
                                 ScrollTree,
                                 ScrollPage,
                                 GoToFrame,
                                 TransportKey,
                                 PlayOrPause,
                                 SetRate,
                                 MoveCamera,
                                 DrawNames,
                                 DrawBones,
                                 DrawSprings,
                                 DrawWireframe,
                                 PaintModel,
                                 TunePose>;

/// Does what was asked for; what cannot be is said in the message.
void apply(const XbodyAction& action, XbodySession& session);

}  // namespace raks::apps
