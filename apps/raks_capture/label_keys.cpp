// Keys of the label pane.
#include <algorithm>
#include <optional>

#include "apps/raks_capture/label_pane.hpp"

#include <glm/geometric.hpp>

namespace raks::apps {
namespace {

std::size_t stepped(std::size_t index, std::size_t count, bool is_forward) {
    return (index + (is_forward ? 1 : count - 1)) % count;
}

// The marker that the place that was picked has the colour of, if it is a spot: the one that is
// proposed, else the first of the colour without a label.
std::optional<std::size_t> likely_marker(const LabelSession& session, const LabelView& view) {
    constexpr double kSame = 0.5;  // pixels
    const auto spot = std::find_if(
        view.proposals.begin(), view.proposals.end(), [&](const LabelProposal& proposal) {
            return glm::distance(proposal.pixel, *session.picked) < kSame;
        });
    if (spot == view.proposals.end()) {
        return std::nullopt;
    }
    const std::vector<std::size_t> classes = session.markers.classes();
    for (std::size_t marker = 0; marker < classes.size() && !spot->marker; ++marker) {
        if (classes[marker] == spot->colour && session.label_of(marker) == nullptr) {
            return marker;
        }
    }
    return spot->marker;
}

std::vector<LabelWish> list_key(Key key, const LabelSession& session) {
    const std::size_t count = session.markers.markers.size();
    const bool is_down = key == Key::down;
    const std::size_t next = session.chosen ? stepped(*session.chosen, count, is_down)
                             : is_down      ? 0
                                            : count - 1;
    // Rows are walked through without naming what was picked.
    return {LabelAction(ForgetChoice{}), LabelAction(ChooseName{next})};
}

std::vector<LabelWish> removal(const LabelSession& session) {
    for (std::size_t marker = 0; marker < session.markers.markers.size(); ++marker) {
        const capture::MarkerLabel* const label = session.label_of(marker);
        const bool is_picked =
            label != nullptr && session.picked && label->pixel == *session.picked;
        if (is_picked || (label != nullptr && !session.picked && session.chosen == marker)) {
            return {LabelAction(RemoveLabel{marker})};
        }
    }
    return {};
}

std::vector<LabelWish> letter_key(const KeyEvent& key,
                                  const LabelSession& session,
                                  const LabelView& view) {
    switch (static_cast<char32_t>(key.key)) {
        case U'a':
            return {LabelAction(AcceptProposals{view.proposals})};
        case U'f':
            return {SetLabelZoom{}};
        case U'q':
            return {CloseLabels{}};
        case U's':
            return {SaveLabels{}};
        case U'u':
            return {LabelAction(UndoLabels{})};
        case U'x':
            return removal(session);
        case U'y':
            return {LabelAction(RedoLabels{})};
        case U'z':
            return {key.has_shift ? LabelAction(RedoLabels{}) : LabelAction(UndoLabels{})};
        default:
            break;
    }
    const auto digit = static_cast<std::size_t>(key.key) - std::size_t{U'1'};
    return key.key >= Key{U'1'} && key.key <= Key{U'9'} && digit < session.cameras.size()
               ? std::vector<LabelWish>{LabelAction(ShowCamera{digit})}
               : std::vector<LabelWish>{};
}

}  // namespace

std::vector<LabelWish> wishes_of_key(const KeyEvent& key,
                                     const LabelSession& session,
                                     const LabelView& view) {
    switch (key.key) {
        case Key::page_down:
        case Key::tab:
        case Key::page_up: {
            const bool is_forward = key.key != Key::page_up && !key.has_shift;
            return {LabelAction(
                ShowCamera{stepped(session.camera, session.cameras.size(), is_forward)})};
        }
        case Key::left:
            return session.picture() > 0
                       ? std::vector<LabelWish>{LabelAction(ShowPicture{session.picture() - 1})}
                       : std::vector<LabelWish>{};
        case Key::right:
            return {LabelAction(ShowPicture{session.picture() + 1})};
        case Key::home:
            return {LabelAction(ShowPicture{0})};
        case Key::up:
        case Key::down:
            return list_key(key.key, session);
        case Key::enter: {
            const auto likely = session.picked ? likely_marker(session, view) : std::nullopt;
            return likely ? std::vector<LabelWish>{LabelAction(ChooseName{*likely})}
                          : std::vector<LabelWish>{};
        }
        case Key::escape:
            return {LabelAction(ForgetChoice{})};
        case Key::backspace:
            return removal(session);
        default:
            return letter_key(key, session, view);
    }
}

}  // namespace raks::apps
