// `raks capture run`: every step that is missing or older than what it is made from.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/dances/tracked_counts.hpp"
#include "apps/raks_capture/capture_commands.hpp"
#include "apps/raks_capture/capture_files.hpp"
#include "apps/raks_capture/capture_plan.hpp"
#include "apps/raks_capture/capture_steps.hpp"
#include "apps/raks_capture/learning_line.hpp"
#include "apps/raks_capture/sync_report.hpp"
#include "apps/raks_capture/track_doubts.hpp"
#include "apps/terminal/say.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"

namespace raks::apps {
namespace {

constexpr std::string_view kFilmEndings = ".mp4, .mov, .mkv, .webm, .avi, .m4v";

bool is_film(const Path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    constexpr std::array<std::string_view, 6> kEndings = {
        ".mp4", ".mov", ".mkv", ".webm", ".avi", ".m4v"};
    return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

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
    const auto song = text ? read_music(*text, file.string()) : fail(text.error());
    const auto tracks = load_tracks(plan.folder);
    if (!song || !tracks) {
        return fail(song ? tracks.error() : song.error());
    }
    return std::optional(song->song_time(tracks->first_time));
}

// The song with its beats; nothing: none was heard.
Expected<std::optional<FilmedSong>> danced_song(const CapturePlan& plan) {
    const auto offset = song_offset(plan);
    if (!offset) {
        return fail(offset.error());
    }
    if (!*offset) {
        return std::optional<FilmedSong>();
    }
    FilmedSong song;
    song.file = plan.file(plan.music);
    auto counts = track_counts(song.file);
    if (!counts) {
        return fail(std::move(counts.error()));
    }
    song.music = std::move(counts->music);
    song.music.offset = **offset;
    return std::optional(std::move(song));
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
    const auto song = danced_song(plan);
    if (!song) {
        return fail(song.error());
    }
    const Path clip = plan.file("dance.bvh");
    const Learnable what = what_can_be_learnt(
        clip, *song ? std::optional((*song)->music) : std::optional<motion::DancedMusic>());
    print_text(learning_line(clip, *song, what) + "\n");
    return kExitDone;
}

// A folder of films without capture.toml becomes a capture of as many cameras.
Expected<void> begin_markerless(const RunArguments& arguments) {
    const Path folder = arguments.folder;
    const Path file = folder / "capture.toml";
    std::error_code problem;
    if (!arguments.is_markerless || is_there(file)) {
        if (arguments.height > 0.0 || !arguments.music.empty()) {
            say(file.string() + ": is there; height and music are those that it says");
        }
        return {};
    }
    CapturePlan plan;
    plan.folder = folder;
    plan.is_markerless = true;
    plan.height = arguments.height;
    plan.music = arguments.music.empty() ? Path() : std::filesystem::absolute(arguments.music);
    std::vector<Path> films;
    for (const auto& entry : std::filesystem::directory_iterator(folder, problem)) {
        if (is_film(entry.path())) {
            films.push_back(entry.path().filename());
        }
    }
    std::sort(films.begin(), films.end());
    for (const Path& film : films) {
        PlannedCamera camera;
        camera.name = film.stem().string();
        camera.film = film;
        plan.cameras.push_back(std::move(camera));
    }
    if (plan.cameras.size() < 2) {
        return fail(fmt::format(
            "{}: has {} films ({}); two are needed, of one dance at the same time, from 70 to 100 "
            "degrees apart",
            folder.string(),
            plan.cameras.size(),
            kFilmEndings));
    }
    // What a camera may not be called, the reader says.
    const std::string text = capture_plan_text(plan);
    if (auto read = parse_capture_plan(text, file.string(), folder); !read) {
        return fail(std::move(read.error()));
    }
    say(fmt::format("{}: written, for {} films", file.string(), plan.cameras.size()));
    return write_file(file, text);
}

}  // namespace

ExitCode run_capture(const RunArguments& arguments) {
    if (auto begun = begin_markerless(arguments); !begun) {
        return fail(std::move(begun.error()));
    }
    auto plan = load_capture_plan(arguments.folder);
    if (!plan) {
        return fail(plan.error());
    }
    plan->is_markerless = plan->is_markerless || arguments.is_markerless;
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
        const bool is_done = state == StepState::up_to_date || state == StepState::given;
        if (is_done && step.command != "keypoints") {
            continue;
        }
        // Joints that were found are no dance yet: whether they are is said each time.
        ExitCode ended =
            is_done ? judge_kept_keypoints(arguments.folder) : run_step(step, plan->folder);
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
