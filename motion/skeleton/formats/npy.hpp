// NPY: arrays of numbers as NumPy's save writes them.
#pragma once

#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/formats/number_array.hpp"

namespace raks::motion {

/// Reads an .npy, versions 1 to 3 (NumPy, "numpy.lib.format"): floats of 16, 32 or 64 bits, whole
/// numbers of 8 to 64, truth values; either byte order; C and Fortran order. Memory follows the
/// bytes that are there, never what the head declares. Errors, without a file's name: no .npy, an
/// array of other things (objects are pickles, which are programs and are not run), a shape that is
/// not there. Threads: any. Real-time: no.
[[nodiscard]] Expected<NumberArray> parse_npy(std::string_view bytes);

}  // namespace raks::motion
