#pragma once

#include <filesystem>
#include <string>

#include "base/expected.hpp"
#include "training/figures/label_counts.hpp"

namespace raks::apps {

/// Beats of a piece of music, as counts for training.
struct TrackedCounts {
    motion::DancedMusic music;  ///< its name is the file's
    std::string warning;        ///< of a file that is damaged but still plays; else empty
};

/// The beats of a music file as the analyzer tracks them from beginning to end. Beats before the
/// tracker was first confident (the first seconds) are dropped; where the first confident beats are
/// even, beats are extrapolated backwards at their tempo. Errors: as engine::MusicSource::open and
/// make_analyzer. Threads: workers. Real-time: no.
[[nodiscard]] Expected<TrackedCounts> track_counts(const std::filesystem::path& file);

}  // namespace raks::apps
