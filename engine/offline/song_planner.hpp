#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "audio/song/song_plan.hpp"
#include "base/expected.hpp"
#include "engine/setup/analyzer_setup.hpp"

namespace raks::engine {

/// A song's plan; shared with the threads that play by it.
using PlanOfSong = std::shared_ptr<const audio::SongPlan>;

/// Analyzes a whole file, from its first sample to its last. `progress` gets the share that is
/// done, [0, 1], where the file says how long it is; `is_stopped`, asked after every block and
/// while a decoder keeps one waiting, ends it early. Both may be empty. Null where it was stopped,
/// and for more than an hour of music: so much is danced to as it comes. Errors: those of
/// MusicSource::open, and of the analyzer. Threads: workers.
[[nodiscard]] Expected<PlanOfSong> plan_song(const std::filesystem::path& file,
                                             const AnalyzerModels& models,
                                             const std::function<void(double)>& progress = {},
                                             const std::function<bool()>& is_stopped = {});

/// Plans songs ahead of time, each on a thread of its own with a low priority: the one that plays,
/// and the next one. Threads: one.
class SongPlanner {
 public:
    /// Plans with these models.
    explicit SongPlanner(AnalyzerModels models);
    ~SongPlanner();  ///< ends what is running
    /// Not copied: threads refer to it.
    SongPlanner(const SongPlanner&) = delete;
    SongPlanner& operator=(const SongPlanner&) = delete;  ///< likewise

    /// Begins with this file, unless it was begun already by what the person has said of dances so
    /// far. Other files but the last two are forgotten.
    void prepare(const std::filesystem::path& file);

    /// What is known of a file's plan.
    struct Progress {
        PlanOfSong plan;          ///< null: not ready, or the file has none
        bool is_working = false;  ///< a plan may still come
        /// When it will be ready if the work goes on as so far; known after 0.3 s of work.
        std::optional<HostTime> expected;
    };
    /// Looks, without waiting. A file that was not begun has no plan.
    [[nodiscard]] Progress look(const std::filesystem::path& file);
    /// Waits until the work on a file has ended.
    [[nodiscard]] PlanOfSong wait_for(const std::filesystem::path& file);

 private:
    struct Job;
    [[nodiscard]] Job* job_of(const std::filesystem::path& file);

    AnalyzerModels models_;
    std::array<std::unique_ptr<Job>, 2> jobs_;  // the newer one first
};

}  // namespace raks::engine
