#include "apps/xbody/xbody_pane.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "apps/xbody/xbody_drawing.hpp"
#include "render/import/humanoid_map.hpp"

namespace raks::apps {
namespace {

using render::MouseButton;
using render::PaneFrame;

namespace palette = render::palette;

/// The pane while it is drawn.
class XbodyPane {
 public:
    explicit XbodyPane(XbodyDrawing& drawing) : d_(drawing) {}

    void draw() {
        for (const KeyEvent& key : d_.frame.keys) {
            for (XbodyWish& one : wishes_of_key(key, d_.session)) {
                d_.wishes.push_back(std::move(one));
            }
        }
        if (!d_.frame.dropped.empty()) {
            d_.wishes.emplace_back(TakeFiles{d_.frame.dropped});
        }
        model();
        views();
        looks();
        draw_tree(d_);
        draw_pages(d_);
        draw_transport(d_);
        lines();
    }

 private:
    // The model was drawn already; its bones lie over it.
    void model() {
        const render::PaneItem item = pane_item(d_.layout.view, "model", d_.frame);
        const ImGuiIO& io = ImGui::GetIO();
        const glm::vec2 moved = glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / d_.pen().unit();
        constexpr float kClick = 4.0F;  // pixels that a hand moves while it clicks
        const bool has_dragged = io.MouseDragMaxDistanceSqr[0] > kClick * kClick;
        if (item.is_clicked && !has_dragged) {
            pick();
        }
        render::Camera camera = d_.session.camera;
        if (ImGui::IsItemActive() && has_dragged) {
            constexpr float kTurn = 0.008F;  // radians a unit
            camera.orbit(-kTurn * moved.x, kTurn * moved.y);
        }
        if (item.is_hovered &&
            (d_.frame.holds(MouseButton::right) || d_.frame.holds(MouseButton::middle))) {
            const float metres = camera.distance / d_.layout.view.height * 0.5F;
            camera.pan(-metres * moved.x, metres * moved.y);
        }
        if (item.is_hovered && d_.frame.wheel != 0.0F) {
            camera.zoom(d_.frame.wheel > 0.0F ? 0.88F : 1.0F / 0.88F);
        }
        if (!(camera == d_.session.camera)) {
            d_.wish(MoveCamera{camera});
        }
        XbodyMarks marks = d_.session.marks();
        const SeenNode* const pointed =
            item.is_hovered ? node_near(d_.view.seen.skeleton, d_.frame.pointer) : nullptr;
        marks.pointed = pointed == nullptr ? -1 : pointed->node;
        draw_marks(d_.frame, d_.layout.view, d_.view.seen, marks);
    }

    // A joint is picked before the surface that hides it.
    void pick() {
        const SeenNode* const joint =
            d_.session.has_bones ? node_near(d_.view.seen.skeleton, d_.frame.pointer) : nullptr;
        if (joint != nullptr) {
            d_.wish(ChooseNode{joint->node});
        } else {
            d_.wishes.emplace_back(PickSurface{d_.frame.pointer});
        }
    }

    void views() {
        constexpr std::array<std::pair<const char*, const char*>, 4> kViews = {
            {{"Front", "front"}, {"Side", "side"}, {"Back", "back"}, {"Top", "top"}}};
        for (std::size_t i = 0; i < kViews.size(); ++i) {
            if (d_.button(d_.layout.views[i], kViews[i].first, true)) {
                d_.wishes.emplace_back(FitView{kViews[i].second});
            }
        }
        if (d_.button(d_.layout.views[4], "Frame it", true)) {
            d_.wishes.emplace_back(FrameChosen{});
        }
    }

    void looks() {
        const XbodySession& session = d_.session;
        const auto toggle = [&](std::size_t at, const char* label, bool is_on) {
            return d_.button(d_.layout.looks[at], label, true, is_on);
        };
        if (toggle(0, "Bones", session.has_bones)) {
            d_.wish(DrawBones{!session.has_bones});
        }
        if (toggle(1, "Names", session.has_names)) {
            d_.wish(DrawNames{!session.has_names});
        }
        if (toggle(2, "Springs", session.has_springs)) {
            d_.wish(DrawSprings{!session.has_springs});
        }
        constexpr std::array<const char*, 3> kPaints = {"Surface", "Normals", "Weights"};
        for (std::size_t i = 0; i < kPaints.size(); ++i) {
            const auto paint = static_cast<ModelPaint>(i);
            if (toggle(3 + i, kPaints[i], session.paint == paint)) {
                d_.wish(PaintModel{paint});
            }
        }
        if (toggle(6, "Wires", session.is_wireframe)) {
            d_.wish(DrawWireframe{!session.is_wireframe});
        }
    }

    void lines() const {
        const bool is_hint = d_.session.message.empty() && d_.session.can_label();
        d_.text(
            d_.layout.status,
            0.0F,
            is_hint ? palette::kDim : palette::kAmber,
            is_hint
                ? "Pick a node in the tree or in the picture, then the bone that it is, then Label."
                : d_.session.message);
        d_.pen().text(
            d_.pen().fonts().small,
            d_.layout.keys.x,
            d_.layout.keys.y + 3.0F,
            palette::kDim,
            "drag turns, right drag moves, wheel goes nearer   F frame it   B bones   N names   "
            "G springs   W wires   L label   X remove   U undo   Y redo   S save   , . Home End "
            "0-9 Enter frames   [ ] rate   Q close",
            render::Align::left,
            d_.layout.keys.width);
    }

    XbodyDrawing& d_;
};

}  // namespace

std::size_t XbodyDrawing::list_begin(const std::vector<render::Box>& rows,
                                     std::size_t first,
                                     std::size_t count) const {
    if (count <= rows.size()) {
        return 0;
    }
    const std::size_t begin = std::min(first, count - rows.size());
    const auto all = static_cast<float>(count);
    const float top = rows.front().y;
    const float height = rows.back().bottom() - top;
    pen().fill({rows.front().right() + 2.0F,
                top + height * static_cast<float>(begin) / all,
                3.0F,
                height * static_cast<float>(rows.size()) / all},
               palette::kDim.faded(0.6F),
               1.5F);
    return begin;
}

std::optional<std::size_t> XbodyDrawing::scrolled(const std::vector<render::Box>& rows,
                                                  std::size_t first,
                                                  std::size_t count) const {
    constexpr std::size_t kStep = 3;
    const glm::vec2& place = frame.pointer;
    const bool is_over = !rows.empty() && place.x >= rows.front().x &&
                         place.x < rows.front().right() && place.y >= rows.front().y &&
                         place.y < rows.back().bottom();
    const std::size_t last = count > rows.size() ? count - rows.size() : 0;
    if (!is_over || frame.wheel == 0.0F) {
        return std::nullopt;
    }
    return frame.wheel > 0.0F ? first - std::min(first, kStep) : std::min(first + kStep, last);
}

std::vector<motion::Bone> listed_bones(const render::HumanoidMap& humanoid) {
    std::vector<motion::Bone> bones;
    const auto add = [&bones](motion::Bone bone) {
        if (std::find(bones.begin(), bones.end(), bone) == bones.end()) {
            bones.push_back(bone);
        }
    };
    if (humanoid.is_of_parts) {
        std::for_each(render::kRequiredParts.begin(), render::kRequiredParts.end(), add);
    }
    std::for_each(render::kRequiredBones.begin(), render::kRequiredBones.end(), add);
    for (std::size_t i = 0; i < humanoid.nodes.size(); ++i) {
        add(static_cast<motion::Bone>(i));
    }
    return bones;
}

std::vector<XbodyWish> xbody_pane(const PaneFrame& frame,
                                  const XbodySession& session,
                                  const XbodyView& view) {
    XbodyDrawing drawing{frame, session, view, xbody_layout(frame.area)};
    XbodyPane(drawing).draw();
    return std::move(drawing.wishes);
}

}  // namespace raks::apps
