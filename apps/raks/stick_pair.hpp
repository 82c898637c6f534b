// `raks stick ONE OTHER`: two motions compared point by point, and shown together.
#pragma once

#include "apps/raks/commands.hpp"
#include "motion/skeleton/formats/motion_file.hpp"

namespace raks::apps {

/// Compares two motions that were read, prints how far they are apart, and shows them. Errors: no
/// point in common, nothing to align by, and those of showing.
[[nodiscard]] ExitCode stick_pair(const StickArguments& arguments,
                                  motion::MotionFile one,
                                  motion::MotionFile other);

}  // namespace raks::apps
