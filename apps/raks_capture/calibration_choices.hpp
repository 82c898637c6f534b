// Calibration choices: what a person chose for `raks capture calibrate`, kept for the next time.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

namespace raks::apps {

/// Options that were given by hand; none: as usual. `calibration.toml` of a capture is such a file
/// (TOML), so that `raks capture run` calibrates again as a person did before:
///
///     format = "raks-calibration"
///     version = 1
///     every = 0.5            # seconds
///     coefficients = 8
///     floor = 95.0           # seconds
///     floor_picture = 12
///     clocks = "board.toml"
struct CalibrationChoices {
    std::optional<double> every;       ///< seconds between the pictures that are looked at
    std::optional<int> coefficients;   ///< of the distortion: 5 or 8
    std::optional<double> floor;       ///< seconds
    std::optional<int> floor_picture;  ///< by number; not with `floor`
    std::string clocks;                ///< of the calibration films; empty: none

    /// These, and for those that are not there the ones of before.
    [[nodiscard]] CalibrationChoices over(const CalibrationChoices& before) const;
    /// Nothing was chosen.
    [[nodiscard]] bool are_none() const { return *this == CalibrationChoices{}; }

    friend bool operator==(const CalibrationChoices&, const CalibrationChoices&) = default;
};

/// Reads such a file. Errors, one line with its number: not TOML, another format or version,
/// unknown keys, values out of range, floor by time and by number.
[[nodiscard]] Expected<CalibrationChoices> parse_calibration_choices(std::string_view text,
                                                                     const std::string& file);
/// The same as such a file, which reads back to the same values.
[[nodiscard]] std::string calibration_choices_text(const CalibrationChoices& choices);

}  // namespace raks::apps
