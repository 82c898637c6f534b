#pragma once

#include <string>
#include <string_view>

namespace raks::render {

/// "1:05", "1:02:03"; negative and unknown times are "0:00". Independent of the locale.
[[nodiscard]] std::string clock_text(double seconds);

/// One line of clean text: control characters become spaces.
[[nodiscard]] std::string one_line(std::string_view text);

/// A name for people: "cross_body_lead" -> "Cross body lead" (ASCII).
[[nodiscard]] std::string capitalized(std::string_view word);

/// Where a level lies on a meter from -60 dBFS to 0 dBFS, [0, 1]. NaN is 0.
[[nodiscard]] float meter_fraction(float dbfs) noexcept;

}  // namespace raks::render
