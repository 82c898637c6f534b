#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/io/ffmpeg_handles.hpp"
#include "base/expected.hpp"
#include "engine/decode/orientation.hpp"

struct SwsContext;

namespace raks::engine {

/// Makes RGB of decoded pictures. Colour halved in width and height (4:2:0) is interpolated between
/// the places where the codec took it: repeated pixels would move a marker by a quarter of a pixel.
/// Matrix and range are the film's; where it names none, BT.709 from 720 lines on, else BT.601.
/// Threads: one. Real-time: no.
class PictureConverter {
 public:
    PictureConverter();
    ~PictureConverter();
    PictureConverter(const PictureConverter&) = delete;             ///< one owner
    PictureConverter& operator=(const PictureConverter&) = delete;  ///< likewise

    /// Width x height x 3 bytes, top row first, as it is to be seen; valid until the next call.
    /// Errors: pixels that FFmpeg cannot convert; no memory.
    [[nodiscard]] Expected<std::span<const std::uint8_t>> to_rgb(const AVFrame& frame,
                                                                 Orientation orientation);

 private:
    [[nodiscard]] Expected<void> prepare(const AVFrame& frame);

    SwsContext* context_ = nullptr;
    std::vector<std::uint8_t> stored_;  // as the film has it
    std::vector<std::uint8_t> seen_;
    int width_ = 0;  // of the stored pictures, for which context_ is
    int height_ = 0;
    int format_ = -1;
};

}  // namespace raks::engine
