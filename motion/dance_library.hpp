#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/dance/generator.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

struct FigureGrammar;
struct FigureModel;

/// All figures of a dance, solved into trajectories for one skeleton. Immutable: may be shared by
/// any number of dancers and threads.
class DanceLibrary {
 public:
    /// Solves the trajectories of all figures, each in eight ways (some 40 ms a figure). `grammar`:
    /// its rules in the order of the figures; none: any after any other. `generator`: ours, or the
    /// paper's for comparison, in which no foot is planted: feet slide and may dip below the floor,
    /// in joins too.
    /// Errors: no figures, a figure that cannot be solved (named), a grammar of another dance.
    /// Threads: workers. Real-time: no.
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> build(
        std::span<const FigureModel> figures,
        const Skeleton& skeleton,
        const FigureGrammar* grammar = nullptr,
        Generator generator = Generator::trajectories);
    /// What build() solved, as bytes for a cache on this machine, and back; the same bits. They fit
    /// the program, skeleton and grammar that they were solved with.
    /// Errors of unpack: damaged, of another program, other figures than the grammar has.
    [[nodiscard]] std::string packed() const;
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> unpack(
        std::string_view bytes, const Skeleton& skeleton, const FigureGrammar& grammar);
    ~DanceLibrary();
    /// In the order of `figures`; as long as the library lives.
    [[nodiscard]] std::vector<std::string_view> figure_names() const;
    DanceLibrary(const DanceLibrary&) = delete;
    DanceLibrary& operator=(const DanceLibrary&) = delete;

    struct Content;  // motion/dance/: what the dancer reads
    [[nodiscard]] const Content& content() const noexcept { return *content_; }

 private:
    explicit DanceLibrary(std::unique_ptr<const Content> content);
    std::unique_ptr<const Content> content_;
};

}  // namespace raks::motion
