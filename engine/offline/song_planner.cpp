#include "engine/offline/song_planner.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <thread>
#include <utility>

#include "engine/offline/music_source.hpp"
#include "engine/setup/dance_corrections.hpp"
#include "engine/setup/told_genre.hpp"

namespace raks::engine {
namespace {

// Of the worker: sound and pictures come first. On Linux each thread has its own.
constexpr int kNice = 10;
constexpr Nanos kLongest = std::chrono::hours(1);  // 180 MB of plan
// From then on the time that is left can be foretold.
constexpr Nanos kForetold = std::chrono::milliseconds(300);

}  // namespace

Expected<PlanOfSong> plan_song(const std::filesystem::path& file,
                               const AnalyzerModels& models,
                               const std::function<void(double)>& progress,
                               const std::function<bool()>& is_stopped) {
    auto source = MusicSource::open(file, 0.0, std::nullopt, is_stopped);
    if (!source) {
        // Who gave up waiting for the decoder did not find a fault.
        if (is_stopped && is_stopped()) {
            return PlanOfSong();
        }
        return fail(std::move(source.error()));
    }
    auto analyzer =
        make_song_analyzer(source->rate(), told(models, source->tags(), file), make_tagger(models));
    if (!analyzer) {
        return fail(std::move(analyzer.error()).in(file.string()));
    }
    for (auto block = source->next(); !block.mono.empty(); block = source->next()) {
        analyzer->process(block.mono);
        if (const auto share = source->progress(); share && progress) {
            progress(*share);
        }
        if (source->given() > kLongest || (is_stopped && is_stopped())) {
            return PlanOfSong();
        }
    }
    // One that was stopped while it waited for its decoder ends as a file does.
    if (is_stopped && is_stopped()) {
        return PlanOfSong();
    }
    return std::make_shared<const audio::SongPlan>(analyzer->finish());
}

// A file that is being planned, or was.
struct SongPlanner::Job {
    std::filesystem::path file;
    std::shared_ptr<const DanceCorrections> corrections;  // that it is planned by
    HostTime started = HostClock::now();
    // relaxed, both: a number to look at, and a wish; the future orders the plan.
    std::atomic<double> done{0.0};
    std::atomic<bool> is_stopped{false};
    std::future<PlanOfSong> plan_to_come;
    PlanOfSong plan;

    ~Job() {
        is_stopped.store(true, std::memory_order_relaxed);
        if (plan_to_come.valid()) {
            plan_to_come.wait();
        }
    }

    // When it will be ready at the pace so far.
    [[nodiscard]] std::optional<HostTime> expected(HostTime now) const {
        const Nanos spent = now - started;
        const double share = done.load(std::memory_order_relaxed);
        if (spent < kForetold || share <= 0.0) {
            return std::nullopt;
        }
        return started + nanos_from_seconds(to_seconds(spent) / share);
    }
};

SongPlanner::SongPlanner(AnalyzerModels models) : models_(std::move(models)) {}
SongPlanner::~SongPlanner() = default;

SongPlanner::Job* SongPlanner::job_of(const std::filesystem::path& file) {
    for (const auto& job : jobs_) {
        if (job && job->file == file) {
            return job.get();
        }
    }
    return nullptr;
}

void SongPlanner::prepare(const std::filesystem::path& file) {
    auto corrections = models_.corrections ? models_.corrections->now() : nullptr;
    Job* const known = job_of(file);
    if (known != nullptr && known->corrections == corrections) {
        return;
    }
    // What the person has said meanwhile may be of this song: it is planned anew, in its place.
    if (known == nullptr) {
        jobs_[1] = std::move(jobs_[0]);
    }
    auto& place = known != nullptr && jobs_[1].get() == known ? jobs_[1] : jobs_[0];
    place = std::make_unique<Job>();
    Job* const job = place.get();
    job->file = file;
    job->corrections = std::move(corrections);
    job->plan_to_come = std::async(std::launch::async, [job, models = models_] {
        setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
        auto plan = plan_song(
            job->file,
            models,
            [job](double share) { job->done.store(share, std::memory_order_relaxed); },
            [job] { return job->is_stopped.load(std::memory_order_relaxed); });
        // A file that cannot be read is reported where it is played.
        return plan ? std::move(*plan) : PlanOfSong();
    });
}

SongPlanner::Progress SongPlanner::look(const std::filesystem::path& file) {
    Job* const job = job_of(file);
    if (job == nullptr) {
        return {};
    }
    if (job->plan_to_come.valid() &&
        job->plan_to_come.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
        job->plan = job->plan_to_come.get();
    }
    const bool is_working = job->plan_to_come.valid();
    return {job->plan, is_working, is_working ? job->expected(HostClock::now()) : std::nullopt};
}

PlanOfSong SongPlanner::wait_for(const std::filesystem::path& file) {
    if (Job* const job = job_of(file); job != nullptr && job->plan_to_come.valid()) {
        job->plan_to_come.wait();
    }
    return look(file).plan;
}

}  // namespace raks::engine
