// Writers of motion formats, for tests that know what their readers must give back.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "motion/skeleton/formats/c3d_parameters.hpp"
#include "motion/skeleton/formats/number_array.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/point_clip.hpp"

namespace raks::test {

/// How an .npy writes its numbers.
struct NpyForm {
    std::string type = "<f8";  ///< <f2, <f4, >f4, <f8, >f8, <i4, |u1
    bool is_fortran = false;   ///< the first index runs fastest
};
/// An array as NumPy's save writes it; numbers must fit the type.
[[nodiscard]] std::string npy_bytes(const motion::NumberArray& array, const NpyForm& form = {});

/// Files in a ZIP archive: stored or deflated.
enum class Packing : std::uint8_t { stored, deflated };
[[nodiscard]] std::string zip_bytes(const std::vector<std::pair<std::string, std::string>>& files,
                                    Packing packing = Packing::stored);

/// Arrays as NumPy's savez writes them.
[[nodiscard]] std::string npz_bytes(const motion::NumberArrays& arrays,
                                    Packing packing = Packing::stored);

/// A clip in VRM's names, resting in a T-pose, in metres (as `raks dance -o X.bvh` writes it), as
/// arrays of SMPL: poses, trans and mocap_framerate. Each joint turns in the world as its bone
/// does; bones that SMPL does not have are left out, and the way is scaled by the ratio of the
/// hips' heights.
[[nodiscard]] motion::NumberArrays smpl_arrays(const motion::MotionClip& clip);

/// Such arrays as JSON text.
[[nodiscard]] std::string json_text(const motion::NumberArrays& arrays);

/// How a C3D keeps its numbers.
struct C3dForm {
    motion::C3dProcessor processor = motion::C3dProcessor::intel;
    bool is_float = true;      ///< else whole numbers times `scale`
    double scale = 0.25;       ///< of whole numbers
    std::size_t analogue = 0;  ///< other numbers after the points of each frame
    std::string up = "+Z";     ///< POINT:Y_SCREEN
    std::string unit = "mm";   ///< POINT:UNITS
};
/// Points as a C3D; NaN as not seen.
[[nodiscard]] std::string c3d_bytes(const motion::PointClip& clip, const C3dForm& form = {});

}  // namespace raks::test
