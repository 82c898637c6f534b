#include <algorithm>
#include <array>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "motion/dance/baking/landing_delay.hpp"
#include "motion/dance/baking/trajectory.hpp"
#include "motion/dance/body/floor_move.hpp"
#include "motion/dance/body/hands.hpp"
#include "motion/dance/dance_content.hpp"

namespace raks::motion {
namespace {

constexpr std::size_t kTakeWorkers = 2;  // threads that solve takes
constexpr int kAims = 2;                 // passes of landing correction for each take
constexpr double kReach = 0.25;          // beats; people step twice a beat

// One take as it was danced, from its states alone, with feet that are planted when the dancer's
// came down. Takes last minutes: they are kept small.
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
    Footing footing{.places = {}, .landings = take.landings, .reach = kReach};
    const auto planted = [&] {
        return FigurePassage(take, steps, steps.poses, way, footing, nullptr, skeleton);
    };
    FigurePassage passage = planted();
    for (int i = 0; i < kAims; ++i) {
        aim_landings(take, passage, skeleton, 1.0, footing.landings);
        passage = planted();
    }
    return passage.compact();
}

/// Adds a rotation to a sum, on the side of what is there: q and -q are the same rotation.
void add_rotation(const glm::quat& rotation, float weight, glm::quat& sum) noexcept {
    sum += (glm::dot(sum, rotation) < 0.0F ? -weight : weight) * rotation;
}

/// How the hips of a take are tilted, in the mean, when it heads ahead.
glm::quat mean_tilt(const LibraryFigure& take) {
    constexpr int kPerBeat = 4;
    glm::quat sum(0.0F, 0.0F, 0.0F, 0.0F);
    for (int i = 0; i < take.beats * kPerBeat; ++i) {
        Pose pose;
        take.passages.front().at(static_cast<double>(i) / kPerBeat, pose);
        add_rotation(inverse(floor_frame(pose))(pose).rotation(Bone::hips), 1.0F, sum);
    }
    return glm::normalize(sum);
}

/// The mean posture of all takes and their mirror images, heading ahead. What is danced smaller or
/// larger is so about one posture, which does not change where takes are joined.
FigureMiddle middle_of_takes(const std::vector<LibraryFigure>& takes) {
    FigureMiddle middle = takes.front().middle;
    std::array<glm::quat, FigurePassage::kBones.size()> sums{};
    sums.fill(glm::quat(0.0F, 0.0F, 0.0F, 0.0F));
    float height = 0.0F;
    float beats = 0.0F;
    for (const LibraryFigure& take : takes) {
        const auto weight = static_cast<float>(take.beats);
        Pose own = take.middle.pose;
        own.rotation(Bone::hips) = mean_tilt(take);
        const Pose image = mirrored(own);
        for (std::size_t i = 0; i < sums.size(); ++i) {
            add_rotation(own.rotation(FigurePassage::kBones[i]), weight, sums[i]);
            add_rotation(image.rotation(FigurePassage::kBones[i]), weight, sums[i]);
        }
        beats += weight;
        height += weight * own.hips_position.y;
        middle.turns_about_it &= take.middle.turns_about_it;
    }
    for (std::size_t i = 0; i < sums.size(); ++i) {
        middle.pose.rotation(FigurePassage::kBones[i]) = glm::normalize(sums[i]);
    }
    middle.pose.hips_position = {0.0F, height / beats, 0.0F};
    middle.turns_about_it.set(index_of(Bone::hips));
    return middle;
}

}  // namespace

Expected<DanceContent> make_cell_content(const CellDance& dance, const Skeleton& skeleton) {
    DanceContent content;
    content.skeleton = skeleton;
    relax_hands(content.rest);
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
        figure.landing_delay = landing_delay(dance.takes[i], figure.passages.front(), skeleton);
        figure.middle = middle_of(figure.passages.front(), figure.beats, false, skeleton);
        content.figures.push_back(std::move(figure));
    }
    const FigureMiddle middle = middle_of_takes(content.figures);
    for (LibraryFigure& take : content.figures) {
        take.middle = middle;
    }
    content.cells = std::make_shared<const CellGraph>(dance.graph);
    content.stands = cell_stands(content);
    return content;
}

void take_habits(const DanceHabits& habits, DanceContent& content) {
    FigureGrammar grammar;
    grammar.habits = habits;
    content.chooser = FigureChooser(std::move(grammar), {});
}

}  // namespace raks::motion
