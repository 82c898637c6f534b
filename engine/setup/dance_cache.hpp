#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/setup/dance_catalogue.hpp"
#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// Keeps solved dances between runs, so that a command need not solve them again: a file for each,
/// under a name that stands for all that shaped it (the bytes of its figures and grammar, the
/// skeleton, the form, this very program). What is damaged or cannot be read is not found; what
/// cannot be written is not kept; neither is an error. Several processes may use it at once.
/// Threads: any. Real-time: no.
class DanceCache {
 public:
    /// In this folder; empty: finds and keeps nothing.
    explicit DanceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// $XDG_CACHE_HOME/raks/dances.
    [[nodiscard]] static DanceCache of_user();

    /// Of a dance to be solved so. Empty: there is no cache.
    [[nodiscard]] std::filesystem::path path_of(const DancePlan& plan,
                                                const motion::Skeleton& skeleton,
                                                const DanceForm& form) const;
    /// Null: not there, or not whole.
    [[nodiscard]] static std::shared_ptr<const motion::DanceLibrary> find(
        const std::filesystem::path& path,
        const motion::Skeleton& skeleton,
        const motion::FigureGrammar& grammar);
    /// Keeps a dance, and drops what was kept of the same dance and form before.
    static void keep(const std::filesystem::path& path, const motion::DanceLibrary& library);

 private:
    std::filesystem::path folder_;
};

}  // namespace raks::engine
