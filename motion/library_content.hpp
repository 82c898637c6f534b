// Library content: the inside of a DanceLibrary, for the dancer alone.
#pragma once

#include "motion/dance/dance_content.hpp"
#include "motion/dance_library.hpp"

namespace raks::motion {

/// What a dancer reads of a library; the public header keeps it opaque.
struct DanceLibrary::Content : DanceContent {};

}  // namespace raks::motion
