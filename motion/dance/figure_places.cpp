#include "motion/dance/figure_places.hpp"

#include <cmath>

#include "motion/skeleton/pose.hpp"

namespace raks::motion {
namespace {

// Replaces each foot's start place by the mean over the figures that have one.
void share_places(std::vector<StartPlaces>& places) {
    for (std::size_t s = 0; s < kSides.size(); ++s) {
        glm::vec2 sum{};
        float count = 0.0F;
        for (const StartPlaces& own : places) {
            sum += own[s].value_or(glm::vec2(0.0F));
            count += own[s] ? 1.0F : 0.0F;
        }
        for (StartPlaces& own : places) {
            own[s] = count > 0.0F ? std::optional(sum / count) : std::nullopt;
        }
    }
}

}  // namespace

std::vector<FigurePath> closed_paths(std::span<const FigureModel> figures,
                                     const Skeleton& skeleton,
                                     const FigureGrammar* grammar) {
    std::vector<FigurePath> ways;
    glm::dvec2 sum{0.0, 0.0};
    double odd = 0.0;
    for (const FigureModel& model : figures) {
        FigurePath way;
        way.half_turns = static_cast<int>(std::lround(model.net_turn / M_PI));
        way.turn = M_PI * way.half_turns;
        if (way.half_turns % 2 != 0) {
            const double scale =
                static_cast<double>(skeleton.hips_height()) / model.source_hips_height;
            // Half a turn about a point displaces by twice the vector to it.
            sum += 0.5 * model.net_displacement * scale;
            odd += 1.0;
        }
        ways.push_back(way);
    }
    for (std::size_t i = 0; grammar != nullptr && i < ways.size(); ++i) {
        ways[i].aside = grammar->rules[i].aside[static_cast<std::size_t>(figures[i].role)];
    }
    const FigureGrammar::Place* const place =
        grammar != nullptr ? grammar->place_of(figures.front().role) : nullptr;
    const glm::dvec2 point = place != nullptr ? place->turn_point : sum / std::max(1.0, odd);
    for (FigurePath& way : ways) {
        if (way.half_turns % 2 != 0) {
            way.move = {M_PI, 2.0 * point};
        }
    }
    return ways;
}

FloorMove couple_of(std::span<const FigureModel> figures, const FigureGrammar* grammar) {
    const FigureGrammar::Place* const place =
        grammar != nullptr ? grammar->place_of(figures.front().role) : nullptr;
    FloorMove move;
    if (place != nullptr) {
        move.heading = place->heading;
        move.offset = -move.turned(place->turn_point);
    }
    return move;
}

FloorMove couple_of(const glm::dvec2& apart, DanceRole role, const FloorMove& stance) {
    constexpr double kLeadHeading =
        M_PI / 3.0;  // both are seen more from the side than from behind
    FloorMove move;
    move.heading = kLeadHeading;
    move.offset = move.turned(-0.5 * apart);
    if (role == DanceRole::follow) {
        move.offset = -move.offset;
        move.heading -= M_PI;
    }
    return move * inverse(stance);
}

std::vector<StartPlaces> start_places(std::span<const FigureModel> figures,
                                      const std::vector<FigureTracks>& tracks,
                                      const std::vector<FigurePath>& ways,
                                      const Skeleton& skeleton,
                                      FigureGrammar::Starts starts) {
    std::vector<StartPlaces> places;
    for (std::size_t i = 0; i < figures.size(); ++i) {
        places.push_back(learnt_places(figures[i], tracks[i], ways[i], skeleton));
    }
    if (starts == FigureGrammar::Starts::common) {
        share_places(places);
    }
    return places;
}

FloorMove stage_of(const LibraryFigure& figure) {
    glm::dvec2 centre{0.0, 0.0};
    glm::dvec2 facing{0.0, 0.0};
    const int steps = 8 * figure.beats;
    for (int i = 0; i < steps; ++i) {
        Pose pose;
        figure.passages.front().at(i / 8.0, pose);
        const double heading = heading_of(glm::dquat(pose.rotation(Bone::hips)));
        centre +=
            glm::dvec2(pose.hips_position.x, pose.hips_position.z) / static_cast<double>(steps);
        facing += glm::dvec2(std::sin(heading), std::cos(heading));
    }
    FloorMove stage{-std::atan2(facing.x, facing.y), {}};
    stage.offset = -stage.turned(centre);
    return stage;
}

void place_figures(const Skeleton& skeleton, std::vector<LibraryFigure>& figures) {
    const FloorMove first = stance_before(figures.front().passages.front(), skeleton);
    for (LibraryFigure& figure : figures) {
        figure.place = first * inverse(stance_before(figure.passages.front(), skeleton));
    }
}

}  // namespace raks::motion
