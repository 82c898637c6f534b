#include "apps/raks_capture/label_pane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "apps/raks_capture/pane_sizes.hpp"
#include "render/panes/name_tags.hpp"
#include "render/panes/widgets.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using render::Box;
using render::PaneFrame;
using render::PicturePlace;

using namespace pane_sizes;

/// The pane while it is drawn.
class LabelPane {
 public:
    LabelPane(const PaneFrame& frame, const LabelSession& session, const LabelView& view)
        : frame_(frame),
          session_(session),
          view_(view),
          layout_(label_layout(frame.area, session.cameras.size(), session.markers.markers.size())),
          place_(layout_.picture, view.width, view.height, view.zoom),
          colours_(session.markers.colours()),
          classes_(session.markers.classes()) {}

    std::vector<LabelWish> draw() {
        for (const KeyEvent& key : frame_.keys) {
            for (LabelWish& wish : wishes_of_key(key, session_, view_)) {
                wishes_.push_back(std::move(wish));
            }
        }
        bar();
        picture();
        list();
        lines();
        return std::move(wishes_);
    }

 private:
    void wish(LabelAction action) { wishes_.emplace_back(std::move(action)); }

    bool button(const Box& box, std::string_view label, bool is_on) {
        return pane_button(
            frame_, box, label, is_on ? render::ButtonLook::usual : render::ButtonLook::off);
    }

    void bar() {
        for (std::size_t camera = 0; camera < session_.cameras.size(); ++camera) {
            const std::size_t count = session_.labelled_in(camera);
            const std::string label = count > 0
                                          ? fmt::format("{}: {}", session_.cameras[camera], count)
                                          : session_.cameras[camera];
            const auto look =
                camera == session_.camera ? render::ButtonLook::chosen : render::ButtonLook::usual;
            if (pane_button(frame_, layout_.cameras[camera], label, look)) {
                wish(ShowCamera{camera});
            }
        }
        const std::size_t number = session_.picture();
        if (button(layout_.before, "<", number > 0)) {
            wish(ShowPicture{number - 1});
        }
        if (button(layout_.after, ">", true)) {
            wish(ShowPicture{number + 1});
        }
        frame_.pen.text(frame_.pen.fonts().body,
                        layout_.number.x + layout_.number.width / 2.0F,
                        layout_.number.y + 7.0F,
                        render::palette::kText,
                        fmt::format("picture {}", number),
                        render::Align::middle);
        if (button(layout_.undo, "Undo", session_.labels.can_undo())) {
            wish(UndoLabels{});
        }
        if (button(layout_.redo, "Redo", session_.labels.can_redo())) {
            wish(RedoLabels{});
        }
        if (button(layout_.save,
                   session_.labels.is_saved() ? "Saved" : "Save",
                   !session_.labels.is_saved())) {
            wishes_.emplace_back(SaveLabels{});
        }
    }

    void picture() {
        const render::PictureGesture gesture =
            picture_view(frame_, "picture", place_, view_.picture);
        if (gesture.zoom) {
            wishes_.emplace_back(SetLabelZoom{*gesture.zoom});
        }
        // What is shown while the next picture is read is not the one that a click would be for.
        if (!view_.is_loading) {
            point(gesture);
        }
        const render::PaneClip clip(frame_, layout_.picture);
        if (view_.picture == nullptr) {
            frame_.pen.outline(place_.whole(), render::pane_colours::kLine, 0.0F);
        }
        for (std::size_t marker = 0; marker < classes_.size(); ++marker) {
            draw_label(marker);
        }
        for (const LabelProposal& proposal : view_.proposals) {
            draw_proposal(proposal);
        }
        draw_tags(frame_, tags_);
        if (session_.picked) {
            draw_cross(*session_.picked);
        }
        if (view_.is_loading) {
            frame_.pen.text(frame_.pen.fonts().bold,
                            layout_.picture.x + layout_.picture.width / 2.0F,
                            layout_.picture.y + layout_.picture.height / 2.0F,
                            render::palette::kText,
                            "reading the film ...",
                            render::Align::middle);
        }
    }

    void point(const render::PictureGesture& gesture) {
        using Kind = render::PictureGesture::Kind;
        if (gesture.kind == Kind::press) {
            press(gesture.pixel);
        } else if (gesture.kind == Kind::drag) {
            drag(gesture.pixel);
        } else if (gesture.kind == Kind::release && session_.moved) {
            wish(LetGoOfLabel{});
        }
    }

    [[nodiscard]] float units_between(const glm::dvec2& one, const glm::dvec2& other) const {
        return static_cast<float>(glm::distance(one, other) * place_.unit());
    }

    // A label under the pointer is taken; else the place is picked, or the spot that is near it.
    void press(const glm::dvec2& pixel) {
        std::optional<std::size_t> taken;
        float nearest = kNear;
        for (std::size_t marker = 0; marker < classes_.size(); ++marker) {
            const capture::MarkerLabel* const label = session_.label_of(marker);
            const bool is_meant = !session_.chosen || session_.chosen == marker;
            if (label != nullptr && is_meant && units_between(label->pixel, pixel) < nearest) {
                nearest = units_between(label->pixel, pixel);
                taken = marker;
            }
        }
        if (taken) {
            wish(MoveLabel{{*taken, pixel, false}});
            return;
        }
        glm::dvec2 meant = pixel;
        nearest = kNear;
        for (const LabelProposal& proposal : view_.proposals) {
            if (units_between(proposal.pixel, pixel) < nearest) {
                nearest = units_between(proposal.pixel, pixel);
                meant = proposal.pixel;
            }
        }
        const bool is_inside = meant.x >= -0.5 && meant.y >= -0.5 && meant.x < view_.width - 0.5 &&
                               meant.y < view_.height - 0.5;
        if (is_inside) {
            wish(PickPixel{meant});
        }
    }

    void drag(const glm::dvec2& pixel) {
        if (!session_.moved) {
            return;
        }
        const capture::MarkerLabel* const label = session_.label_of(session_.moved->marker);
        const bool has_moved = session_.moved->has_moved ||
                               (label != nullptr && units_between(label->pixel, pixel) > kMoves &&
                                units_between(session_.moved->pixel, pixel) > kMoves);
        const glm::dvec2 inside =
            glm::clamp(pixel, glm::dvec2(0.0), glm::dvec2(view_.width - 1, view_.height - 1));
        wish(MoveLabel{
            {session_.moved->marker, has_moved ? inside : session_.moved->pixel, has_moved}});
    }

    [[nodiscard]] render::Colour colour_of(std::size_t colour) const {
        return render::named_colour(colours_[colour]);
    }

    void draw_proposal(const LabelProposal& proposal) {
        const glm::vec2 at = place_.in_box(proposal.pixel);
        const render::Colour colour = colour_of(proposal.colour);
        if (view_.picture == nullptr) {
            frame_.pen.dot(at.x, at.y, 2.5F, colour);
        }
        frame_.pen.ring(at.x, at.y, 7.0F, colour.faded(0.75F));
        if (proposal.marker) {
            tags_.push_back(
                {at, session_.markers.markers[*proposal.marker].name + "?", render::palette::kDim});
        }
    }

    void draw_label(std::size_t marker) {
        const capture::MarkerLabel* const label = session_.label_of(marker);
        const bool is_held = session_.moved && session_.moved->marker == marker;
        if (label == nullptr) {
            return;
        }
        const bool is_moving = is_held && session_.moved->has_moved;
        const glm::vec2 at = place_.in_box(is_moving ? session_.moved->pixel : label->pixel);
        const render::Colour colour = colour_of(classes_[marker]);
        frame_.pen.dot(at.x, at.y, 5.0F, {0x000000, 0.7F});
        frame_.pen.dot(at.x, at.y, 3.5F, colour);
        frame_.pen.ring(at.x, at.y, 8.0F, render::palette::kText);
        tags_.push_back({at,
                         session_.markers.markers[marker].name,
                         is_held || session_.chosen == marker ? render::palette::kAmber
                                                              : render::palette::kText});
    }

    void draw_cross(const glm::dvec2& pixel) const {
        const glm::vec2 at = place_.in_box(pixel);
        frame_.pen.fill({at.x - 14.0F, at.y - 0.75F, 28.0F, 1.5F}, render::palette::kAmber);
        frame_.pen.fill({at.x - 0.75F, at.y - 14.0F, 1.5F, 28.0F}, render::palette::kAmber);
        frame_.pen.ring(at.x, at.y, 10.0F, render::palette::kAmber);
    }

    void list() {
        frame_.pen.text(frame_.pen.fonts().bold,
                        layout_.title.x + 4.0F,
                        layout_.title.y + 2.0F,
                        render::palette::kText,
                        session_.picked ? "Which marker is it?" : "Markers");
        frame_.pen.text(frame_.pen.fonts().small,
                        layout_.title.right() - 8.0F,
                        layout_.title.y + 4.0F,
                        render::palette::kDim,
                        "cameras",
                        render::Align::right);
        const std::size_t count = classes_.size();
        const std::size_t rows = layout_.markers.size();
        const std::size_t first = std::min(view_.first_row, count - rows);
        for (std::size_t row = 0; row < rows; ++row) {
            marker_row(layout_.markers[row], first + row);
        }
        const bool is_over_list = frame_.pointer.x >= layout_.title.x;
        if (is_over_list && frame_.wheel != 0.0F && rows < count) {
            wishes_.emplace_back(
                SetLabelRow{pane_sizes::scrolled(first, frame_.wheel, rows, count)});
        }
        const auto named = std::count_if(view_.proposals.begin(),
                                         view_.proposals.end(),
                                         [](const auto& proposal) { return proposal.marker; });
        if (button(layout_.accept,
                   named > 0 ? fmt::format("Accept {} proposed", named) : "Accept proposed",
                   named > 0)) {
            wish(AcceptProposals{view_.proposals});
        }
        const std::vector<LabelWish> removal =
            wishes_of_key({.key = Key::backspace}, session_, view_);
        if (button(layout_.remove, "Remove", !removal.empty())) {
            wishes_.insert(wishes_.end(), removal.begin(), removal.end());
        }
    }

    void marker_row(const Box& box, std::size_t marker) {
        const std::size_t cameras = session_.cameras_of(marker);
        const std::string note = cameras > 0 ? std::to_string(cameras) : "-";
        const bool is_here = session_.label_of(marker) != nullptr;
        const bool is_placed = cameras >= 2;
        const render::PaneRow row{session_.markers.markers[marker].name,
                                  note,
                                  colour_of(classes_[marker]),
                                  is_placed ? render::palette::kDim : render::palette::kText,
                                  session_.chosen == marker,
                                  is_here};
        if (pane_row(frame_, box, row)) {
            wish(ChooseName{marker});
        }
    }

    void lines() const {
        const render::Pen& pen = frame_.pen;
        const ImFont* const font = pen.fonts().body;
        pen.text(font,
                 layout_.status.x,
                 layout_.status.y,
                 view_.message.empty() ? render::palette::kText : render::palette::kAmber,
                 view_.message.empty() ? what_to_do() : view_.message,
                 render::Align::left,
                 layout_.status.width);
        pen.text(pen.fonts().small,
                 layout_.keys.x,
                 layout_.keys.y,
                 render::palette::kDim,
                 "Tab, 1-9 camera   Left, Right picture   Up, Down marker   Enter name the place   "
                 "A accept proposed   X remove   U, Y undo, redo   Wheel zoom   F all of it   "
                 "S save   Q close",
                 render::Align::left,
                 layout_.keys.width);
    }

    [[nodiscard]] std::string what_to_do() const {
        if (session_.picked) {
            return "Choose the name of this place in the list; Esc: none";
        }
        if (session_.chosen) {
            return fmt::format("Click {} in the picture; Esc: none",
                               session_.markers.markers[*session_.chosen].name);
        }
        return fmt::format(
            "Click a marker in the picture, then its name, or a name first. {} of {} labelled "
            "here; "
            "each needs two cameras",
            session_.labelled_in(session_.camera),
            classes_.size());
    }

    const PaneFrame& frame_;
    const LabelSession& session_;
    const LabelView& view_;
    LabelLayout layout_;
    PicturePlace place_;
    std::vector<std::string> colours_;
    std::vector<std::size_t> classes_;
    std::vector<render::NameTag> tags_;
    std::vector<LabelWish> wishes_;
};

}  // namespace

LabelLayout label_layout(const Box& area, std::size_t cameras, std::size_t markers) {
    using namespace pane_sizes;
    LabelLayout layout;
    const float right = area.right() - kMargin;
    float x = right;
    const auto from_right = [&](float width) {
        x -= width + 4.0F;
        return Box{x + 4.0F, area.y + kMargin, width, kBar};
    };
    layout.save = from_right(72.0F);
    layout.redo = from_right(58.0F);
    layout.undo = from_right(58.0F);
    x -= 12.0F;
    layout.after = from_right(30.0F);
    layout.number = from_right(100.0F);
    layout.before = from_right(30.0F);
    x -= 12.0F;
    const float room = x - area.x - kMargin;
    const float width = std::clamp(room / static_cast<float>(cameras) - 4.0F, 4.0F, 110.0F);
    for (std::size_t camera = 0; camera < cameras; ++camera) {
        layout.cameras.push_back({area.x + kMargin + static_cast<float>(camera) * (width + 4.0F),
                                  area.y + kMargin,
                                  width,
                                  kBar});
    }
    const float top = area.y + kBar + 2.0F * kMargin;
    const float bottom = area.bottom() - 2.0F * kLine - kMargin;
    const float list = right - kList;
    layout.picture = {
        area.x + kMargin, top, list - area.x - 2.0F * kMargin, bottom - top - kMargin};
    layout.title = {list, top, kList, 24.0F};
    layout.accept = {list, bottom - kMargin - kBar, kList - 84.0F, kBar};
    layout.remove = {layout.accept.right() + 4.0F, layout.accept.y, 80.0F, kBar};
    const float rows_top = layout.title.bottom() + 2.0F;
    layout.markers =
        marker_rows({list, rows_top, kList, layout.accept.y - kMargin - rows_top}, markers);
    layout.status = {area.x + kMargin, bottom, right - area.x - kMargin, kLine};
    layout.keys = {area.x + kMargin, bottom + kLine + 2.0F, right - area.x - kMargin, kLine};
    return layout;
}

std::vector<LabelWish> label_pane(const PaneFrame& frame,
                                  const LabelSession& session,
                                  const LabelView& view) {
    return LabelPane(frame, session, view).draw();
}

}  // namespace raks::apps
