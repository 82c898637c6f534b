#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raks {

/// The known name nearest to `name` (edit distance, letter case ignored), or empty when none is
/// near enough to be meant (more than a third of its letters differ).
[[nodiscard]] std::string_view nearest_name(std::string_view name,
                                            std::span<const std::string_view> known);

/// Ends an error about an unknown name: `; did you mean "stage"?`, or `; known: a, b, c` when none
/// is near.
[[nodiscard]] std::string suggestion(std::string_view name,
                                     std::span<const std::string_view> known);

/// The one line for a name that is not in a table: `theme "stge" is unknown; did you mean "stage"?`
/// (long names are cut). `what`: the kind of thing.
[[nodiscard]] std::string unknown_name(std::string_view what,
                                       std::string_view name,
                                       std::span<const std::string_view> known);

}  // namespace raks
