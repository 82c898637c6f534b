#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "apps/raks/sheet_file.hpp"
#include "base/expected.hpp"
#include "motion/dance_library.hpp"

namespace raks::apps {

/// Draws a dance of cells as PNG: of each take a band of small figures, one at each beat, as the
/// take was danced. Under a beat that is a cell stand its energy as a bar, how many arcs leave as
/// it ends, and whether it comes to rest there; a beat that is none is dark. Several bands together
/// show so many beats at most that a person can look at them; returns the takes that are left out
/// for that, in words; empty: none. `take`: draws it alone; none: all. `name`: of the dance.
/// Errors: those of the drawing and of the file.
[[nodiscard]] Expected<std::string> write_cell_sheet(SheetStudio& studio,
                                                     const Path& output,
                                                     const motion::DanceLibrary& library,
                                                     std::optional<std::size_t> take,
                                                     const std::string& name);

}  // namespace raks::apps
