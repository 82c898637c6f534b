#pragma once

#include <cstdint>

#include "audio/io/file_window.hpp"

namespace raks::audio {

/// How many bytes a container of sound and film says it has, beside how many there are.
struct ContainerExtent {
    bool is_known = false;           ///< it says how many
    std::int64_t missing_bytes = 0;  ///< > 0: the file was cut off
    /// MP4 and QuickTime: the index (the box "moov") is missing or incomplete, without which
    /// nothing in them can be found.
    bool lacks_index = false;
};

/// Of MP4 and QuickTime (their boxes), Matroska and WebM (the segment), AVI (RIFF). Never fails: of
/// all else nothing is known. Threads: any. Real-time: no.
[[nodiscard]] ContainerExtent read_container_extent(const FileWindow& file);

}  // namespace raks::audio
