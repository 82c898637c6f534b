#pragma once

#include <string_view>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/control/action_table.hpp"

namespace raks::engine {

/// Whether other programs may ask for it: all but the end of the program.
[[nodiscard]] bool is_remote(const ActionRow& row) noexcept;

/// What another program asks for, by the name of an action and its value as text: a number in the
/// row's unit, or what the row names; blanks around it do not count. `came`: the moment it means.
///
///     remote_request("nudge", "-10", now);  remote_request("dance", "salsa", now)
///
/// Errors: no such action, or one that only a person at the program may ask for; a number that is
/// missing or none; those of take_value and check_text; a value where the action takes none.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<ActionRequest> remote_request(std::string_view name,
                                                     std::string_view value,
                                                     HostTime came);

}  // namespace raks::engine
