#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "base/key.hpp"
#include "engine/control/action_dispatcher.hpp"
#include "render/overlay/overlay.hpp"

namespace raks::engine {

/// The list of keys over the picture, page by page where not all have room. Threads: main.
class HelpList {
 public:
    /// Opens it; while it is open turns to its next page, and closes it behind the last.
    void turn(std::vector<render::HelpRow> rows);
    void close() { rows_.clear(); }  ///< nothing is shown from here on
    /// Whether it is open.
    [[nodiscard]] bool is_open() const noexcept { return !rows_.empty(); }

    /// Puts it into the overlay.
    void show(render::OverlayState& overlay) const;
    /// Takes how many pages the last picture had room for.
    void set_pages(std::size_t pages) noexcept { pages_ = pages; }
    /// The key that is written at a spot of the list, as if it was pressed; none: no single key is.
    [[nodiscard]] std::optional<KeyEvent> key_at(const render::OverlaySpot& spot) const;

 private:
    std::vector<render::HelpRow> rows_;  // none: closed
    std::size_t page_ = 0;
    std::size_t pages_ = 1;
};

/// The rows of the list: the content's own keys, then the lines of the table whose actions
/// `actions` handles, without keys that the content uses itself.
[[nodiscard]] std::vector<render::HelpRow> help_rows(std::vector<render::HelpRow> own,
                                                     const ActionDispatcher& actions);

/// The press of a key by the name that is written on it: "Left", "Shift+F3", "?". None: it names no
/// key. Pure.
[[nodiscard]] std::optional<KeyEvent> key_named(std::string_view name);

}  // namespace raks::engine
