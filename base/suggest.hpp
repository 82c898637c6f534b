#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raks {

/// The known name with the smallest edit distance to `name` (letter case ignored); empty when none
/// is close: more than a third of the letters, plus one, differ.
[[nodiscard]] std::string_view nearest_name(std::string_view name,
                                            std::span<const std::string_view> known);

/// End of an error message about an unknown name: `; did you mean "stage"?`, or `; known: a, b, c`
/// when no name is close.
[[nodiscard]] std::string suggestion(std::string_view name,
                                     std::span<const std::string_view> known);

/// Error message for a name that is not in a table: `theme "stge" is unknown; did you mean
/// "stage"?` Long names are cut. `what`: the kind of thing.
[[nodiscard]] std::string unknown_name(std::string_view what,
                                       std::string_view name,
                                       std::span<const std::string_view> known);

}  // namespace raks
