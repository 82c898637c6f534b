// Dance library: all figures of a dance, solved for one skeleton.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/dance/generator.hpp"
#include "motion/figures/dance_habits.hpp"
#include "motion/skeleton/pose.hpp"
#include "motion/skeleton/skeleton.hpp"

namespace raks::motion {

struct CellDance;      // motion/cells/cell_dance.hpp
struct CellGraph;      // motion/cells/cell_dance.hpp
struct FigureGrammar;  // motion/figures/figure_grammar.hpp
struct FigureModel;    // motion/figures/figure_model.hpp

/// All figures of a dance, solved into trajectories for one skeleton. Immutable: may be shared by
/// any number of dancers and threads.
class DanceLibrary {
 public:
    /// Solves the trajectories of all figures, each in eight ways (some 40 ms a figure). `grammar`:
    /// its rules in the order of the figures; null: any figure may follow any other. `generator`:
    /// trajectories, or frames as in the paper for comparison, which plants no foot: feet slide and
    /// may dip below the floor, between figures too. Errors: no figures, a figure that cannot be
    /// solved (named), a grammar of another dance. Threads: workers. Real-time: no.
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> build(
        std::span<const FigureModel> figures,
        const Skeleton& skeleton,
        const FigureGrammar* grammar = nullptr,
        Generator generator = Generator::trajectories);
    /// Solves the takes of a dance of cells (some 100 ms a minute). `habits`: what its dancers do
    /// beside the takes. Errors: a take that cannot be
    /// solved, named. Threads: workers. Real-time: no.
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> build(
        const CellDance& dance,
        const Skeleton& skeleton,
        const DanceHabits& habits = DanceHabits());
    /// What build() solved, as bytes for a cache on this machine; unpack() gives the same bits
    /// back. They are valid only for the program, skeleton and grammar that they were solved with.
    /// Threads: workers. Real-time: no.
    [[nodiscard]] std::string packed() const;
    /// Reads what packed() returned, without a copy: the library keeps the bytes. Errors: damaged,
    /// of another program, other figures than the grammar has. Threads: workers. Real-time: no.
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> unpack(
        const std::shared_ptr<const std::string>& bytes,
        const Skeleton& skeleton,
        const FigureGrammar& grammar);
    /// The same of a dance of cells, which has no grammar.
    [[nodiscard]] static Expected<std::shared_ptr<const DanceLibrary>> unpack(
        const std::shared_ptr<const std::string>& bytes,
        const Skeleton& skeleton,
        const DanceHabits& habits = DanceHabits());
    /// Out of line, where Content is complete.
    ~DanceLibrary();
    /// The figures' names in the order of `figures`; the views are valid as long as the library
    /// lives.
    [[nodiscard]] std::vector<std::string_view> figure_names() const;

    /// What stays where it is in the room while this figure moves the hips; `nothing` also for a
    /// name that is unknown. Threads: any. Real-time: no.
    [[nodiscard]] StillPart still_part(std::string_view figure) const noexcept;
    /// The cells of a dance of cells, whose figures are its takes; null: a dance of figures.
    [[nodiscard]] const CellGraph* cells() const noexcept;
    /// The pose at a beat of a figure or take as it was learnt, seen from where it begins.
    /// `figure`: index in figure_names(). Threads: any. Real-time: no.
    [[nodiscard]] Pose pose_at(std::size_t figure, double beat) const;
    /// Not copied: dancers share one library by pointer.
    DanceLibrary(const DanceLibrary&) = delete;
    /// Not copied.
    DanceLibrary& operator=(const DanceLibrary&) = delete;

    struct Content;  // motion/dance/: what the dancer reads
    /// For the dancer alone (motion/library_content.hpp). Threads: any. Real-time: yes.
    [[nodiscard]] const Content& content() const noexcept { return *content_; }

 private:
    explicit DanceLibrary(std::unique_ptr<const Content> content);
    std::unique_ptr<const Content> content_;
};

}  // namespace raks::motion
