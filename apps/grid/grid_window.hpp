// Grid window: the beats of a take, set right.
#pragma once

#include <functional>

#include "apps/grid/read_take.hpp"
#include "base/expected.hpp"
#include "engine/show/picture.hpp"

namespace raks::apps {

/// Opens a window in which the beats are set right, and saved as often as the person says so.
/// Returns when it is closed, or `is_stop_requested`, asked many times a second, says so. Errors:
/// no display, no OpenGL. Threads: main.
[[nodiscard]] Expected<void> edit_in_window(EditedTake take,
                                            const engine::Look& look,
                                            const std::function<bool()>& is_stop_requested);

}  // namespace raks::apps
