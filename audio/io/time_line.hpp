#pragma once

#include <cstdint>
#include <limits>

extern "C" {
#include <libavutil/rational.h>
}

namespace raks::audio {

/// What a TimeLine goes by; all lengths in audio frames.
struct TimeLineRules {
    AVRational unit{1, 1000};  ///< seconds of a time stamp's unit
    int rate = 48'000;         ///< audio frames a second
    /// Do time stamps come from the file, so that a jump means something? Else they are taken as
    /// they are.
    bool are_from_file = false;
    /// Are smaller jumps than least_jump no places at all? Then each frame is placed right behind
    /// the one before.
    bool is_jitter_left_out = false;
    std::int64_t least_jump = 960;           ///< smaller ones are jitter and rounding
    std::int64_t longest_gap = 172'800'000;  ///< longer ones are wrong time stamps
    std::int64_t longest_overlap = 48'000;   ///< more means that the time stamps begin anew
};

/// Places of codec frames in a file, from their time stamps: what continues, where sound is
/// missing, where it comes twice. Threads: one. Real-time: no.
class TimeLine {
 public:
    /// What a frame is to the one before.
    enum class Step : std::uint8_t {
        goes_on,  ///< or the first
        gap,      ///< sound before it is missing
        overlap,  ///< its start is at a time that has been there already
        restart,  ///< time stamps begin anew; it continues
    };
    /// A frame's place.
    struct Place {
        std::int64_t position = 0;  ///< audio frames from the origin; may be negative
        Step step = Step::goes_on;
    };

    /// Position 0 is at the time stamp `origin`.
    void prepare(const TimeLineRules& rules, std::int64_t origin) noexcept;
    /// As right after prepare(), with what set_grid() said.
    void rewind() noexcept;
    /// The next frame may come from anywhere, as after a seek.
    void forget_previous() noexcept { has_previous_ = false; }

    /// Codec frames have `size` audio frames and begin at `start` and whole sizes after it. By this
    /// coarse time stamps (Matroska's are whole milliseconds) become exact.
    void set_grid(std::int64_t start, std::int64_t size) noexcept;

    /// Place of the frame with this time stamp and number of audio frames that follows the last.
    Place place(std::int64_t stamp, std::int64_t frames) noexcept;
    /// Counts a frame without a time stamp.
    void pass(std::int64_t frames) noexcept { expected_ += frames; }

    /// Audio frames of a span in time stamps, and back, to the nearest.
    [[nodiscard]] std::int64_t frames_of(std::int64_t stamps) const noexcept;
    /// The time stamp of a position, as long as none began anew.
    [[nodiscard]] std::int64_t stamp_of(std::int64_t position) const noexcept;
    /// Does a time stamp's unit last longer than an audio frame?
    [[nodiscard]] bool is_coarse() const noexcept;

 private:
    [[nodiscard]] std::int64_t on_grid(std::int64_t position) const noexcept;

    TimeLineRules rules_;
    std::int64_t origin_ = 0;
    std::int64_t shift_ = 0;     // added since time stamps began anew
    std::int64_t expected_ = 0;  // end of the last frame by its time stamp
    bool has_previous_ = false;
    std::int64_t first_grid_ = 0;  // as set_grid() said
    std::int64_t grid_ = 0;        // as it is since the last gap
    std::int64_t grid_size_ = 0;   // 0: none known
};

}  // namespace raks::audio
