// What is done with capture.toml; apart from the other files of a capture, since a board's names
// are OpenCV's.
#include <cmath>
#include <string>

#include "apps/raks_capture/calibration_choices.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/sync_report.hpp"
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

bool read_capture_song(std::string_view text) {
    const auto song = apps::read_music(text, "x.toml");
    if (!song) {
        must_be_one_line(song.error().message);
        return false;
    }
    must(std::isfinite(song->song_time(0.0)) && std::isfinite(song->song_time(3600.0)));
    apps::SyncPlan plan;
    plan.music = "song.mp3";
    const std::string written = apps::music_text(*song, plan);
    const auto again = apps::read_music(written, "y.toml");
    must(again && apps::music_text(*again, plan) == written);
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
