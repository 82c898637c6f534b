// `raks stick --counts X.tsv --strips FOLDER`: pictures by which beats of takes are judged.
#pragma once

#include "apps/grid/read_take.hpp"
#include "apps/raks/sheet_file.hpp"
#include "base/expected.hpp"

namespace raks::apps {

/// Draws all beats of a take: FOLDER/TAKE.png, or pages FOLDER/TAKE_1.png, ... of 64 beats and
/// fewer; prints what was written. Errors: beats behind the end of the clip; those of drawing and
/// of the files.
[[nodiscard]] Expected<void> write_strips(const ReadTake& take,
                                          const motion::TakeGrid& grid,
                                          const Path& folder,
                                          SheetStudio& studio);

}  // namespace raks::apps
