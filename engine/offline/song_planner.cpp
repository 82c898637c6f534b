#include "engine/offline/song_planner.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <thread>
#include <utility>

#include "engine/offline/music_source.hpp"

namespace raks::engine {
namespace {

// Of the worker: sound and pictures come first. On Linux each thread has its own.
constexpr int kNice = 10;
constexpr Nanos kLongest = std::chrono::hours(1);  // 180 MB of plan
constexpr std::chrono::milliseconds kLook(20);     // between two looks at the work
constexpr std::chrono::milliseconds kFirst(300);   // from then on the rest can be foretold

}  // namespace

Expected<PlanOfSong> plan_song(const std::filesystem::path& file,
                               const AnalyzerModels& models,
                               const std::function<void(double)>& progress,
                               const std::function<bool()>& is_stopped) {
    auto source = MusicSource::open(file);
    if (!source) {
        return fail(std::move(source.error()));
    }
    auto analyzer = make_song_analyzer(source->rate(), models);
    if (!analyzer) {
        return fail(std::move(analyzer.error()).in(file.string()));
    }
    for (auto block = source->next(); !block.mono.empty(); block = source->next()) {
        analyzer->process(block.mono);
        if (const auto share = source->progress(); share && progress) {
            progress(*share);
        }
        if (is_stopped && is_stopped()) {
            break;
        }
        if (source->given() > kLongest) {
            return PlanOfSong();
        }
    }
    return std::make_shared<const audio::SongPlan>(analyzer->finish());
}

// A file that is being planned, or was.
struct SongPlanner::Job {
    std::filesystem::path file;
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

    // Whether at this pace it will be ready within `patience` of now.
    [[nodiscard]] bool is_worth_waiting(Nanos patience) const {
        const Nanos spent = HostClock::now() - started;
        const double share = done.load(std::memory_order_relaxed);
        return spent < kFirst || share <= 0.0
                   ? spent < kFirst
                   : to_seconds(spent) * (1.0 - share) / share <= to_seconds(patience);
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
    if (job_of(file) != nullptr) {
        return;
    }
    jobs_[1] = std::move(jobs_[0]);
    jobs_[0] = std::make_unique<Job>();
    Job* const job = jobs_[0].get();
    job->file = file;
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

PlanOfSong SongPlanner::plan_of(const std::filesystem::path& file, Nanos patience) {
    Job* const job = job_of(file);
    if (job == nullptr) {
        return nullptr;
    }
    const HostTime deadline = HostClock::now() + patience;
    while (job->plan_to_come.valid()) {
        const Nanos left = std::max(Nanos(0), Nanos(deadline - HostClock::now()));
        if (job->plan_to_come.wait_for(std::min<Nanos>(left, kLook)) == std::future_status::ready) {
            job->plan = job->plan_to_come.get();
        } else if (left <= Nanos(0) || !job->is_worth_waiting(left)) {
            return nullptr;
        }
    }
    return job->plan;
}

}  // namespace raks::engine
