#include "motion/skeleton/formats/frame_rate.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <span>

#include <fmt/format.h>

namespace raks::motion {
namespace {

constexpr std::array kWholeRates = {24.0,
                                    25.0,
                                    30.0,
                                    40.0,
                                    48.0,
                                    50.0,
                                    60.0,
                                    72.0,
                                    75.0,
                                    80.0,
                                    90.0,
                                    96.0,
                                    100.0,
                                    120.0,
                                    144.0,
                                    150.0,
                                    180.0,
                                    200.0,
                                    240.0};
constexpr std::array kTelevisionRates = {
    24000.0 / 1001.0, 30000.0 / 1001.0, 60000.0 / 1001.0, 120000.0 / 1001.0};
constexpr double kSureDigits = 0.015;  // relative: digits that leave more open are said

/// The value of one unit of the last digit written; "1e-2" counts its exponent.
double last_digit(std::string_view digits) {
    const std::size_t exponent_at = std::min(digits.find_first_of("eE"), digits.size());
    const std::string_view mantissa = digits.substr(0, exponent_at);
    const std::size_t point = mantissa.find('.');
    int places = 0;
    if (point != std::string_view::npos) {
        places = static_cast<int>(mantissa.size() - point - 1);
    }
    int exponent = 0;
    if (exponent_at + 1 < digits.size()) {
        const std::string_view rest = digits.substr(exponent_at + 1);
        const std::size_t sign = rest.front() == '+' ? 1 : 0;
        std::from_chars(rest.data() + sign, rest.data() + rest.size(), exponent);
    }
    return std::pow(10.0, exponent - places);
}

/// Of the rates whose frame time the digits may stand for, the one nearest to them; 0: none.
/// `open`: one unit of the last digit. Rounded digits lie half a unit about the frame time, those
/// that are cut off up to one below it.
double nearest_rate(std::span<const double> rates, double seconds, double open) {
    double best = 0.0;
    double nearest = open;
    for (const double rate : rates) {
        const double off = 1.0 / rate - seconds;
        if (off >= -0.5 * open && off < open && std::abs(off) < nearest) {
            nearest = std::abs(off);
            best = rate;
        }
    }
    return best;
}

}  // namespace

WrittenRate rate_of_frame_time(std::string_view digits, double seconds) {
    // At least what computing with it loses.
    const double open = std::max(last_digit(digits), 1e-9 * seconds);
    // Digits that leave half of it open, such as "0.0", say nothing.
    const bool is_exact = std::abs(1.0 / seconds - std::round(1.0 / seconds)) < 1e-9 / seconds;
    if (open > 0.5 * seconds || is_exact) {
        return {1.0 / seconds, {}};
    }
    // Whole rates first: 0.0333 may be 30 and 29.97, and the former is meant.
    double best = nearest_rate(kWholeRates, seconds, open);
    if (best == 0.0) {
        best = nearest_rate(kTelevisionRates, seconds, open);
    }
    if (best == 0.0) {
        return {1.0 / seconds, {}};
    }
    WrittenRate written{best, {}};
    if (open > kSureDigits * seconds) {
        written.warning = fmt::format(
            "its frame time of {} s is rounded; taken for {:.6g} frames a "
            "second (--fps)",
            digits,
            best);
    }
    return written;
}

}  // namespace raks::motion
