#include <algorithm>
#include <optional>
#include <thread>
#include <utility>

#include "motion/dance/baking/trajectory.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/dance_content.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kTakeWorkers = 2;  // threads that solve takes

// One take as it was danced, from its states alone, with planted feet. Takes last minutes: they are
// kept small.
FigurePassage passage_of(const FigureModel& take, const Skeleton& skeleton) {
    FigureTracks tracks;
    for (const PartModel& part : take.parts) {
        tracks[static_cast<std::size_t>(part.part)] = most_likely_trajectory(part, take.samples());
    }
    const double scale = static_cast<double>(skeleton.hips_height()) / take.source_hips_height;
    FigurePath way;
    way.turn = take.net_turn;
    way.move = {take.net_turn, take.net_displacement * scale};
    const FreeFigure steps = free_figure(take, tracks, way, skeleton);
    Footing footing;
    for (std::vector<LandingOffset>& landings : footing.landings) {
        landings.resize(static_cast<std::size_t>(take.beats));
    }
    return FigurePassage(take, steps, steps.poses, way, footing, nullptr, skeleton).compact();
}

}  // namespace

Expected<DanceContent> make_cell_content(const CellDance& dance, const Skeleton& skeleton) {
    DanceContent content;
    content.skeleton = skeleton;
    relax_hands(content.rest);
    content.cells = std::make_shared<const CellGraph>(dance.graph);
    content.metre = {Bpm::from_period(dance.graph.beat_seconds), 4};
    for (const FigureModel& take : dance.takes) {
        if (auto valid = validate(take); !valid) {
            return fail(take.name + ": " + valid.error().message);
        }
    }
    std::vector<std::optional<FigurePassage>> passages(dance.takes.size());
    {
        std::vector<std::jthread> workers;
        for (std::size_t first = 0; first < kTakeWorkers; ++first) {
            workers.emplace_back([&, first] {
                for (std::size_t i = first; i < passages.size(); i += kTakeWorkers) {
                    passages[i].emplace(passage_of(dance.takes[i], skeleton));
                }
            });
        }
    }
    for (std::size_t i = 0; i < dance.takes.size(); ++i) {
        LibraryFigure figure;
        figure.name = dance.takes[i].name;
        figure.beats = dance.takes[i].beats;
        figure.learnt_tempo = dance.takes[i].learnt_tempo;
        figure.passages.push_back(std::move(*passages[i]));
        figure.middle = middle_of(figure.passages.front(), figure.beats, false, skeleton);
        content.figures.push_back(std::move(figure));
    }
    return content;
}

}  // namespace raks::motion
