// JSON arrays: the arrays of numbers that a JSON object has as members.
#pragma once

#include <span>
#include <string_view>

#include "base/expected.hpp"
#include "motion/skeleton/formats/npz.hpp"

namespace raks::motion {

/// Reads the members of these names of the object that the text is: numbers, and arrays of numbers,
/// nested so evenly that they have a shape. Other members are passed over. NaN is no JSON; `null`
/// in an array is read as NaN. Memory: 8 bytes a number. Errors, without a file's name: no JSON
/// (with its place), no object, an array that is not even or holds other things. Threads: any.
/// Real-time: no.
[[nodiscard]] Expected<NpzContent> read_json_arrays(std::string_view text,
                                                    std::span<const std::string_view> names);

}  // namespace raks::motion
