// NPZ: several named arrays in a ZIP archive, as NumPy's savez writes them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/formats/number_array.hpp"

namespace raks::motion {

/// What of an archive was read.
struct NpzContent {
    NumberArrays arrays;             ///< those that were asked for and are there
    std::vector<std::string> names;  ///< of all arrays in it, in the file's order
};

/// Reads the arrays of these names. At most 512 MiB are unpacked, all together. Errors, without a
/// file's name: those of zip_entries, unzipped and parse_npy, with the array's name.
/// Threads: any. Real-time: no.
[[nodiscard]] Expected<NpzContent> read_npz(std::string_view bytes,
                                            std::span<const std::string_view> names);

}  // namespace raks::motion
