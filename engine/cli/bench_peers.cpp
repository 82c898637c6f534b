#include "engine/cli/bench_peers.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <system_error>

#include "audio/io/audio_file.hpp"

#include <fmt/format.h>

extern char** environ;

namespace raks::cli {

TemporaryMusic::TemporaryMusic(const audio::GeneratedMusic& music)
    : path_(std::filesystem::temp_directory_path() /
            fmt::format("raks-bench-{}.wav", HostClock::now().time_since_epoch().count())),
      written_(audio::write_wav(path_, music.samples, music.channels, music.rate)) {}

TemporaryMusic::~TemporaryMusic() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

Expected<double> cpu_seconds_of(const std::vector<std::string>& command) {
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;  // NOLINT: filled below
    posix_spawn_file_actions_init(&actions);
    for (const int output : {1, 2}) {
        posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
    }
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) {
        return fail(fmt::format("{} is not installed", command.front()));
    }
    int status = 0;
    rusage used{};
    if (wait4(child, &status, 0, &used) != child || !WIFEXITED(status) ||
        WEXITSTATUS(status) != 0) {
        return fail(fmt::format("{} failed", command.front()));
    }
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void add_aubio(const audio::GeneratedMusic& music, double seconds, BenchReport& report) {
    const TemporaryMusic file(music);
    const auto cpu = file.written() ? cpu_seconds_of({"aubiotrack", "-i", file.path().string()})
                                    : fail(file.written().error());
    if (!cpu) {
        report.notes.emplace_back("aubio", "not measured: " + cpu.error().message);
        return;
    }
    report.notes.emplace_back("aubio", "aubiotrack, beats alone, its start and reading included");
    report.values.emplace_back("aubio_times_real_time", seconds / *cpu);
}

}  // namespace raks::cli
