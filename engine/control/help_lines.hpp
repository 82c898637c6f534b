#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/control/action_table.hpp"

/// The lines of the help panel, made from the table of actions.
namespace raks::engine {

/// One line of the help panel: the keys that share a text, such as Left and Right.
struct HelpLine {
    ActionGroup group{};            ///< under whose title the line stands
    std::vector<std::string> keys;  ///< as written on the keys; many in a row as one: "1-9"
    std::string_view text;          ///< "back, forward 5 s"; lives as long as the program
};

/// Title of a group, in capitals: "PLAYING".
[[nodiscard]] std::string_view title_of(ActionGroup group) noexcept;

/// The lines of those actions for which `is_there` is true, in the table's order. Threads: any.
[[nodiscard]] std::vector<HelpLine> help_lines(const std::function<bool(Action)>& is_there);

}  // namespace raks::engine
