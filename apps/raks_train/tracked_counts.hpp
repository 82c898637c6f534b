#pragma once

#include <filesystem>
#include <string>

#include "base/expected.hpp"
#include "training/figures/label_counts.hpp"

namespace raks::apps {

struct TrackedCounts {
    motion::DancedMusic music;  ///< its name is the file's
    std::string warning;        ///< of a file that is damaged but still plays; else empty
};

/// The beats of a music file as the analyzer tracks them, listened to from beginning to end. What
/// it heard before it was sure (the first seconds) is taken off; where the first beats after that
/// are even, they are carried back at their tempo.
/// Errors: as engine::MusicSource::open and make_analyzer. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TrackedCounts> track_counts(const std::filesystem::path& file);

}  // namespace raks::apps
