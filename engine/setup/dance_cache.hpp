// Dance cache: solved dances in the user's cache.
#pragma once

#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "engine/setup/dance_catalogue.hpp"
#include "motion/dance_library.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::engine {

/// Keeps solved dances between runs, so that a command need not solve them again. One file a dance;
/// its name contains a hash of everything that determines the result: the bytes of its figures and
/// its grammar, or of its cells; the skeleton, the form and the program itself. A file that is
/// damaged counts as missing, and one that cannot be written is left out; neither is an error.
/// Several processes may use a folder at once. Threads: any. Real-time: no.
class DanceCache {
 public:
    /// A cache in this folder. Empty: finds nothing and keeps nothing.
    explicit DanceCache(std::filesystem::path folder) : folder_(std::move(folder)) {}
    /// The cache of the user: $XDG_CACHE_HOME/raks/dances, or below ~/.cache.
    [[nodiscard]] static DanceCache of_user();

    /// The file of a dance that is solved for this skeleton in this form. Empty: there is no cache,
    /// or a file of the plan cannot be read.
    [[nodiscard]] std::filesystem::path path_of(const DancePlan& plan,
                                                const motion::Skeleton& skeleton,
                                                const DanceForm& form) const;
    /// The same of a dance of cells, which has one form alone. `cells`: the bytes of its file.
    /// Empty: there is no cache.
    [[nodiscard]] std::filesystem::path path_of(std::string_view dance,
                                                std::string_view cells,
                                                const motion::Skeleton& skeleton) const;
    /// The dance of a file; null: there is no such file, or it is damaged.
    [[nodiscard]] static std::shared_ptr<const motion::DanceLibrary> find(
        const std::filesystem::path& path,
        const motion::Skeleton& skeleton,
        const motion::FigureGrammar& grammar);
    /// The same of a dance of cells.
    [[nodiscard]] static std::shared_ptr<const motion::DanceLibrary> find(
        const std::filesystem::path& path,
        const motion::Skeleton& skeleton,
        const motion::DanceHabits& habits);
    /// Writes a dance to its file, and removes older files of the same dance, role, form and body;
    /// of all avatars' bodies together the last 96 stay.
    static void keep(const std::filesystem::path& path, const motion::DanceLibrary& library);

 private:
    std::filesystem::path folder_;
};

}  // namespace raks::engine
