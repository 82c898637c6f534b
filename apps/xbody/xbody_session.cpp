#include "apps/xbody/xbody_session.hpp"

#include <algorithm>
#include <utility>

#include "base/printable.hpp"
#include "render/import/humanoid_map.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// What looks for bones needs triangles, but neither pictures nor clips.
render::Model without_pictures(const render::Model& model) {
    render::Model light;
    light.nodes = model.nodes;
    light.roots = model.roots;
    light.meshes = model.meshes;
    light.skins = model.skins;
    light.character = model.character;
    return light;
}

void look_for_bones(XbodySession& session) {
    render::Model model = without_pictures(*session.model);
    const render::BoneLabels labels{.file = "labels", .bones = session.labels.now()};
    session.humanoid = render::look_for_bones(model, &labels);
    if (!model.warnings.empty()) {
        session.message = model.warnings.front();
    }
}

/// Carries out actions.
class Doer {
 public:
    explicit Doer(XbodySession& session) : session_(session) {}

    void operator()(const ChooseNode& action) const {
        session_.node = action.node;
        see_node();
        const auto& nodes = session_.humanoid.nodes;
        const auto* const bone = std::find(nodes.begin(), nodes.end(), action.node);
        if (bone != nodes.end()) {
            session_.bone = static_cast<motion::Bone>(bone - nodes.begin());
        }
    }
    void operator()(const ChooseBone& action) const {
        session_.bone = action.bone;
        const int node = session_.humanoid.nodes[motion::index_of(action.bone)];
        if (!session_.node && node >= 0) {
            session_.node = node;
            see_node();
        }
    }
    void operator()(const GiveLabel& /*action*/) const {
        if (!may_label()) {
            return;
        }
        if (!session_.node || !session_.bone) {
            session_.message = "Pick a node in the tree and a bone on the right, then Label";
            return;
        }
        const auto done =
            engine::label_bone(*session_.model, *session_.bone, *session_.node, session_.labels);
        if (!done) {
            session_.message = done.error().message;
            return;
        }
        session_.message = fmt::format("{} is {}",
                                       printable(name_of(*session_.node), 40),
                                       motion::kBoneNames[motion::index_of(*session_.bone)]);
        look_for_bones(session_);
    }
    void operator()(const TakeLabel& /*action*/) const {
        if (may_label() && session_.bone) {
            engine::unlabel_bone(*session_.bone, session_.labels);
            changed();
        }
    }
    void operator()(const UndoLabel& /*action*/) const {
        session_.labels.undo();
        changed();
    }
    void operator()(const RedoLabel& /*action*/) const {
        session_.labels.redo();
        changed();
    }
    void operator()(const NextAxis& /*action*/) const {
        const auto& labels = session_.labels.now();
        const auto label = std::find_if(labels.begin(), labels.end(), [this](const auto& one) {
            return session_.bone == one.bone;
        });
        if (label == labels.end()) {
            session_.message = "Label a bone first, then say along which axis it points";
            return;
        }
        engine::set_rest_axis(label->bone, engine::next_rest_axis(label->axis), session_.labels);
        changed();
    }
    void operator()(const FoldBranch& action) const {
        auto folded = session_.tree.is_folded[static_cast<std::size_t>(action.node)];
        folded = !folded;
    }
    void operator()(const HideBranch& action) const {
        toggle_branch(*session_.model, action.node, session_.tree);
    }
    void operator()(const SearchNodes& action) const {
        session_.tree.search = action.text;
        session_.is_searching = action.is_searching;
        session_.first_row = 0;
    }
    void operator()(const ShowPage& action) const {
        session_.page = action.page;
        session_.first_line = 0;
    }
    void operator()(const ScrollTree& action) const {
        session_.first_row = action.first_row;
        session_.is_node_to_see = false;
    }
    void operator()(const ScrollPage& action) const { session_.first_line = action.first_line; }
    void operator()(const GoToFrame& action) const { session_.transport.go_to(action.frame); }
    void operator()(const TransportKey& action) const {
        static_cast<void>(session_.transport.handle(action.key));
    }
    void operator()(const PlayOrPause& /*action*/) const { session_.transport.toggle_pause(); }
    void operator()(const SetRate& action) const { session_.transport.set_rate(action.rate); }
    void operator()(const MoveCamera& action) const { session_.camera = action.camera; }
    void operator()(const DrawNames& action) const { session_.has_names = action.is_on; }
    void operator()(const DrawBones& action) const { session_.has_bones = action.is_on; }
    void operator()(const DrawSprings& action) const {
        session_.has_springs = action.is_on;
        const render::Character& character = session_.model->character;
        if (action.is_on && character.springs.empty() && character.colliders.empty()) {
            session_.message = "Nothing swings in this file";
        }
    }
    void operator()(const DrawWireframe& action) const { session_.is_wireframe = action.is_on; }
    void operator()(const PaintModel& action) const {
        session_.paint = action.paint;
        if (action.paint == ModelPaint::weights && !session_.node) {
            session_.message = "Pick a joint in the tree or in the picture to see what it moves";
        }
    }
    void operator()(const TunePose& action) const { session_.tuning = action.tuning; }

 private:
    // Opens the branches that it is in.
    void see_node() const {
        session_.is_node_to_see = true;
        for (int up = *session_.node; up >= 0;) {
            up = session_.model->nodes[static_cast<std::size_t>(up)].parent;
            if (up >= 0) {
                session_.tree.is_folded[static_cast<std::size_t>(up)] = false;
            }
        }
    }
    [[nodiscard]] const std::string& name_of(int node) const {
        return session_.model->nodes[static_cast<std::size_t>(node)].name;
    }
    [[nodiscard]] bool may_label() const {
        if (!session_.can_label()) {
            session_.message = "This file names its bones itself: labels would not count";
        }
        return session_.can_label();
    }
    void changed() const {
        session_.message.clear();
        look_for_bones(session_);
    }

    XbodySession& session_;
};

}  // namespace

bool XbodySession::can_label() const { return model->character.humanoid.nodes[0] < 0; }

ModelLook XbodySession::look() const {
    return {.paint = is_wireframe && paint == ModelPaint::own ? ModelPaint::dark : paint,
            .joint = paint == ModelPaint::weights ? node.value_or(-1) : -1,
            .is_hidden = tree.is_hidden};
}

XbodyMarks XbodySession::marks() const {
    return {.has_bones = has_bones,
            .has_names = has_names,
            .has_springs = has_springs,
            .is_wireframe = is_wireframe,
            .chosen = node.value_or(-1)};
}

XbodySession xbody_session(const render::Model& model,
                           const std::vector<render::BoneLabel>& labels,
                           engine::ClipTransport transport,
                           const render::Camera& camera) {
    XbodySession session{.model = &model,
                         .tree = tree_view(model),
                         .labels = engine::bone_labelling(labels),
                         .humanoid = {},
                         .transport = std::move(transport),
                         .camera = camera,
                         .node = {},
                         .bone = {},
                         .tuning = {},
                         .message = {}};
    look_for_bones(session);
    return session;
}

void apply(const XbodyAction& action, XbodySession& session) { std::visit(Doer(session), action); }

}  // namespace raks::apps
