// `raks capture run`: every step that is missing or older than what it is made from.
#include "base/toml_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/track_doubts.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"

namespace raks::apps {
namespace {

// A step as its command line.
ExitCode run_step(const CaptureStep& step, const Path& folder) {
    std::vector<std::string> words = {step.command, folder.string()};
    words.insert(words.end(), step.arguments.begin(), step.arguments.end());
    return run_command_line(std::move(words));
}

const char* words_of(StepState state) {
    switch (state) {
        case StepState::missing:
            return "missing";
        case StepState::outdated:
            return "something that it is made from has changed";
        case StepState::up_to_date:
            return "up to date";
        case StepState::given:
            return "kept as it is: there is nothing to make it from";
    }
    return "";
}

// The second of the song at which the dance begins, by music.toml, which `sync` writes; nothing:
// no song was found.
Expected<std::optional<double>> song_offset(const CapturePlan& plan) {
    constexpr std::size_t kMostSongBytes = std::size_t{1} << 20U;
    const Path file = plan.file("music.toml");
    if (plan.music.empty() || !is_there(file) || !is_there(plan.file("tracks.csv"))) {
        return std::optional<double>();
    }
    const auto text = read_text_file(file, kMostSongBytes);
    const auto root = text ? parse_toml(*text, file.string()) : fail(text.error());
    const auto tracks = load_tracks(plan.folder);
    if (!root || !tracks) {
        return fail(root ? tracks.error() : root.error());
    }
    const auto begins = (*root)["begins"].value<double>();
    const double drift = (*root)["drift_ppm"].value_or(0.0);
    return begins ? std::optional((tracks->first_time - *begins) / (1.0 + drift * 1e-6)) : begins;
}

// A word of a command line that a shell takes as one.
std::string shell_word(const std::string& word) {
    constexpr std::string_view kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./,:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
        return word;
    }
    std::string quoted = "'";
    for (const char c : word) {
        quoted += c == '\'' ? "'\\''" : std::string(1, c);
    }
    return quoted + "'";
}

// Ends with the line that learns the dance, or says why there is none.
ExitCode say_what_is_next(const CapturePlan& plan) {
    if (is_there(plan.file("tracks.csv"))) {
        const auto tracks = load_tracks(plan.folder);
        if (!tracks) {
            return fail(tracks.error());
        }
        if (const std::string too_much = too_much_lost(*tracks); !too_much.empty()) {
            say(too_much);
            return kExitPartly;
        }
    }
    const auto offset = song_offset(plan);
    if (!offset) {
        return fail(offset.error());
    }
    std::string line = "raks train figure " + shell_word(plan.file("dance.bvh").string());
    if (*offset) {
        line += fmt::format(
            " --music {} --offset {:.4f}", shell_word(plan.file(plan.music).string()), **offset);
    }
    print_text(line + " -o mine\n");
    return kExitDone;
}

}  // namespace

ExitCode run_capture(const RunArguments& arguments) {
    const auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    if (auto checked = check_cameras(*plan); !checked) {
        return fail(std::move(checked.error()));
    }
    int exit_code = kExitDone;
    for (const CaptureStep& step : capture_steps(*plan)) {
        const StepState state = state_of(step);
        // Paths among the arguments are known.
        const bool has_flag = step.arguments.size() == 1;
        say(fmt::format("{}{}: {}",
                        step.command,
                        has_flag ? " " + step.arguments.front() : "",
                        words_of(state)));
        if (state == StepState::up_to_date || state == StepState::given) {
            continue;
        }
        ExitCode ended = run_step(step, plan->folder);
        if (!ended || stop_signal()) {
            return ended ? ExitCode(exit_code_after_signals(*ended)) : ended;
        }
        if (*ended != kExitDone && *ended != kExitPartly) {
            return ended;
        }
        exit_code = std::max(exit_code, *ended);
    }
    if (is_there(plan->file("dance.bvh"))) {
        ExitCode said = say_what_is_next(*plan);
        if (!said) {
            return said;
        }
        exit_code = std::max(exit_code, *said);
    }
    return exit_code;
}

}  // namespace raks::apps
