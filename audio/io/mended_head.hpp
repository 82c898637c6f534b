#pragma once

#include <optional>

#include "audio/io/file_window.hpp"

namespace raks::audio {

/// A file of uncompressed or simply compressed sound (WAV, RF64, W64, AIFF, AU, CAF) as a decoder
/// should get it: with a head whose lengths agree with the bytes that are there.
struct MendedHead {
    FileWindow window;  ///< the file itself where nothing had to be mended
    /// The head gave no length, as recorders leave it that could not come back to it, and as pipes
    /// write it: 0, all bits set or a number near 2 or 4 GiB. All to the end of the file is sound.
    bool has_no_length = false;
    /// Seconds of sound that the head promises and the file has not: it was cut off.
    double missing_seconds = 0.0;
    /// Whether the file is of one of these kinds and has as many bytes as its head says.
    bool is_complete = false;
};

/// Reads the lengths in a head and mends them where they are wrong. Never fails: what it does not
/// understand it leaves as it is. Threads: any. Real-time: no.
[[nodiscard]] MendedHead mend_head(const FileWindow& file);

}  // namespace raks::audio
