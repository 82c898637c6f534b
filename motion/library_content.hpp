#pragma once

#include "motion/dance/dance_content.hpp"
#include "motion/dance_library.hpp"

namespace raks::motion {

/// Of a library, for who dances it: the door shows none of it.
struct DanceLibrary::Content : DanceContent {};

}  // namespace raks::motion
