#include "apps/xbody/xbody_pane.hpp"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/printable.hpp"
#include "render/import/humanoid_map.hpp"
#include "render/panes/picture_view.hpp"
#include "render/panes/timeline.hpp"
#include "render/panes/widgets.hpp"

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using render::Box;
using render::ButtonLook;
using render::MouseButton;
using render::PaneFrame;

namespace palette = render::palette;

/// The first row after a turn of the wheel.
std::size_t scrolled(std::size_t first, float wheel, std::size_t rows, std::size_t count) {
    constexpr std::size_t kStep = 3;
    const std::size_t last = count > rows ? count - rows : 0;
    return wheel > 0.0F ? first - std::min(first, kStep) : std::min(first + kStep, last);
}

bool holds(const Box& box, const glm::vec2& place) {
    return place.x >= box.x && place.x < box.right() && place.y >= box.y && place.y < box.bottom();
}

/// The pane while it is drawn.
class XbodyPane {
 public:
    XbodyPane(const PaneFrame& frame, const XbodySession& session, const XbodyView& view)
        : frame_(frame),
          pen_(frame.pen),
          session_(session),
          view_(view),
          layout_(xbody_layout(frame.area)) {}

    std::vector<XbodyWish> draw() {
        for (const KeyEvent& key : frame_.keys) {
            for (XbodyWish& one : wishes_of_key(key, session_)) {
                wishes_.push_back(std::move(one));
            }
        }
        model();
        views();
        search();
        tree();
        page();
        labelling();
        transport();
        lines();
        return std::move(wishes_);
    }

 private:
    void wish(XbodyAction action) { wishes_.emplace_back(std::move(action)); }

    bool button(const Box& box, std::string_view label, bool is_possible, bool is_chosen = false) {
        return pane_button(frame_,
                           box,
                           label,
                           !is_possible ? ButtonLook::off
                           : is_chosen  ? ButtonLook::chosen
                                        : ButtonLook::usual);
    }

    void text(const Box& box, float indent, render::Colour colour, std::string_view line) const {
        pen_.text(pen_.fonts().body,
                  box.x + indent,
                  box.y + 2.0F,
                  colour,
                  line,
                  render::Align::left,
                  box.width - indent - 4.0F);
    }

    // The model was drawn already; its bones lie over it.
    void model() {
        const render::PaneItem item = pane_item(layout_.view, "model", frame_);
        const ImGuiIO& io = ImGui::GetIO();
        const glm::vec2 moved = glm::vec2(io.MouseDelta.x, io.MouseDelta.y) / pen_.unit();
        constexpr float kClick = 4.0F;  // pixels that a hand moves while it clicks
        const bool has_dragged = io.MouseDragMaxDistanceSqr[0] > kClick * kClick;
        if (item.is_clicked && !has_dragged) {
            pick();
        }
        render::Camera camera = session_.camera;
        if (ImGui::IsItemActive() && has_dragged) {
            constexpr float kTurn = 0.008F;  // radians a unit
            camera.orbit(-kTurn * moved.x, kTurn * moved.y);
        }
        if (item.is_hovered &&
            (frame_.holds(MouseButton::right) || frame_.holds(MouseButton::middle))) {
            const float metres = camera.distance / layout_.view.height * 0.5F;
            camera.pan(-metres * moved.x, metres * moved.y);
        }
        if (item.is_hovered && frame_.wheel != 0.0F) {
            camera.zoom(frame_.wheel > 0.0F ? 0.88F : 1.0F / 0.88F);
        }
        if (!(camera == session_.camera)) {
            wish(MoveCamera{camera});
        }
        if (session_.has_bones) {
            const render::PaneClip clip(frame_, layout_.view);
            draw_skeleton(frame_,
                          view_.seen,
                          {.has_names = session_.has_names, .chosen = session_.node.value_or(-1)});
        }
    }

    void pick() {
        constexpr float kNear = 12.0F;
        const auto distance = [&](const SeenNode& node) {
            return glm::distance(node.at, frame_.pointer);
        };
        const auto nearest = std::min_element(
            view_.seen.begin(), view_.seen.end(), [&](const auto& one, const auto& other) {
                return distance(one) < distance(other);
            });
        if (nearest != view_.seen.end() && distance(*nearest) < kNear) {
            wish(ChooseNode{nearest->node});
        }
    }

    void views() {
        constexpr std::array<std::pair<const char*, const char*>, 4> kViews = {
            {{"Front", "front"}, {"Side", "side"}, {"Back", "back"}, {"Top", "top"}}};
        for (std::size_t i = 0; i < kViews.size(); ++i) {
            if (button(layout_.views[i], kViews[i].first, true)) {
                wishes_.emplace_back(FitView{kViews[i].second});
            }
        }
        if (button(layout_.views[4], "Frame it", true)) {
            wishes_.emplace_back(FrameChosen{});
        }
        if (button(layout_.views[5], "Bones", true, session_.has_bones)) {
            wish(DrawBones{!session_.has_bones});
        }
        if (button(layout_.views[6], "Names", true, session_.has_names)) {
            wish(DrawNames{!session_.has_names});
        }
    }

    void search() {
        const render::PaneItem item = pane_item(layout_.search, "search", frame_);
        pen_.fill(layout_.search, render::pane_colours::kSunken, 5.0F);
        pen_.outline(layout_.search,
                     session_.is_searching ? palette::kTeal : render::pane_colours::kLine,
                     5.0F);
        const std::string& wanted = session_.tree.search;
        const std::string shown = session_.is_searching ? wanted + "_"
                                  : wanted.empty()      ? "Search a node: /"
                                                        : wanted;
        text({layout_.search.x, layout_.search.y + 3.0F, layout_.search.width, 20.0F},
             8.0F,
             wanted.empty() ? palette::kDim : palette::kText,
             shown);
        if (item.is_clicked) {
            wish(SearchNodes{wanted, true});
        }
    }

    void tree() {
        const std::vector<TreeRow> rows = tree_rows(*session_.model, session_.tree);
        const Box all{layout_.rows.front().x,
                      layout_.rows.front().y,
                      layout_.rows.front().width,
                      layout_.rows.back().bottom() - layout_.rows.front().y};
        if (frame_.wheel != 0.0F && holds(all, frame_.pointer)) {
            wish(ScrollTree{
                scrolled(session_.first_row, frame_.wheel, layout_.rows.size(), rows.size())});
        }
        for (std::size_t i = 0; i < layout_.rows.size() && session_.first_row + i < rows.size();
             ++i) {
            tree_row(layout_.rows[i], rows[session_.first_row + i]);
        }
        const bool is_hidden =
            session_.node && session_.tree.is_hidden[static_cast<std::size_t>(*session_.node)];
        if (button(layout_.hide,
                   is_hidden ? "Show this branch (H)" : "Hide this branch (H)",
                   session_.node.has_value())) {
            wish(HideBranch{*session_.node});
        }
    }

    void tree_row(const Box& box, const TreeRow& row) {
        constexpr float kIndent = 10.0F;
        constexpr int kDeepest = 12;  // that is indented
        const auto index = static_cast<std::size_t>(row.node);
        const std::string id = fmt::format("node {}", row.node);
        const float indent = kIndent * static_cast<float>(std::min(row.depth, kDeepest));
        const render::PaneItem item = pane_item(box, id, frame_);
        const bool is_chosen = session_.node == row.node;
        if (is_chosen || item.is_hovered) {
            pen_.fill(box,
                      is_chosen ? render::pane_colours::kChosen : render::pane_colours::kRaised,
                      4.0F);
        }
        const float middle = box.y + box.height / 2.0F;
        const float left = box.x + indent;
        if (row.has_children) {
            fold_mark({left + 2.0F, middle}, session_.tree.is_folded[index]);
        }
        pen_.dot(left + 18.0F, middle, 4.0F, colour_of(view_.kinds[index]));
        const std::string_view kind = words_of(view_.kinds[index]);
        const float note = pen_.width_of(pen_.fonts().small, kind);
        const std::string& name = session_.model->nodes[index].name;
        text({box.x, box.y, box.width - note - 8.0F, box.height},
             indent + 26.0F,
             session_.tree.is_hidden[index] ? palette::kDim.faded(0.5F) : palette::kText,
             name.empty() ? fmt::format("(node {})", row.node) : printable(name, 60));
        pen_.text(pen_.fonts().small,
                  box.right() - 4.0F,
                  box.y + 3.0F,
                  palette::kDim,
                  kind,
                  render::Align::right);
        if (item.is_clicked) {
            const bool is_fold = row.has_children && frame_.pointer.x < left + 12.0F;
            wish(is_fold ? XbodyAction(FoldBranch{row.node}) : XbodyAction(ChooseNode{row.node}));
        }
    }

    void fold_mark(const glm::vec2& at, bool is_folded) const {
        if (is_folded) {
            pen_.triangle(
                {at.x, at.y - 4.0F}, {at.x + 6.0F, at.y}, {at.x, at.y + 4.0F}, palette::kDim);
        } else {
            pen_.triangle({at.x - 1.0F, at.y - 3.0F},
                          {at.x + 7.0F, at.y - 3.0F},
                          {at.x + 3.0F, at.y + 4.0F},
                          palette::kDim);
        }
    }

    void page() {
        constexpr std::array<const char*, 3> kPages = {"Bones", "Meshes", "File"};
        for (std::size_t i = 0; i < kPages.size(); ++i) {
            const auto one = static_cast<XbodyPage>(i);
            // The view's own button is named "Bones", too.
            ImGui::PushID("page");
            if (button(layout_.pages[i], kPages[i], true, session_.page == one)) {
                wish(ShowPage{one});
            }
            ImGui::PopID();
        }
        if (session_.page == XbodyPage::bones) {
            bones();
        } else {
            texts(session_.page == XbodyPage::meshes ? view_.meshes : view_.file);
        }
    }

    void scroll_page(std::size_t count) {
        const Box all{layout_.lines.front().x,
                      layout_.lines.front().y,
                      layout_.lines.front().width,
                      layout_.lines.back().bottom() - layout_.lines.front().y};
        if (frame_.wheel != 0.0F && holds(all, frame_.pointer)) {
            wish(ScrollPage{
                scrolled(session_.first_line, frame_.wheel, layout_.lines.size(), count)});
        }
    }

    void bones() {
        const std::vector<motion::Bone> bones = listed_bones(session_.humanoid);
        scroll_page(bones.size());
        for (std::size_t i = 0; i < layout_.lines.size() && session_.first_line + i < bones.size();
             ++i) {
            bone_row(layout_.lines[i], bones[session_.first_line + i]);
        }
    }

    void bone_row(const Box& box, motion::Bone bone) {
        const std::size_t index = motion::index_of(bone);
        const int node = session_.humanoid.nodes[index];
        const render::BoneReason reason = session_.humanoid.reasons[index];
        const bool is_missing = node < 0 && is_needed(bone, session_.humanoid);
        const std::string note =
            node >= 0
                ? fmt::format(
                      "{}, {}",
                      printable(session_.model->nodes[static_cast<std::size_t>(node)].name, 24),
                      words_of(reason))
            : is_missing ? "missing"
                         : "";
        const render::PaneRow row{.name = motion::kBoneNames[index],
                                  .note = note,
                                  .swatch = is_missing ? palette::kRed : palette::kAmber,
                                  .text = is_missing  ? palette::kRed
                                          : node >= 0 ? palette::kText
                                                      : palette::kDim,
                                  .is_chosen = session_.bone == bone,
                                  .is_ticked = reason == render::BoneReason::label ||
                                               reason == render::BoneReason::stated};
        if (pane_row(frame_, box, row)) {
            wish(ChooseBone{bone});
        }
    }

    static bool is_needed(motion::Bone bone, const render::HumanoidMap& humanoid) {
        const auto is_in = [bone](const auto& bones) {
            return std::find(bones.begin(), bones.end(), bone) != bones.end();
        };
        return humanoid.is_of_parts ? is_in(render::kRequiredParts) : is_in(render::kRequiredBones);
    }

    void texts(const std::vector<XbodyLine>& all) {
        scroll_page(all.size());
        for (std::size_t i = 0; i < layout_.lines.size() && session_.first_line + i < all.size();
             ++i) {
            const XbodyLine& line = all[session_.first_line + i];
            text(layout_.lines[i],
                 line.is_title ? 4.0F : 14.0F,
                 line.is_warning ? palette::kAmber
                 : line.is_title ? palette::kTeal
                                 : palette::kText,
                 line.text);
        }
    }

    void labelling() {
        const bool can_label = session_.can_label();
        if (button(layout_.label, "Label", can_label && session_.node && session_.bone)) {
            wish(GiveLabel{});
        }
        if (button(layout_.unlabel, "Remove", can_label && session_.bone)) {
            wish(TakeLabel{});
        }
        if (button(layout_.undo, "Undo", session_.labels.can_undo())) {
            wish(UndoLabel{});
        }
        if (button(layout_.redo, "Redo", session_.labels.can_redo())) {
            wish(RedoLabel{});
        }
        if (button(layout_.save,
                   session_.labels.is_saved() ? "Saved" : "Save",
                   !session_.labels.is_saved())) {
            wishes_.emplace_back(SaveXbody{});
        }
    }

    void transport() {
        const render::OverlayTransport clip = session_.transport.picture();
        const std::size_t last = clip.frame_count - 1;
        const std::size_t now = clip.frame;
        const bool has_clip = last > 0;
        const std::array<std::pair<const char*, std::size_t>, 4> steps = {
            {{"|<", 0},
             {"<", now - std::min<std::size_t>(now, 1)},
             {">", std::min(now + 1, last)},
             {">|", last}}};
        for (std::size_t i = 0; i < steps.size(); ++i) {
            const Box& box = layout_.steps[i < 2 ? i : i + 1];
            if (button(box, steps[i].first, has_clip)) {
                wish(GoToFrame{steps[i].second});
            }
        }
        if (button(layout_.steps[2], clip.is_paused ? "Play" : "Pause", has_clip)) {
            wish(PlayOrPause{});
        }
        pen_.fill(layout_.number, render::pane_colours::kSunken, 5.0F);
        const std::string typed(clip.typed);
        text({layout_.number.x, layout_.number.y + 3.0F, layout_.number.width, 20.0F},
             8.0F,
             typed.empty() ? palette::kText : palette::kTeal,
             typed.empty() ? fmt::format("{} of {}", now, clip.frame_count) : typed + "_");
        if (button(layout_.slower, "-", has_clip)) {
            wish(SetRate{clip.rate - 0.25});
        }
        pen_.text(pen_.fonts().body,
                  layout_.rate.x + layout_.rate.width / 2.0F,
                  layout_.rate.y + 5.0F,
                  palette::kText,
                  fmt::format("x {:g}", clip.rate),
                  render::Align::middle);
        if (button(layout_.faster, "+", has_clip)) {
            wish(SetRate{clip.rate + 0.25});
        }
        const render::TimelineState state{.frame_count = clip.frame_count,
                                          .frame = now,
                                          .title = has_clip ? "frames" : "no motion"};
        const auto chosen = timeline(frame_, layout_.timeline, state);
        if (has_clip && chosen && *chosen != now) {
            wish(GoToFrame{*chosen});
        }
    }

    void lines() const {
        text(layout_.status, 0.0F, palette::kAmber, session_.message);
        pen_.text(
            pen_.fonts().small,
            layout_.keys.x,
            layout_.keys.y + 3.0F,
            palette::kDim,
            "drag turns, right drag moves, wheel goes nearer   F frame it   B bones   N names   "
            "L label   X remove   U undo   Y redo   S save   , . Home End frames   0-9 Enter go "
            "to   [ ] rate   Q close",
            render::Align::left,
            layout_.keys.width);
    }

    const PaneFrame& frame_;
    const render::Pen& pen_;
    const XbodySession& session_;
    const XbodyView& view_;
    XbodyLayout layout_;
    std::vector<XbodyWish> wishes_;
};

}  // namespace

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
    return XbodyPane(frame, session, view).draw();
}

}  // namespace raks::apps
