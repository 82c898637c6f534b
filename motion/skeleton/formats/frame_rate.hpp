#pragma once

#include <string>
#include <string_view>

namespace raks::motion {

/// The rate that a written frame time means.
struct WrittenRate {
    double frames_per_second = 0.0;  ///< > 0
    std::string warning;             ///< one line where the digits leave it open; else empty
};

/// Frames a second of a frame time as a file writes it, `seconds` > 0 its value: the known rate (24
/// to 240, those of television with them: 23.976, 29.97, 59.94, 119.88) whose frame time these
/// digits are, rounded or cut off: 0.0333 is 30, 0.033367 is 29.97, 0.008333 is 120, 0.04166 is 24.
/// Else 1 / seconds. Real-time: no.
[[nodiscard]] WrittenRate rate_of_frame_time(std::string_view digits, double seconds);

}  // namespace raks::motion
