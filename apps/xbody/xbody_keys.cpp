// Keys of the Xbody pane.
#include <algorithm>
#include <string>

#include "apps/xbody/xbody_pane.hpp"

namespace raks::apps {
namespace {

constexpr double kRateStep = 0.25;

// While something is searched for, keys are its letters.
std::vector<XbodyWish> search_key(const KeyEvent& key, const XbodySession& session) {
    std::string text = session.tree.search;
    if (key.key == Key::enter || key.key == Key::tab) {
        return {XbodyAction(SearchNodes{text, false})};
    }
    if (key.key == Key::escape) {
        return {XbodyAction(SearchNodes{"", false})};
    }
    const auto character = static_cast<char32_t>(key.key);
    if (key.key == Key::backspace && !text.empty()) {
        text.pop_back();
    } else if (character >= U' ' && character < U'\x7F' && text.size() < 60) {
        text += static_cast<char>(character);
    }
    return {XbodyAction(SearchNodes{text, true})};
}

std::vector<XbodyWish> tree_key(Key key, const XbodySession& session) {
    const auto rows = tree_rows(*session.model, session.tree);
    if (rows.empty()) {
        return {};
    }
    const auto found = std::find_if(
        rows.begin(), rows.end(), [&](const TreeRow& row) { return session.node == row.node; });
    std::size_t index = found == rows.end() ? 0 : static_cast<std::size_t>(found - rows.begin());
    if (found != rows.end()) {
        index = key == Key::down ? std::min(index + 1, rows.size() - 1)
                                 : index - std::min<std::size_t>(index, 1);
    }
    return {XbodyAction(ChooseNode{rows[index].node})};
}

std::vector<XbodyWish> letter_key(const KeyEvent& key, const XbodySession& session) {
    switch (static_cast<char32_t>(key.key)) {
        case U'/':
            return {XbodyAction(SearchNodes{session.tree.search, true})};
        case U'a':
            return {XbodyAction(NextAxis{})};
        case U'b':
            return {XbodyAction(DrawBones{!session.has_bones})};
        case U'f':
            return {FrameChosen{}};
        case U'g':
            return {XbodyAction(DrawSprings{!session.has_springs})};
        case U'h':
            return session.node ? std::vector<XbodyWish>{XbodyAction(HideBranch{*session.node})}
                                : std::vector<XbodyWish>{};
        case U'l':
            return {XbodyAction(GiveLabel{})};
        case U'n':
            return {XbodyAction(DrawNames{!session.has_names})};
        case U'q':
            return {CloseXbody{}};
        case U's':
            return {SaveXbody{}};
        case U'u':
            return {XbodyAction(UndoLabel{})};
        case U'w':
            return {XbodyAction(DrawWireframe{!session.is_wireframe})};
        case U'x':
            return {XbodyAction(TakeLabel{})};
        case U'y':
            return {XbodyAction(RedoLabel{})};
        case U'z':
            return {key.has_shift ? XbodyAction(RedoLabel{}) : XbodyAction(UndoLabel{})};
        case U'[':
            return {XbodyAction(SetRate{session.transport.rate() - kRateStep})};
        case U']':
            return {XbodyAction(SetRate{session.transport.rate() + kRateStep})};
        default:
            return {};
    }
}

}  // namespace

std::vector<XbodyWish> wishes_of_key(const KeyEvent& key, const XbodySession& session) {
    if (session.is_searching) {
        return search_key(key, session);
    }
    if (key.key == Key::up || key.key == Key::down) {
        return tree_key(key.key, session);
    }
    auto wishes = letter_key(key, session);
    if (wishes.empty()) {
        wishes = {XbodyAction(TransportKey{key})};
    }
    return wishes;
}

}  // namespace raks::apps
