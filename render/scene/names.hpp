#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raks::render {

/// "theme \"stge\" is unknown, did you mean \"stage\"? (known: stage, ...)": the one line for a
/// name that is not in a table. `what` is the kind of thing; `known` is not empty.
[[nodiscard]] std::string unknown_name(std::string_view what,
                                       std::string_view name,
                                       std::span<const std::string_view> known);

}  // namespace raks::render
