#include "motion/skeleton/formats/motion_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "motion/skeleton/formats/motion_limits.hpp"

namespace raks::motion {

std::size_t MotionText::line_number() const noexcept {
    if (lines_.empty()) {
        return 1;
    }
    return is_at_end() ? lines_.back().number : line().number;
}

tl::unexpected<Error> MotionText::fault(std::size_t line, const std::string& what) const {
    return fail(fmt::format("{}: line {}: {}", name_, line, what));
}
tl::unexpected<Error> MotionText::fault(const std::string& what) const {
    return fail(fmt::format("{}: {}", name_, what));
}

Expected<double> MotionText::number(std::string_view word, std::size_t line) const {
    if (!word.empty() && word.front() == '+') {  // from_chars knows no plus sign
        word.remove_prefix(1);
    }
    double value = 0.0;
    const auto result = std::from_chars(word.data(), word.data() + word.size(), value);
    if (result.ec == std::errc::result_out_of_range) {
        return fault(line, fmt::format("\"{}\" is out of range", word.substr(0, 40)));
    }
    if (word.empty() || result.ec != std::errc{} || result.ptr != word.data() + word.size()) {
        const bool is_comma = word.find(',') != std::string_view::npos;
        return fault(line,
                     fmt::format("\"{}\" is not a number{}",
                                 word.substr(0, 40),
                                 is_comma ? " (decimal comma? numbers have decimal points)" : ""));
    }
    if (!std::isfinite(value)) {
        return fault(line, fmt::format("\"{}\" is not finite", word));
    }
    if (std::abs(value) > kLargestMotionNumber) {
        return fault(line,
                     fmt::format("{} is out of range (above {:g})", value, kLargestMotionNumber));
    }
    return value;
}

Expected<std::string_view> MotionText::value_of(std::string_view key) {
    if (next_ >= lines_.size() || lower(lines_[next_].text.substr(0, key.size())) != key) {
        return fault(line_number(),
                     key == "frames" ? "Frames is missing" : "Frame Time is missing");
    }
    std::string_view value = trimmed(lines_[next_++].text.substr(key.size()));
    if (!value.empty() && value.front() == ':') {
        value = trimmed(value.substr(1));
    }
    return value;
}

}  // namespace raks::motion
