#include "motion/capture/angles/posture_polish.hpp"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr int kMatchings = 3;
constexpr int kSteps = 6;
constexpr double kGate = 6.0;         // sigmas, or pixels
constexpr double kOutlier = 1.5;      // likewise: a spot so far off counts half
constexpr double kEnergyBound = 3.0;  // pixels, of what must fall
constexpr double kNearest = 0.05;     // metres before a camera

/// The least-squares problem of one frame.
class PolishSystem {
 public:
    PolishSystem(const FrameContext& context,
                 const FrameMarks& marks,
                 double sigma,
                 const PosturePrior& prior)
        : context_(context), marks_(marks), sigma_(sigma), prior_(prior) {}

    void match(const BodyState& state) {
        matched_ = match_marks(
            marker_places_of(context_, state), marks_, kGate * std::max(1.0, widest_sigma()));
    }

    // The cost of a posture and its equations.
    double assess(const BodyState& state, FrameSystem& system) const {
        system.clear(context_.model.variables());
        double cost = add_joint_terms(context_, state, system) + add_prior(state, system);
        const PlacedBody body = context_.model.place(context_.shape, state);
        for (std::size_t i = 0; i < matched_.size();) {
            const std::size_t marker = matched_[i].marker;
            const motion::Bone bone = context_.marker_bones[marker];
            const glm::dvec3 place = body.point(bone, context_.shape.marker_places[marker]);
            glm::dvec3 pull(0.0);
            glm::dmat3 weight(0.0);
            for (; i < matched_.size() && matched_[i].marker == marker; ++i) {
                cost += add_view(matched_[i], place, pull, weight);
            }
            system.add(context_.model.motion_of(body, bone, place), pull, weight);
        }
        return cost;
    }

 private:
    [[nodiscard]] double widest_sigma() const {
        double widest = 0.0;
        for (const MarkPicture& picture : marks_.pictures()) {
            widest = std::max(widest, sigma_ / picture.scale);
        }
        return widest;
    }

    double add_view(const MatchedMark& matched,
                    const glm::dvec3& place,
                    glm::dvec3& pull,
                    glm::dmat3& weight) const {
        const MarkPicture& picture = marks_.pictures()[matched.picture];
        const glm::dvec3 seen = picture.seen(place);
        if (!(seen.z > kNearest)) {
            return 0.0;
        }
        const double sigma = sigma_ / picture.scale;
        const double outlier = kOutlier * std::max(1.0, sigma);
        const glm::dvec2 off = glm::dvec2(seen) - marks_.marks()[matched.mark].place;
        const double square = glm::dot(off, off) / (outlier * outlier);
        const double worth = 1.0 / (sigma * sigma * (1.0 + square));
        const glm::dmat3 rows = glm::transpose(picture.rotation);
        const glm::dvec3 x = (kFocalLength * rows[0] - seen.x * rows[2]) / seen.z;
        const glm::dvec3 y = (kFocalLength * rows[1] - seen.y * rows[2]) / seen.z;
        pull += worth * (off.x * x + off.y * y);
        weight += worth * (glm::outerProduct(x, x) + glm::outerProduct(y, y));
        return 0.5 * outlier * outlier / (sigma * sigma) * std::log1p(square);
    }

    double add_prior(const BodyState& state, FrameSystem& system) const {
        double cost = 0.0;
        const auto add = [&](std::size_t variable, double from) {
            const double deviation = prior_.deviations[variable];
            const double worth = 1.0 / (deviation * deviation);
            const auto at = static_cast<Eigen::Index>(variable);
            system.matrix(at, at) += worth;
            system.gradient(at) += worth * from;
            cost += 0.5 * worth * from * from;
        };
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<glm::length_t>(axis);
            add(kHipsPlace + axis, state.hips[i] - prior_.state.hips[i]);
        }
        const auto& joints = context_.model.joints();
        for (std::size_t i = 0; i < joints.size(); ++i) {
            if (joints[i].is_hinge) {
                add(joints[i].first, state.angles[i] - prior_.state.angles[i]);
                continue;
            }
            const glm::dvec3 turn =
                static_cast<double>(joints[i].count) *
                turn_vector(glm::conjugate(prior_.state.turns[i]) * state.turns[i]);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                add(joints[i].first + axis, turn[static_cast<glm::length_t>(axis)]);
            }
        }
        return cost;
    }

    const FrameContext& context_;
    const FrameMarks& marks_;
    double sigma_;
    const PosturePrior& prior_;
    std::vector<MatchedMark> matched_;
};

// Six steps from a posture.
BodyState fitted(const FrameContext& context, const PolishSystem& problem, BodyState state) {
    FrameSystem system;
    FrameSystem tried;
    double cost = problem.assess(state, system);
    double damping = 1.0;
    for (int step = 0; step < kSteps; ++step) {
        Eigen::MatrixXd damped = system.matrix;
        damped.diagonal().array() += damping;
        const Eigen::VectorXd change = damped.llt().solve(-system.gradient);
        if (!change.allFinite()) {
            break;
        }
        const BodyState next = context.model.moved(state, change.data());
        const double now = problem.assess(next, tried);
        if (now < cost) {
            state = next;
            cost = now;
            std::swap(system, tried);
            damping *= 0.1;
        } else {
            damping *= 10.0;
        }
    }
    return state;
}

}  // namespace

std::vector<MatchedMark> match_marks(const std::vector<glm::dvec3>& places,
                                     const FrameMarks& marks,
                                     double gate) {
    std::vector<MatchedMark> matched;
    std::vector<MatchedMark> pairs;
    std::vector<std::size_t> taken_spots;
    std::vector<bool> is_taken;
    for (std::size_t picture = 0; picture < marks.pictures().size(); ++picture) {
        pairs.clear();
        for (std::size_t marker = 0; marker < places.size(); ++marker) {
            const glm::dvec3 seen = marks.pictures()[picture].seen(places[marker]);
            const MarkRange range = marks.of(marker, picture);
            for (std::size_t k = range.first; k < range.first + range.count; ++k) {
                const double distance = glm::distance(glm::dvec2(seen), marks.marks()[k].place);
                if (seen.z > kNearest && distance < gate) {
                    pairs.push_back({marker, picture, k, distance});
                }
            }
        }
        std::sort(pairs.begin(), pairs.end(), [](const MatchedMark& a, const MatchedMark& b) {
            return std::tie(a.distance, a.marker, a.mark) < std::tie(b.distance, b.marker, b.mark);
        });
        taken_spots.clear();
        is_taken.assign(places.size(), false);
        for (const MatchedMark& pair : pairs) {
            const std::size_t spot = marks.marks()[pair.mark].spot;
            const bool is_free =
                std::find(taken_spots.begin(), taken_spots.end(), spot) == taken_spots.end();
            if (is_free && !is_taken[pair.marker]) {
                taken_spots.push_back(spot);
                is_taken[pair.marker] = true;
                matched.push_back(pair);
            }
        }
    }
    std::sort(matched.begin(), matched.end(), [](const MatchedMark& a, const MatchedMark& b) {
        return std::tie(a.marker, a.picture) < std::tie(b.marker, b.picture);
    });
    return matched;
}

double reprojection_energy(const std::vector<glm::dvec3>& places,
                           const FrameMarks& marks,
                           double bound) {
    double energy = 0.0;
    for (std::size_t marker = 0; marker < places.size(); ++marker) {
        for (std::size_t picture = 0; picture < marks.pictures().size(); ++picture) {
            const glm::dvec3 seen = marks.pictures()[picture].seen(places[marker]);
            const MarkRange range = marks.of(marker, picture);
            double least = 1.0;
            for (std::size_t k = range.first; k < range.first + range.count; ++k) {
                const glm::dvec2 off = glm::dvec2(seen) - marks.marks()[k].place;
                const double square = glm::dot(off, off);
                if (seen.z > kNearest) {
                    least = std::min(least, square / (square + bound * bound));
                }
            }
            energy += least;
        }
    }
    return energy;
}

std::vector<glm::dvec3> marker_places_of(const FrameContext& context, const BodyState& state) {
    const PlacedBody body = context.model.place(context.shape, state);
    std::vector<glm::dvec3> places;
    places.reserve(context.marker_bones.size());
    for (std::size_t i = 0; i < context.marker_bones.size(); ++i) {
        places.push_back(body.point(context.marker_bones[i], context.shape.marker_places[i]));
    }
    return places;
}

BodyState refine(const FrameContext& context,
                 const FrameMarks& marks,
                 double sigma,
                 const PosturePrior& prior,
                 const BodyState& start) {
    PolishSystem problem(context, marks, sigma, prior);
    problem.match(start);
    return fitted(context, problem, start);
}

BodyState polish(const FrameContext& context,
                 const FrameMarks& marks,
                 double sigma,
                 const PosturePrior& prior,
                 const BodyState& start) {
    PolishSystem problem(context, marks, sigma, prior);
    BodyState state = start;
    for (int i = 0; i < kMatchings; ++i) {
        problem.match(state);
        state = fitted(context, problem, state);
    }
    const double before =
        reprojection_energy(marker_places_of(context, start), marks, kEnergyBound);
    const double after = reprojection_energy(marker_places_of(context, state), marks, kEnergyBound);
    return after < before ? state : start;
}

}  // namespace raks::capture
