// What is done with capture.toml; apart from the other files of a capture, since a board's names
// are OpenCV's.
#include "apps/raks_capture/calibration_choices.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {

bool read_capture_plan(std::string_view text) {
    const auto plan = apps::parse_capture_plan(text, "x.toml", "/nowhere");
    if (!plan) {
        must_be_one_line(plan.error().message);
        return false;
    }
    const std::string written = apps::capture_plan_text(*plan);
    const auto again = apps::parse_capture_plan(written, "y.toml", "/nowhere");
    must(again && apps::capture_plan_text(*again) == written);
    must(!apps::capture_steps(*plan).empty());
    return true;
}

bool read_calibration_choices(std::string_view text) {
    const auto choices = apps::parse_calibration_choices(text, "x.toml");
    if (!choices) {
        must_be_one_line(choices.error().message);
        return false;
    }
    const auto again =
        apps::parse_calibration_choices(apps::calibration_choices_text(*choices), "y.toml");
    must(again && *again == *choices);
    return true;
}

}  // namespace raks::fuzz
