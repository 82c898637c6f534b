#pragma once

#include <cstdint>
#include <vector>

#include "audio/io/file_window.hpp"

namespace raks::audio {

/// How long a FLAC file (not in Ogg) is by its last frame, beside what its head says. FLAC frames
/// carry their own place, so the head's total can be checked from the file's last bytes.
struct FlacLength {
    std::int64_t claimed = 0;  ///< audio frames, as the head says; 0: it does not say
    /// Audio frames up to the end of the last FLAC frame that begins in the file; 0: none was found
    /// (not FLAC, or damaged at its end).
    std::int64_t found = 0;
    /// Starts of FLAC files that lie one behind the other in this one (`cat a.flac b.flac`), the
    /// first of them 0.
    std::vector<std::int64_t> starts{0};
    FileWindow window;  ///< with a head that says `found` where the head said less, or nothing
};

/// Reads head and last frame, and the file once for further starts. Never fails. Threads: any.
/// Real-time: no.
[[nodiscard]] FlacLength read_flac_length(const FileWindow& file);

}  // namespace raks::audio
