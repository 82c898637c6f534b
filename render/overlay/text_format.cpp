#include "render/overlay/text_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace raks::render {

std::string clock_text(double seconds) {
    constexpr double kLongest = 100.0 * 3600.0;
    // The comparison is false for NaN, which gives 0; infinity is cut to 100 hours.
    const auto total = seconds > 0.0 ? static_cast<long>(std::min(seconds, kLongest)) : 0L;
    if (total >= 3600) {
        return fmt::format("{}:{:02}:{:02}", total / 3600, total / 60 % 60, total % 60);
    }
    return fmt::format("{}:{:02}", total / 60, total % 60);
}

std::string one_line(std::string_view text) {
    std::string line(text);
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < ' ' || c == 0x7F; }, ' ');
    return line;
}

std::string capitalized(std::string_view word) {
    std::string text(word);
    if (!text.empty() && text.front() >= 'a' && text.front() <= 'z') {
        text.front() = static_cast<char>(text.front() - 'a' + 'A');
    }
    std::replace(text.begin(), text.end(), '_', ' ');
    return text;
}

float meter_fraction(float dbfs) noexcept {
    constexpr float kFloorDb = -60.0F;
    return dbfs > kFloorDb ? std::min((dbfs - kFloorDb) / -kFloorDb, 1.0F) : 0.0F;
}

}  // namespace raks::render
