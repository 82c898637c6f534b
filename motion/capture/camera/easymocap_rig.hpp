// Rigs of EasyMocap: two files of OpenCV's YAML, intri.yml with the lenses and extri.yml with the
// places.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/capture/camera/rig_file.hpp"

/// The format: `names` in both, a list; in intri.yml for each name n `K_n` (3 x 3), `dist_n` (4, 5
/// or 8 numbers), `W_n` and `H_n` (size of the picture; without them the principal point is taken
/// as its middle); in extri.yml `R_n` (Rodrigues' vector) or `Rot_n` (3 x 3), and `T_n`: camera
/// from world, metres. Numbers have six decimals there. Threads: any. Real-time: no.
namespace raks::capture {

/// One of the two files as a text, and its name for messages.
struct NamedText {
    std::string_view text;
    std::string name;
};

/// Reads a rig from both texts. Errors, with file and line: those of OpenCV's YAML; a camera of the
/// lenses without a place; more than 1,000 cameras; what check_rig refuses.
[[nodiscard]] Expected<RigFile> parse_easymocap_rig(const NamedText& lenses,
                                                    const NamedText& places,
                                                    const RigReading& reading = {});

/// The same from one of the files, whose text is `text`, and the one beside it. Errors: also where
/// that is not there.
[[nodiscard]] Expected<RigFile> read_easymocap_rig(const std::filesystem::path& path,
                                                   std::string_view text,
                                                   const RigReading& reading = {});

}  // namespace raks::capture
