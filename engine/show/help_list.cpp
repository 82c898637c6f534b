#include "engine/show/help_list.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "engine/control/action_table.hpp"

namespace raks::engine {
namespace {

// The names of keys without a character.
constexpr std::array<std::pair<std::string_view, Key>, 27> kNamedKeys = {{
    {"Space", Key::space},
    {"Esc", Key::escape},
    {"Enter", Key::enter},
    {"Tab", Key::tab},
    {"Left", Key::left},
    {"Right", Key::right},
    {"Backspace", Key::backspace},
    {"Up", Key::up},
    {"Down", Key::down},
    {"Home", Key::home},
    {"End", Key::end},
    {"PgUp", Key::page_up},
    {"PgDn", Key::page_down},
    {"Page Up", Key::page_up},
    {"Page Down", Key::page_down},
    {"F1", Key::f1},
    {"F2", Key::f2},
    {"F3", Key::f3},
    {"F4", Key::f4},
    {"F5", Key::f5},
    {"F6", Key::f6},
    {"F7", Key::f7},
    {"F8", Key::f8},
    {"F9", Key::f9},
    {"F10", Key::f10},
    {"F11", Key::f11},
    {"F12", Key::f12},
}};

}  // namespace

void HelpList::turn(std::vector<render::HelpRow> rows) {
    if (!is_open()) {
        rows_ = std::move(rows);
        page_ = 0;
        pages_ = 1;
    } else if (++page_ >= pages_) {
        close();
    }
}

void HelpList::show(render::OverlayState& overlay) const {
    overlay.help = rows_;
    overlay.help_page = page_;
}

std::optional<KeyEvent> HelpList::key_at(const render::OverlaySpot& spot) const {
    if (spot.part != render::PanelPart::key || spot.row >= rows_.size() ||
        spot.item >= rows_[spot.row].keys.size()) {
        return std::nullopt;
    }
    return key_named(rows_[spot.row].keys[spot.item]);
}

std::optional<KeyEvent> key_named(std::string_view name) {
    constexpr std::string_view kShift = "Shift+";
    KeyEvent event;
    event.has_shift = name.starts_with(kShift);
    if (event.has_shift) {
        name.remove_prefix(kShift.size());
    }
    const auto named = std::find_if(
        kNamedKeys.begin(), kNamedKeys.end(), [&](const auto& key) { return key.first == name; });
    if (named != kNamedKeys.end()) {
        event.key = named->second;
        return event;
    }
    if (name.size() != 1) {
        return std::nullopt;
    }
    event.key = key_of(static_cast<char32_t>(static_cast<unsigned char>(name.front())));
    return event;
}

std::vector<render::HelpRow> help_rows(std::vector<render::HelpRow> own,
                                       const ActionDispatcher& actions) {
    // True for a key that one of the content's own rows names.
    const auto is_own = [own](const std::string& key) {
        return std::any_of(own.begin(), own.end(), [&](const render::HelpRow& row) {
            return std::find(row.keys.begin(), row.keys.end(), key) != row.keys.end();
        });
    };
    std::vector<render::HelpRow> rows = std::move(own);
    for (HelpLine& line : help_lines([&](Action action) { return actions.handles(action); })) {
        // A line of the table that loses all its keys to the content is left out.
        std::erase_if(line.keys, is_own);
        if (!line.keys.empty()) {
            rows.push_back(
                {std::string(title_of(line.group)), std::move(line.keys), std::string(line.text)});
        }
    }
    return rows;
}

}  // namespace raks::engine
