#pragma once

#include <string>
#include <vector>

namespace raks::test {

/// Drops files on a window of the display in DISPLAY, as a file manager does (XDND 5): enters,
/// moves over it, lets go, and hands out the list of files. `window_id`: as xdotool says it. Blocks
/// until the window has taken them, so where this process serves the window, it is called on a
/// thread of its own. Throws std::runtime_error where the window takes nothing within 20 s.
void drop_files(const std::string& window_id, const std::vector<std::string>& paths);

}  // namespace raks::test
