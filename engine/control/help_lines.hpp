#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/control/action_table.hpp"

namespace raks::engine {

/// One line of the help panel: keys that do the same, or the same to either side.
struct HelpLine {
    ActionGroup group{};
    std::vector<std::string> keys;  ///< as written on the keys; many in a row as one: "1-9"
    std::string_view text;          ///< "back, forward 5 s"; lives as long as the program
};

/// "PLAYING".
[[nodiscard]] std::string_view title_of(ActionGroup group) noexcept;

/// The lines of the table's actions for which `is_there`, in its order.
[[nodiscard]] std::vector<HelpLine> help_lines(const std::function<bool(Action)>& is_there);

}  // namespace raks::engine
