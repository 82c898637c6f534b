#include "apps/raks_capture/calibration_choices.hpp"

#include <fmt/format.h>

#include <array>

#include "base/toml_reader.hpp"

namespace raks::apps {
namespace {

constexpr std::string_view kChoicesFormat = "raks-calibration";
constexpr NumberRange kBetweenPictures{0.01, 60.0};  // seconds
constexpr NumberRange kFloorTime{0.0, 86400.0};      // seconds
constexpr NumberRange kFloorPicture{0.0, 1e6};

}  // namespace

CalibrationChoices CalibrationChoices::over(const CalibrationChoices& before) const {
    CalibrationChoices all = *this;
    all.every = every ? every : before.every;
    all.coefficients = coefficients ? coefficients : before.coefficients;
    if (!floor && !floor_picture) {
        all.floor = before.floor;
        all.floor_picture = before.floor_picture;
    }
    all.clocks = clocks.empty() ? before.clocks : clocks;
    return all;
}

Expected<CalibrationChoices> parse_calibration_choices(std::string_view text,
                                                       const std::string& file) {
    const Expected<toml::table> root = parse_toml(text, file);
    if (!root) {
        return fail(root.error());
    }
    constexpr std::array<std::string_view, 7> kKeys = {
        "format", "version", "every", "coefficients", "floor", "floor_picture", "clocks"};
    TomlComplaints complaints(file);
    complaints.check_keys(*root, kKeys);
    complaints.check_head(*root, kChoicesFormat, 1);
    CalibrationChoices choices;
    if (const toml::node* const every = root->get("every")) {
        choices.every = complaints.number(*every, "every", kBetweenPictures);
    }
    if (const toml::node* const count = root->get("coefficients")) {
        choices.coefficients = complaints.whole(*count, "coefficients", {5, 8});
        if (*choices.coefficients != 5 && *choices.coefficients != 8) {
            complaints.complain(*count, "coefficients must be 5 or 8");
        }
    }
    if (const toml::node* const floor = root->get("floor")) {
        choices.floor = complaints.number(*floor, "floor", kFloorTime);
    }
    if (const toml::node* const picture = root->get("floor_picture")) {
        choices.floor_picture = complaints.whole(*picture, "floor_picture", kFloorPicture);
        if (choices.floor) {
            complaints.complain(*picture, "floor_picture says what floor says: leave one");
        }
    }
    choices.clocks = complaints.text(*root, "clocks");
    if (!complaints.is_sound()) {
        return fail(complaints.fault());
    }
    return choices;
}

std::string calibration_choices_text(const CalibrationChoices& choices) {
    std::string text = fmt::format("format = \"{}\"\nversion = 1\n", kChoicesFormat);
    const auto add_number = [&text](const char* key, const std::optional<double>& value) {
        if (value) {
            // Never minus nought, nor a whole number, which TOML keeps apart.
            const std::string word = fmt::format("{}", *value + 0.0);
            text += fmt::format("{} = {}{}\n",
                                key,
                                word,
                                word.find_first_of(".e") == std::string::npos ? ".0" : "");
        }
    };
    add_number("every", choices.every);
    if (choices.coefficients) {
        text += fmt::format("coefficients = {}\n", *choices.coefficients);
    }
    add_number("floor", choices.floor);
    if (choices.floor_picture) {
        text += fmt::format("floor_picture = {}\n", *choices.floor_picture);
    }
    if (!choices.clocks.empty()) {
        text += fmt::format("clocks = {}\n", toml_quoted(choices.clocks));
    }
    return text;
}

}  // namespace raks::apps
