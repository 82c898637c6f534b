#include "motion/capture/angles/posture_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/capture/angles/posture_polish.hpp"
#include "motion/capture/solving/frame_fit.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kSearchGate = 12.0;      // pixels
constexpr double kTrunkTolerance = 0.05;  // metres by which distances on a trunk may be off
constexpr double kFlattest = 0.02;  // m^2: area of the triangles that tell how a trunk is turned
constexpr std::size_t kMostPlaces = 40;  // of a colour
constexpr std::size_t kMostTrunks = 8;   // that are looked at closely
constexpr double kLimbReach = 0.06;  // metres of a place from where a fitted limb has its marker

/// Places that spots agree on, by colour.
using AgreedPlaces = std::vector<std::vector<glm::dvec3>>;

AgreedPlaces agreed_places(const SearchedFrame& frame) {
    const std::size_t colours = *std::max_element(frame.classes.begin(), frame.classes.end()) + 1;
    AgreedPlaces places(colours);
    for (std::size_t colour = 0; colour < colours; ++colour) {
        for (const SpotAgreement& found :
             agreements(frame.rig, frame.spots, colour, frame.sigma, 2)) {
            // The same place by fewer cameras says nothing new.
            const auto is_same = [&](const glm::dvec3& other) {
                return glm::distance(other, found.point.place) < 0.02;
            };
            if (std::none_of(places[colour].begin(), places[colour].end(), is_same) &&
                places[colour].size() < kMostPlaces) {
                places[colour].push_back(found.point.place);
            }
        }
    }
    return places;
}

/// A turn and a move of the trunk, and how many pixels say so.
struct TrunkGuess {
    BodyState state;
    double energy = 0.0;
};

glm::dmat3 axes_of(const std::array<glm::dvec3, 3>& points) {
    const glm::dvec3 x = glm::normalize(points[1] - points[0]);
    const glm::dvec3 z = glm::normalize(glm::cross(x, points[2] - points[0]));
    return {x, glm::cross(z, x), z};
}

class PostureSearch {
 public:
    PostureSearch(const FrameContext& context, const SearchedFrame& frame)
        : context_(context),
          frame_(frame),
          places_(agreed_places(frame)),
          usual_(context.model.usual_state(context.shape)),
          body_(marker_places_of(context, usual_)) {
        for (std::size_t i = 0; i < context.marker_bones.size(); ++i) {
            if (is_of_trunk(context.marker_bones[i])) {
                trunk_.push_back(i);
            }
        }
    }

    std::optional<BodyState> best(double at_least) {
        for (std::size_t a = 0; a < trunk_.size(); ++a) {
            for (std::size_t b = a + 1; b < trunk_.size(); ++b) {
                for (std::size_t c = b + 1; c < trunk_.size(); ++c) {
                    try_markers({trunk_[a], trunk_[b], trunk_[c]});
                }
            }
        }
        std::stable_sort(guesses_.begin(), guesses_.end(), [](const auto& one, const auto& other) {
            return one.energy < other.energy;
        });
        std::optional<BodyState> best;
        double least = 0.0;
        std::size_t looked_at = 0;
        for (const TrunkGuess& guess : guesses_) {
            if (looked_at++ == kMostTrunks) {
                break;
            }
            const BodyState state = with_limbs(guess.state);
            const auto places = marker_places_of(context_, state);
            const double energy = reprojection_energy(places, frame_.marks, kSearchGate);
            if (seen_share(places, frame_.marks, trunk_, kSearchGate) >= at_least &&
                (!best || energy < least)) {
                best = state;
                least = energy;
            }
        }
        return best;
    }

 private:
    // All ways in which three markers may be places of their colours.
    void try_markers(const std::array<std::size_t, 3>& markers) {
        const std::array<glm::dvec3, 3> on_body = {
            body_[markers[0]], body_[markers[1]], body_[markers[2]]};
        const double area =
            glm::length(glm::cross(on_body[1] - on_body[0], on_body[2] - on_body[0]));
        if (area < kFlattest) {
            return;
        }
        const auto fits =
            [&](std::size_t i, const glm::dvec3& p, std::size_t k, const glm::dvec3& q) {
                return std::abs(glm::distance(p, q) - glm::distance(on_body[i], on_body[k])) <
                       kTrunkTolerance;
            };
        const auto colour = [&](std::size_t i) { return frame_.classes[markers[i]]; };
        for (const glm::dvec3& first : places_[colour(0)]) {
            for (const glm::dvec3& second : places_[colour(1)]) {
                if (!fits(0, first, 1, second)) {
                    continue;
                }
                for (const glm::dvec3& third : places_[colour(2)]) {
                    if (fits(0, first, 2, third) && fits(1, second, 2, third)) {
                        add_guess(on_body, {first, second, third});
                    }
                }
            }
        }
    }

    void add_guess(const std::array<glm::dvec3, 3>& on_body,
                   const std::array<glm::dvec3, 3>& places) {
        const glm::dmat3 turn = axes_of(places) * glm::transpose(axes_of(on_body));
        TrunkGuess guess{usual_, 0.0};
        guess.state.turns[0] = glm::normalize(glm::quat_cast(turn)) * usual_.turns[0];
        guess.state.hips = (places[0] + places[1] + places[2]) / 3.0 +
                           turn * (usual_.hips - (on_body[0] + on_body[1] + on_body[2]) / 3.0);
        std::vector<glm::dvec3> moved(body_.size(), glm::dvec3(1e6));
        for (const std::size_t marker : trunk_) {
            moved[marker] = guess.state.hips + turn * (body_[marker] - usual_.hips);
        }
        guess.energy = reprojection_energy(moved, frame_.marks, kSearchGate);
        guesses_.push_back(guess);
    }

    // Fits the trunk to the places that are nearest to its markers, then the limbs to those that
    // are theirs for sure.
    [[nodiscard]] BodyState with_limbs(const BodyState& trunk) const {
        FrameContext wide = context_;
        wide.weights.outlier = 0.15;
        const FrameSight sight = nearest_places(trunk, trunk_);
        const BodyState state = fit_frame(wide, sight, trunk, 10).state;
        const FrameSight whole = by_distances(state);
        return whole.markers.size() > 3 ? find_frame(context_, whole, state).state : state;
    }

    // The places that are nearest to some markers, each once.
    [[nodiscard]] FrameSight nearest_places(const BodyState& state,
                                            const std::vector<std::size_t>& markers) const {
        const auto at = marker_places_of(context_, state);
        FrameSight sight;
        for (const std::size_t marker : markers) {
            const glm::dvec3* nearest = nullptr;
            for (const glm::dvec3& place : places_[frame_.classes[marker]]) {
                if (glm::distance(place, at[marker]) < kLimbReach &&
                    (nearest == nullptr ||
                     glm::distance(place, at[marker]) < glm::distance(*nearest, at[marker]))) {
                    nearest = &place;
                }
            }
            if (nearest != nullptr) {
                sight.markers.push_back({marker, *nearest, 0.01});
            }
        }
        return sight;
    }

    // The places of the trunk, and of limbs those that one place of their colour alone can be,
    // by how far a marker can be from the trunk.
    [[nodiscard]] FrameSight by_distances(const BodyState& state) const {
        FrameSight sight = nearest_places(state, trunk_);
        const PlacedBody body = context_.model.place(context_.shape, state);
        std::vector<const glm::dvec3*> taken;
        for (std::size_t marker = 0; marker < body_.size(); ++marker) {
            if (is_of_trunk(context_.marker_bones[marker])) {
                continue;
            }
            const glm::dvec3* only = nullptr;
            std::size_t count = 0;
            for (const glm::dvec3& place : places_[frame_.classes[marker]]) {
                const bool is_of_trunk_marker = std::any_of(
                    sight.markers.begin(), sight.markers.end(), [&](const SeenMarker& seen) {
                        return glm::distance(seen.place, place) < 1e-9;
                    });
                if (!is_of_trunk_marker && is_in_reach(body, marker, place)) {
                    only = &place;
                    ++count;
                }
            }
            if (count == 1) {
                sight.markers.push_back({marker, *only, 0.01});
            }
        }
        return sight;
    }

    // Whether a limb's marker can be at a place: not farther from the limb's root than its bones
    // reach.
    [[nodiscard]] bool is_in_reach(const PlacedBody& body,
                                   std::size_t marker,
                                   const glm::dvec3& place) const {
        double reach = glm::length(context_.shape.marker_places[marker]);
        std::size_t bone = index_of(context_.marker_bones[marker]);
        while (!is_of_trunk(static_cast<motion::Bone>(motion::kBoneParents[bone]))) {
            reach += glm::length(context_.shape.offsets[bone]);
            bone = motion::kBoneParents[bone];
        }
        return glm::distance(body.places[bone], place) < 1.1 * reach;
    }

    const FrameContext& context_;
    const SearchedFrame& frame_;
    AgreedPlaces places_;
    BodyState usual_;
    std::vector<glm::dvec3> body_;  // the markers in the usual posture
    std::vector<std::size_t> trunk_;
    std::vector<TrunkGuess> guesses_;
};

}  // namespace

std::optional<BodyState> search_posture(const FrameContext& context,
                                        const SearchedFrame& frame,
                                        double at_least) {
    return PostureSearch(context, frame).best(at_least);
}

double seen_share(const std::vector<glm::dvec3>& places,
                  const FrameMarks& marks,
                  const std::vector<std::size_t>& markers,
                  double gate) {
    double seen = 0.0;
    for (const std::size_t marker : markers) {
        std::size_t views = 0;
        for (std::size_t picture = 0; picture < marks.pictures().size(); ++picture) {
            const glm::dvec3 at = marks.pictures()[picture].seen(places[marker]);
            const MarkRange range = marks.of(marker, picture);
            for (std::size_t k = range.first; k < range.first + range.count; ++k) {
                if (at.z > 0.05 && glm::distance(glm::dvec2(at), marks.marks()[k].place) < gate) {
                    ++views;
                    break;
                }
            }
        }
        seen += views >= 2 ? 1.0 : 0.0;
    }
    return markers.empty() ? 0.0 : seen / static_cast<double>(markers.size());
}

}  // namespace raks::capture
