// Keys of the correct pane.
#include <algorithm>
#include <optional>

#include "apps/raks_capture/correct_pane.hpp"

#include <glm/common.hpp>

namespace raks::apps {
namespace {

using Wishes = std::vector<CorrectWish>;

constexpr std::size_t kFarStep = 10;  // frames, with Shift

Wishes step(const CorrectSession& session, const KeyEvent& key) {
    const std::size_t by = key.has_shift ? kFarStep : 1;
    const std::size_t frame = session.frame;
    return {
        CorrectAction(ShowFrame{key.key == Key::right ? frame + by : frame - std::min(frame, by)})};
}

Wishes list_key(const CorrectSession& session, bool is_down) {
    const std::size_t count = session.tracks.markers.size();
    // While swapping the list is not walked through: the first step would be the other marker.
    return session.is_swapping ? Wishes{}
                               : Wishes{CorrectAction(ChooseMarker{
                                     (session.marker + (is_down ? 1 : count - 1)) % count})};
}

// The part of a view in which the markers are, with room around it.
render::PictureZoom around_markers(const CorrectView& view) {
    constexpr double kShare = 0.75;  // of the view that the markers fill
    const glm::dvec2 size(view.width, view.height);
    glm::dvec2 low = size;
    glm::dvec2 high(0.0);
    for (const auto& place : view.places) {
        if (place) {
            low = glm::min(low, *place);
            high = glm::max(high, *place);
        }
    }
    const glm::dvec2 share = (high - low) / size;
    const double most = std::max(share.x, share.y);
    if (!(most > 0.0)) {
        return {};
    }
    return {std::clamp(kShare / most, 1.0, render::PictureZoom::kMostTimes),
            0.5 * (low + high) / size};
}

// All of every picture, or the dancer where all of it is seen already.
Wishes near_or_whole(const CorrectScene& scene) {
    const bool is_whole =
        std::all_of(scene.views.begin(), scene.views.end(), [](const CorrectView& view) {
            return view.zoom == render::PictureZoom{};
        });
    Wishes wishes;
    for (std::size_t camera = 0; camera < scene.views.size(); ++camera) {
        wishes.emplace_back(SetViewZoom{
            camera, is_whole ? around_markers(scene.views[camera]) : render::PictureZoom{}});
    }
    return wishes;
}

Wishes letter_key(const KeyEvent& key, const CorrectSession& session, const CorrectScene& scene) {
    switch (static_cast<char32_t>(key.key)) {
        case U'[':
            return {CorrectAction(SetStretch{.is_first = true})};
        case U']':
            return {CorrectAction(SetStretch{.is_first = false})};
        case U'b':
            return {CorrectAction(ShowFlag{.is_next = false})};
        case U'n':
            return {CorrectAction(ShowFlag{.is_next = true})};
        case U'e':
            return session.is_of_joints ? Wishes{CorrectAction(ExchangeSides{key.has_shift})}
                                        : Wishes{CorrectAction(BeginSwap{})};
        case U'h':
            return {CorrectAction(HideMarker{})};
        case U'p':
            return session.is_of_joints ? Wishes{CorrectAction(HideView{})} : Wishes{};
        case U'i':
            return {CorrectAction(FillMarker{})};
        case U'q':
            return {CloseEdits{}};
        case U's':
            return {SaveEdits{}};
        case U't':
            return {TrackAgain{}};
        case U'u':
            return {CorrectAction(UndoEdit{})};
        case U'w':
            return {CorrectAction(ShowWorst{})};
        case U'y':
            return {CorrectAction(RedoEdit{})};
        case U'z':
            return {key.has_shift ? CorrectAction(RedoEdit{}) : CorrectAction(UndoEdit{})};
        case U'f':
            return near_or_whole(scene);
        case U'0':
            return {CorrectAction(ShowView{})};
        default:
            break;
    }
    const auto digit = static_cast<std::size_t>(key.key) - std::size_t{U'1'};
    if (key.key < Key{U'1'} || key.key > Key{U'9'} || digit >= session.cameras.size()) {
        return {};
    }
    // The same once more shows all.
    return {CorrectAction(ShowView{session.alone == digit ? std::nullopt : std::optional(digit)})};
}

}  // namespace

std::vector<CorrectWish> wishes_of_key(const KeyEvent& key,
                                       const CorrectSession& session,
                                       const CorrectScene& scene) {
    switch (key.key) {
        case Key::space:
            return {CorrectAction(TogglePlay{})};
        case Key::left:
        case Key::right:
            return step(session, key);
        case Key::home:
            return {CorrectAction(ShowFrame{0})};
        case Key::end:
            return {CorrectAction(ShowFrame{session.tracks.frame_count})};
        case Key::up:
            return list_key(session, false);
        case Key::down:
            return list_key(session, true);
        case Key::tab:
            return {CorrectAction(ChooseView{(session.camera + 1) % session.cameras.size()})};
        case Key::escape:
            return {CorrectAction(ForgetStretch{})};
        default:
            return letter_key(key, session, scene);
    }
}

}  // namespace raks::apps
