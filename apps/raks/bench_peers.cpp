#include "apps/raks/bench.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <limits>
#include <span>
#include <system_error>

#include "audio/features/mfcc.hpp"
#include "audio/io/wav_writer.hpp"
#include "audio/resample/resampler.hpp"
#include "base/file.hpp"

#include <fmt/format.h>

extern char** environ;

namespace raks::apps {

// The time in the name keeps two runs apart.
TemporaryMusic::TemporaryMusic(const audio::GeneratedMusic& music)
    : path_(temporary_folder() /
            fmt::format("raks-bench-{}.wav", HostClock::now().time_since_epoch().count())),
      written_(audio::write_wav(path_, music.samples, music.channels, music.rate)) {}

TemporaryMusic::~TemporaryMusic() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
}

// posix_spawn instead of a shell: arguments need no quoting, and the child's own usage is known.
Expected<double> cpu_seconds_of(const std::vector<std::string>& command) {
    // argv must be writable and end in a null pointer.
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) {
        arguments.push_back(word.data());
    }
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;  // NOLINT: filled below
    posix_spawn_file_actions_init(&actions);
    // Standard output and error.
    for (const int output : {1, 2}) {
        posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
    }
    pid_t child = 0;
    const int error =
        posix_spawnp(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    // spawnp fails when no such program is found in PATH.
    if (error != 0) {
        return fail(fmt::format("{} is not installed", command.front()));
    }
    int status = 0;
    rusage used{};
    // wait4 also gives the processor time of exactly this child.
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
    // Its start and reading are included: the program cannot be measured otherwise.
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

namespace {

// The music at 16 kHz mono, as both programs read it.
Expected<audio::GeneratedMusic> at_16_khz(const audio::GeneratedMusic& music) {
    audio::GeneratedMusic low;
    low.rate = SampleRate(audio::MfccStream::kSampleRate);
    low.channels = 1;
    audio::Resampler resampler;
    if (auto prepared = resampler.prepare(music.rate, low.rate); !prepared) {
        return fail(prepared.error());
    }
    const std::vector<float> mono = music.mono();
    std::span<const float> left = mono;
    std::vector<float> made(4096);
    // The resampler takes and makes what it can; the rest goes into the next round.
    while (!left.empty()) {
        const auto progress = resampler.process(left, made);
        left = left.subspan(progress.taken);
        low.samples.insert(low.samples.end(),
                           made.begin(),
                           made.begin() + static_cast<std::ptrdiff_t>(progress.made));
    }
    return low;
}

// Counts the vectors and uses a value of each, so that the compiler cannot remove the computation.
class CountVectors final : public audio::MfccStream::Sink {
 public:
    void on_vector(const audio::MfccVector& vector) noexcept override {
        ++vectors;
        sum += static_cast<double>(vector[0]);
    }
    std::size_t vectors = 0;
    double sum = 0.0;
};

}  // namespace

Expected<void> add_mfcc(const audio::GeneratedMusic& music, double seconds, BenchReport& report) {
    auto low = at_16_khz(music);
    if (!low) {
        return fail(low.error());
    }
    const TemporaryMusic file(*low);
    // The features are defined for samples of 16 bits.
    std::vector<float> scaled(low->samples.size());
    std::transform(low->samples.begin(), low->samples.end(), scaled.begin(), [](float sample) {
        return sample * 32768.0F;
    });
    // The quickest round counts: other programs share the machine.
    constexpr int kRounds = 5;
    double best = std::numeric_limits<double>::infinity();
    CountVectors count;
    for (int round = 0; round < kRounds; ++round) {
        audio::MfccStream stream;
        const double start = thread_cpu_seconds();
        stream.process(scaled, count);
        best = std::min(best, thread_cpu_seconds() - start);
    }
    report.values.emplace_back("mfcc39_times_real_time", seconds / best);
    report.values.emplace_back("mfcc39_vectors", static_cast<double>(count.vectors / kRounds));
    double peer = std::numeric_limits<double>::infinity();
    // A window of 512 samples and a hop of 160, which is 10 ms.
    for (int round = 0; round < kRounds && file.written(); ++round) {
        const auto cpu =
            cpu_seconds_of({"aubiomfcc", "-i", file.path().string(), "-B", "512", "-H", "160"});
        if (!cpu) {
            report.notes.emplace_back("aubiomfcc", "not measured: " + cpu.error().message);
            return {};
        }
        peer = std::min(peer, *cpu);
    }
    report.notes.emplace_back("aubiomfcc",
                              "13 MFCC without derivatives; its start, reading and text included");
    report.values.emplace_back("aubiomfcc_times_real_time", seconds / peer);
    return {};
}

}  // namespace raks::apps
