#include "apps/raks_capture/correct_pane.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/raks_capture/pane_sizes.hpp"
#include "render/panes/name_tags.hpp"
#include "render/panes/timeline.hpp"
#include "render/panes/widgets.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

using capture::PlaceSource;
using render::Box;
using render::ButtonLook;
using render::PaneFrame;
using render::PicturePlace;

constexpr render::Colour kViolet{0xA878FF};

render::Colour doubt_colour(capture::Doubt doubt) {
    switch (doubt) {
        case capture::Doubt::lost:
            return render::palette::kRed;
        case capture::Doubt::filled:
            return render::palette::kAmber;
        default:
            return kViolet;
    }
}

/// The pane while it is drawn.
class CorrectPane {
 public:
    CorrectPane(const PaneFrame& frame, const CorrectSession& session, const CorrectScene& scene)
        : frame_(frame),
          session_(session),
          scene_(scene),
          layout_(layout_of(frame.area, session, scene)),
          colours_(scene.markers.colours()),
          classes_(scene.markers.classes()) {}

    std::vector<CorrectWish> draw() {
        for (const KeyEvent& key : frame_.keys) {
            for (const CorrectWish& wish : wishes_of_key(key, session_, scene_)) {
                wishes_.push_back(wish);
            }
        }
        bar();
        for (std::size_t camera = 0; camera < scene_.views.size(); ++camera) {
            if (layout_.views[camera].width > 0.0F) {
                view(camera);
            }
        }
        list();
        draw_timeline();
        lines();
        return std::move(wishes_);
    }

 private:
    void wish(const CorrectAction& action) { wishes_.emplace_back(action); }

    bool button(const Box& box, std::string_view label, bool is_on = true) {
        return pane_button(frame_, box, label, is_on ? ButtonLook::usual : ButtonLook::off);
    }
    bool toggle(const Box& box, std::string_view label, bool is_down) {
        return pane_button(frame_, box, label, is_down ? ButtonLook::chosen : ButtonLook::usual);
    }

    void bar() {
        if (toggle(layout_.play, session_.is_playing ? "Pause" : "Play", session_.is_playing)) {
            wish(TogglePlay{});
        }
        const bool has_flags = !session_.tracks.flags.empty();
        if (button(layout_.flag_before, "< Flag", has_flags)) {
            wish(ShowFlag{.is_next = false});
        }
        if (button(layout_.flag_after, "Flag >", has_flags)) {
            wish(ShowFlag{.is_next = true});
        }
        if (button(layout_.worst, "Worst")) {
            wish(ShowWorst{});
        }
        if (session_.is_of_joints) {
            buttons_of_joints();
        } else {
            buttons_of_markers();
        }
        if (button(layout_.track,
                   scene_.is_tracking ? "tracking ..." : "Track again",
                   !scene_.is_tracking && !scene_.is_tracked)) {
            wishes_.emplace_back(TrackAgain{});
        }
        if (button(layout_.undo, "Undo", session_.edits.can_undo())) {
            wish(UndoEdit{});
        }
        if (button(layout_.redo, "Redo", session_.edits.can_redo())) {
            wish(RedoEdit{});
        }
        if (button(layout_.save,
                   session_.edits.is_saved() ? "Saved" : "Save",
                   !session_.edits.is_saved())) {
            wishes_.emplace_back(SaveEdits{});
        }
    }

    void buttons_of_markers() {
        if (button(layout_.hide, "Hide")) {
            wish(HideMarker{});
        }
        if (button(layout_.fill, "Fill")) {
            wish(FillMarker{});
        }
        if (toggle(layout_.swap, "Swap with ...", session_.is_swapping)) {
            wish(BeginSwap{});
        }
    }

    void buttons_of_joints() {
        if (button(layout_.exchange, "Exchange sides")) {
            wish(ExchangeSides{});
        }
        if (button(layout_.exchange_limb, "Limb's sides")) {
            wish(ExchangeSides{.is_of_limb = true});
        }
        if (button(layout_.hide, "Hide joint")) {
            wish(HideMarker{});
        }
        if (button(layout_.hide_view, "Hide person")) {
            wish(HideView{});
        }
    }

    void view(std::size_t camera) {
        const CorrectView& view = scene_.views[camera];
        const PicturePlace place(layout_.views[camera], view.width, view.height, view.zoom);
        const render::PictureGesture gesture =
            picture_view(frame_, session_.cameras[camera], place, view.picture);
        if (gesture.zoom) {
            wishes_.emplace_back(SetViewZoom{camera, *gesture.zoom});
        }
        point(camera, place, gesture);
        const render::PaneClip clip(frame_, layout_.views[camera]);
        if (view.picture == nullptr) {
            frame_.pen.outline(place.whole(), render::pane_colours::kLine, 0.0F);
        }
        for (const capture::Detection& spot : view.spots) {
            const glm::vec2 at = place.in_box(spot.pixel);
            frame_.pen.dot(at.x, at.y, 2.0F, colour_of(spot.colour).faded(0.8F));
        }
        if (view.skeleton) {
            draw_placed(frame_, place, view.placed);
            draw_skeleton(frame_, place, *view.skeleton);
            draw_doubted(camera, place);
        }
        draw_markers(camera, place);
        draw_head(camera);
    }

    // Rings around the joints that a flag names in this view.
    void draw_doubted(std::size_t camera, const PicturePlace& place) const {
        for (const capture::Flag& flag : session_.tracks.flags) {
            const auto& seen = scene_.views[camera].places[flag.marker];
            if (seen && flag.camera == session_.cameras[camera] && is_here(flag)) {
                const glm::vec2 at = place.in_box(*seen);
                frame_.pen.ring(at.x, at.y, 6.5F, render::palette::kRed);
            }
        }
    }
    [[nodiscard]] bool is_here(const capture::Flag& flag) const {
        return flag.first <= session_.frame && session_.frame <= flag.last;
    }

    [[nodiscard]] render::Colour colour_of(std::size_t colour) const {
        return render::named_colour(colours_[colour]);
    }
    [[nodiscard]] render::Colour colour_of_marker(std::size_t marker) const {
        return session_.is_of_joints ? colour_of_side(session_.tracks.markers[marker])
                                     : colour_of(classes_[marker]);
    }

    static float units_between(const PicturePlace& place,
                               const glm::dvec2& one,
                               const glm::dvec2& other) {
        return static_cast<float>(glm::distance(one, other) * place.unit());
    }

    void point(std::size_t camera,
               const PicturePlace& place,
               const render::PictureGesture& gesture) {
        using Kind = render::PictureGesture::Kind;
        const bool is_held_here = session_.held && session_.held->camera == camera;
        if (gesture.kind == Kind::press) {
            if (session_.is_of_joints && session_.camera != camera) {
                wish(ChooseView{camera});
            }
            press(camera, place, gesture.pixel);
        } else if (gesture.kind == Kind::drag && is_held_here) {
            HeldMarker held = *session_.held;
            held.has_moved = held.has_moved ||
                             units_between(place, held.from, gesture.pixel) > pane_sizes::kMoves;
            held.pixel = meant(camera, place, gesture.pixel);
            wish(HoldMarker{held});
        } else if (gesture.kind == Kind::release && is_held_here) {
            wish(LetGoOfMarker{});
        }
    }

    // A spot of the marker's colour that is near, or the pixel itself.
    [[nodiscard]] glm::dvec2 meant(std::size_t camera,
                                   const PicturePlace& place,
                                   const glm::dvec2& pixel) const {
        const CorrectView& view = scene_.views[camera];
        glm::dvec2 meant =
            glm::clamp(pixel, glm::dvec2(0.0), glm::dvec2(view.width - 1, view.height - 1));
        float nearest = pane_sizes::kNear;
        for (const capture::Detection& spot : view.spots) {
            const float away = units_between(place, spot.pixel, pixel);
            if (spot.colour == classes_[session_.marker] && away < nearest) {
                nearest = away;
                meant = spot.pixel;
            }
        }
        return meant;
    }

    // The marker that is looked at is taken where the pointer is near it, or where it is not seen
    // at all; else the nearest other one is chosen. Joints that are not seen are not set by a
    // click, which chooses the view.
    void press(std::size_t camera, const PicturePlace& place, const glm::dvec2& pixel) {
        const auto& places = scene_.views[camera].places;
        const auto away = [&](std::size_t marker) {
            return places[marker] ? units_between(place, *places[marker], pixel) : HUGE_VALF;
        };
        const std::size_t own = session_.marker;
        std::size_t nearest = own;
        for (std::size_t marker = 0; marker < places.size(); ++marker) {
            nearest = away(marker) < away(nearest) ? marker : nearest;
        }
        const bool is_own = !session_.is_swapping && away(own) < pane_sizes::kNear;
        if (!is_own && away(nearest) < pane_sizes::kNear) {
            wish(ChooseMarker{nearest});
        } else if (is_own) {
            wish(HoldMarker{{camera, pixel, pixel, false}});
        } else if (!places[own] && !session_.is_swapping && !session_.is_of_joints) {
            wish(HoldMarker{{camera, pixel, meant(camera, place, pixel), true}});
        }
    }

    void draw_markers(std::size_t camera, const PicturePlace& place) {
        const auto& places = scene_.views[camera].places;
        std::vector<render::NameTag> tags;
        for (std::size_t marker = 0; marker < places.size(); ++marker) {
            if (!places[marker] || marker == session_.marker) {
                continue;
            }
            const glm::vec2 at = place.in_box(*places[marker]);
            const bool is_filled =
                session_.tracks.at(session_.frame, marker).source == PlaceSource::filled;
            // Joints are drawn already.
            if (!session_.is_of_joints) {
                frame_.pen.ring(
                    at.x, at.y, 5.0F, colour_of_marker(marker).faded(is_filled ? 0.45F : 0.9F));
            }
            if ((session_.alone && !session_.is_of_joints) || session_.is_swapping) {
                tags.push_back({at, session_.tracks.markers[marker], render::palette::kDim});
            }
        }
        draw_chosen(camera, place, tags);
        draw_tags(frame_, tags);
    }

    void draw_chosen(std::size_t camera,
                     const PicturePlace& place,
                     std::vector<render::NameTag>& tags) const {
        const bool is_held = session_.held && session_.held->camera == camera;
        const auto& seen = scene_.views[camera].places[session_.marker];
        const auto pixel = is_held ? std::optional(session_.held->has_moved ? session_.held->pixel
                                                   : seen                   ? *seen
                                                                            : session_.held->pixel)
                                   : seen;
        if (!pixel) {
            return;
        }
        const glm::vec2 at = place.in_box(*pixel);
        frame_.pen.dot(at.x, at.y, 4.0F, {0x000000, 0.7F});
        frame_.pen.dot(at.x, at.y, 3.0F, colour_of_marker(session_.marker));
        frame_.pen.ring(
            at.x, at.y, 9.0F, is_held ? render::palette::kAmber : render::palette::kText);
        tags.insert(tags.begin(),
                    {at, session_.tracks.markers[session_.marker], render::palette::kText});
    }

    void draw_head(std::size_t camera) const {
        const Box& box = layout_.views[camera];
        const CorrectView& view = scene_.views[camera];
        const render::Pen& pen = frame_.pen;
        const std::string head = fmt::format("{}  {}", camera + 1, session_.cameras[camera]) +
                                 (view.note.empty() ? std::string() : "   " + view.note);
        const ImFont* const font = pen.fonts().small;
        const float width = std::min(pen.width_of(font, head) + 10.0F, box.width);
        const bool is_chosen = session_.is_of_joints && session_.camera == camera;
        if (is_chosen) {
            pen.outline(box, render::palette::kTeal, 2.0F);
        }
        pen.fill({box.x, box.y, width, 18.0F}, {0x000000, 0.6F}, 3.0F);
        pen.text(font,
                 box.x + 5.0F,
                 box.y + 1.0F,
                 is_chosen ? render::palette::kTeal : render::palette::kText,
                 head,
                 render::Align::left,
                 box.width - 8.0F);
    }

    void list() {
        const render::Pen& pen = frame_.pen;
        pen.text(pen.fonts().bold,
                 layout_.title.x + 4.0F,
                 layout_.title.y + 2.0F,
                 session_.is_swapping ? render::palette::kAmber : render::palette::kText,
                 session_.is_swapping    ? "Swap with which?"
                 : session_.is_of_joints ? "Joints of the dancer"
                                         : "Markers");
        if (session_.is_of_joints) {
            draw_legend(frame_, layout_.legend);
        }
        const std::size_t count = classes_.size();
        const std::size_t rows = layout_.markers.size();
        const std::size_t first = std::min(scene_.first_row, count - rows);
        for (std::size_t row = 0; row < rows; ++row) {
            marker_row(layout_.markers[row], first + row);
        }
        const bool is_over_list =
            frame_.pointer.x >= layout_.title.x && frame_.pointer.y < layout_.timeline.y;
        if (is_over_list && frame_.wheel != 0.0F && rows < count) {
            wishes_.emplace_back(
                SetMarkerRow{pane_sizes::scrolled(first, frame_.wheel, rows, count)});
        }
    }

    [[nodiscard]] bool is_flagged(std::size_t marker) const {
        const auto& flags = session_.tracks.flags;
        return std::any_of(flags.begin(), flags.end(), [&](const capture::Flag& flag) {
            return flag.marker == marker && is_here(flag);
        });
    }

    void marker_row(const Box& box, std::size_t marker) {
        const capture::MarkerPlace& place = session_.tracks.at(session_.frame, marker);
        const std::string note = place.source == PlaceSource::seen
                                     ? fmt::format("{} views", static_cast<int>(place.views))
                                 : place.source == PlaceSource::filled ? "filled"
                                                                       : "lost";
        const render::PaneRow row{
            session_.tracks.markers[marker],
            note,
            colour_of_marker(marker),
            is_flagged(marker) ? render::palette::kAmber : render::palette::kText,
            session_.marker == marker,
            place.source == PlaceSource::seen};
        if (pane_row(frame_, box, row)) {
            wish(ChooseMarker{marker});
        }
    }

    void draw_timeline() {
        std::vector<render::TimelineMark> marks;
        // Those of the marker that is looked at come last, over the others.
        for (const bool is_own : {false, true}) {
            for (const capture::Flag& flag : session_.tracks.flags) {
                if ((flag.marker == session_.marker) == is_own) {
                    marks.push_back({flag.first,
                                     flag.last,
                                     static_cast<std::size_t>(flag.doubt),
                                     doubt_colour(flag.doubt).faded(is_own ? 1.0F : 0.3F)});
                }
            }
        }
        double most = 20.0;
        for (const double error : scene_.errors) {
            most = std::isnan(error) ? most : std::max(most, error);
        }
        constexpr double kTop = 100.0;  // mm; what is worse need not be told apart
        const double top = std::min(10.0 * std::ceil(most / 10.0), kTop);
        const std::string top_text = fmt::format("{:.0f} mm", top);
        render::TimelineState state;
        state.frame_count = session_.tracks.frame_count;
        state.frame = session_.frame;
        state.curve = scene_.errors;
        state.top = top;
        state.title = "error";
        state.top_text = top_text;
        state.marks = marks;
        state.rows.assign(std::begin(capture::kDoubtNames), std::end(capture::kDoubtNames));
        if (session_.stretch) {
            state.stretch_first = session_.stretch->first;
            state.stretch_last = session_.stretch->last;
        }
        if (const auto frame = timeline(frame_, layout_.timeline, state)) {
            wish(ShowFrame{*frame});
        }
    }

    void lines() const {
        const render::Pen& pen = frame_.pen;
        const bool has_message = !scene_.message.empty();
        pen.text(pen.fonts().body,
                 layout_.status.x,
                 layout_.status.y,
                 has_message ? render::palette::kAmber : render::palette::kText,
                 has_message ? scene_.message : what_is_seen(),
                 render::Align::left,
                 layout_.status.width);
        pen.text(
            pen.fonts().small,
            layout_.keys.x,
            layout_.keys.y,
            render::palette::kDim,
            session_.is_of_joints
                ? "Space play   Left, Right step   N, B flag   W worst   Up, Down joint   Tab view "
                  "  "
                  "1-9 one view   F near, all   drag: set   [ ] stretch   E exchange (Shift: limb) "
                  "  "
                  "H, P hide joint, person   T track   U, Y undo, redo   S save   Q close"
                : "Space play   Left, Right step   N, B flag   W worst   Up, Down marker   1-9 one "
                  "view   F near, all   drag: set   [ ] stretch   H hide   I fill   E swap   T "
                  "track "
                  "again   U, Y undo, redo   S save   Q close",
            render::Align::left,
            layout_.keys.width);
    }

    [[nodiscard]] std::string what_is_seen() const {
        if (session_.is_swapping) {
            return fmt::format(
                "Click the marker that {} changes places with from frame {} on; Esc: none",
                session_.tracks.markers[session_.marker],
                session_.frame);
        }
        const capture::MarkerPlace& place = session_.tracks.at(session_.frame, session_.marker);
        std::string text = fmt::format("Frame {} of {}, {:.2f} s.  {}: ",
                                       session_.frame,
                                       session_.tracks.frame_count,
                                       session_.tracks.time_of(session_.frame),
                                       session_.tracks.markers[session_.marker]);
        text += place.source == PlaceSource::lost
                    ? (session_.is_of_joints ? "lost" : "lost; click it in two views")
                    : fmt::format("{}, {:.0f} mm",
                                  place.source == PlaceSource::seen ? "seen" : "filled",
                                  1000.0 * place.deviation);
        for (const capture::Flag& flag : session_.tracks.flags) {
            if (flag.marker == session_.marker && is_here(flag)) {
                text += fmt::format("; {}{} from {} to {}",
                                    capture::kDoubtNames[static_cast<std::size_t>(flag.doubt)],
                                    flag.camera.empty() ? "" : " in " + flag.camera,
                                    flag.first,
                                    flag.last);
            }
        }
        const FrameStretch meant =
            session_.is_of_joints ? session_.meant_in_view() : session_.meant();
        text += session_.is_of_joints
                    ? fmt::format(".  Exchange, hide in {}: ", session_.cameras[session_.camera])
                    : ".  Hide, fill: ";
        text += meant.first == meant.last ? fmt::format("frame {}", meant.first)
                                          : fmt::format("frames {} to {}", meant.first, meant.last);
        return text + fmt::format(".  {} edits", session_.edits.now().size());
    }

    const PaneFrame& frame_;
    const CorrectSession& session_;
    const CorrectScene& scene_;
    CorrectLayout layout_;
    std::vector<std::string> colours_;
    std::vector<std::size_t> classes_;
    std::vector<CorrectWish> wishes_;
};

}  // namespace

std::vector<CorrectWish> correct_pane(const PaneFrame& frame,
                                      const CorrectSession& session,
                                      const CorrectScene& scene) {
    return CorrectPane(frame, session, scene).draw();
}

}  // namespace raks::apps
