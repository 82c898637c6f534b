// Motion format: what kind of motion file some bytes are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raks::motion {

/// The kinds of files that motion comes in.
enum class MotionFormat : std::uint8_t {
    bvh,        ///< Biovision hierarchy
    amc,        ///< Acclaim motion, which needs an ASF beside it
    asf,        ///< Acclaim skeleton: holds no motion
    c3d,        ///< points
    trc,        ///< points, as text
    csv,        ///< points, as a table
    smpl_npz,   ///< SMPL parameters as NumPy arrays
    smpl_json,  ///< SMPL parameters as JSON
    vmd,        ///< MikuMikuDance's motion
    vpd,        ///< MikuMikuDance's pose
    model,      ///< glTF, GLB, VRM, VRMA, FBX or Collada
};

/// The formats with their file endings, for a message.
inline constexpr std::string_view kKnownMotionFormats =
    "BVH, ASF/AMC, glTF, GLB, VRMA, FBX, Collada, VMD, VPD, SMPL (.npz, .json), C3D, TRC, CSV";

/// How many bytes of a file's start tell its format.
inline constexpr std::size_t kMotionFormatBytes = 65536;

/// The format that the first bytes of a file show (kMotionFormatBytes, or all that it has), or else
/// the ending of its name. None: neither shows one.
[[nodiscard]] std::optional<MotionFormat> motion_format(std::string_view start,
                                                        const std::filesystem::path& name);

/// The endings of all formats: ".bvh".
[[nodiscard]] std::vector<std::string_view> motion_endings();

/// Whether a name has the ending of a clip with a skeleton, so that a folder's clips can be told
/// from the tables that lie beside them.
[[nodiscard]] bool is_clip_name(const std::filesystem::path& name);

/// Why these first bytes are a file that will never be read, and what to do: pickles, USD, Git
/// LFS pointers, web pages, bare arrays, models of MikuMikuDance. Empty: nothing of that kind.
[[nodiscard]] std::string refusal_of(std::string_view start);

}  // namespace raks::motion
