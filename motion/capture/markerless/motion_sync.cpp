#include "motion/capture/markerless/motion_sync.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "motion/capture/markerless/dancer_limbs.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

constexpr double kLongestPictureStep =
    0.12;                            // seconds between pictures that say what lies between them
constexpr double kSureJoint = 0.5;   // visibility
constexpr int kClockRounds = 12;     // of Gauss and Newton
constexpr double kMostStep = 0.1;    // seconds of one of them
constexpr double kShiftStep = 0.01;  // seconds between shifts that are tried

double mean_focal(const Lens& lens) { return 0.5 * (lens.fx + lens.fy); }

MovingPoint moving(std::size_t kind, const glm::dvec2& from, const glm::dvec2& to, double seconds) {
    return {kind, from, (to - from) / seconds};
}

// A pair of sights of one thing, and how its distance changes with the clocks of both cameras.
struct Miss {
    double distance = 0.0;  // signed, pixels
    double by_from = 0.0;   // pixels a second of the first camera's clock
    double by_to = 0.0;
};

// Distance of `to` from the line of `from`, in pixels of `to`.
Miss miss_of(const glm::dmat3& epipolar,
             double focal,
             const MovingPoint& from,
             const MovingPoint& to) {
    const glm::dvec3 line = epipolar * glm::dvec3(from.direction, 1.0);
    const double length = std::hypot(line.x, line.y);
    const glm::dvec3 place(to.direction, 1.0);
    Miss miss;
    miss.distance = focal * glm::dot(line, place) / length;
    miss.by_to = focal * (line.x * to.velocity.x + line.y * to.velocity.y) / length;
    const glm::dvec3 change = epipolar * glm::dvec3(from.velocity, 0.0);
    const double growth = (line.x * change.x + line.y * change.y) / (length * length);
    miss.by_from = focal * glm::dot(change, place) / length - miss.distance * growth;
    return miss;
}

class ClockSearch {
 public:
    ClockSearch(const Rig& rig,
                const std::vector<MovingSights>& sights,
                const std::vector<Clock>& start,
                const MotionSyncOptions& options)
        : rig_(rig), sights_(sights), options_(options) {
        found_.clocks = start;
        double first = std::numeric_limits<double>::lowest();
        double last = std::numeric_limits<double>::max();
        std::vector<double> firsts;
        std::vector<double> lasts;
        for (std::size_t i = 0; i < sights.size(); ++i) {
            firsts.push_back(start[i].capture_time(sights[i].first_time()));
            lasts.push_back(start[i].capture_time(sights[i].last_time()));
        }
        std::sort(firsts.begin(), firsts.end());
        std::sort(lasts.begin(), lasts.end());
        first = firsts[1];
        last = lasts[lasts.size() - 2];
        middle_ = 0.5 * (first + last);
        // Not in even steps, which would meet pictures of an even rate always at the same phase,
        // where what lies between two pictures is off to the same side.
        constexpr double kGoldenShare = 0.6180339887498949;
        for (std::size_t i = 0; i < options.moments; ++i) {
            const double at =
                static_cast<double>(i) + std::fmod(kGoldenShare * static_cast<double>(i), 1.0);
            moments_.push_back(first + (last - first) * at / static_cast<double>(options.moments));
        }
        for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
            for (std::size_t j = 0; j < rig.cameras.size(); ++j) {
                lines_.push_back(i == j ? glm::dmat3(0.0)
                                        : epipolar_matrix(rig.cameras[i], rig.cameras[j]));
            }
        }
    }

    Expected<MotionSync> run() {
        try_shifts();
        for (int round = 0; round < kClockRounds; ++round) {
            if (!step()) {
                return fail(
                    "nothing moves that two cameras see at once, so their clocks cannot be "
                    "told from it");
            }
        }
        return found_;
    }

 private:
    [[nodiscard]] std::vector<MovingPoint> seen(std::size_t camera, double capture_time) const {
        return sights_[camera].at(found_.clocks[camera].camera_time(capture_time));
    }

    [[nodiscard]] Miss miss(std::size_t i,
                            std::size_t j,
                            const MovingPoint& a,
                            const MovingPoint& b) const {
        return miss_of(lines_[i * rig_.cameras.size() + j], mean_focal(rig_.cameras[j].lens), a, b);
    }

    // The sight in `of` that lies nearest to the line of `point`, of its kind.
    template <typename Use>
    void for_pairs(const std::vector<MovingPoint>& from,
                   const std::vector<MovingPoint>& to,
                   std::size_t i,
                   std::size_t j,
                   const Use& use) const {
        for (const MovingPoint& point : from) {
            std::optional<Miss> nearest;
            for (const MovingPoint& other : to) {
                if (other.kind == point.kind) {
                    const Miss found = miss(i, j, point, other);
                    if (!nearest || std::abs(found.distance) < std::abs(nearest->distance)) {
                        nearest = found;
                    }
                }
            }
            if (nearest) {
                use(*nearest);
            }
        }
    }

    // What a shift of a camera costs, and how many sights say so.
    struct ShiftCost {
        double shift = 0.0;
        double cost = 1.0;
        double count = 0.0;

        bool operator<(const ShiftCost& other) const { return cost < other.cost; }
    };

    // Mean of d^2 / (d^2 + error^2) of one camera against the first `others`, shifted by so much.
    [[nodiscard]] ShiftCost cost_of(std::size_t camera,
                                    double shift,
                                    std::size_t every,
                                    std::size_t others) const {
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t m = 0; m < moments_.size(); m += every) {
            const auto shifted =
                sights_[camera].at(found_.clocks[camera].camera_time(moments_[m]) - shift);
            for (std::size_t other = 0; other < others; ++other) {
                if (other == camera || shifted.empty()) {
                    continue;
                }
                for_pairs(seen(other, moments_[m]), shifted, other, camera, [&](const Miss& miss) {
                    const double square = miss.distance * miss.distance;
                    sum += square / (square + options_.error * options_.error);
                    count += 1.0;
                });
            }
        }
        return {shift, count > 0.0 ? sum / count : 1.0, count};
    }

    // Each camera but the first at all shifts within reach: from there least squares find the rest.
    // At first against those before it, which have their clocks by then. Films that hardly meet
    // agree by chance: a shift counts where half as much is seen as at the others.
    void try_shifts() {
        constexpr int kNearSteps = 10;
        const int steps = static_cast<int>(std::lround(options_.reach / kShiftStep));
        for (std::size_t camera = 1; camera < sights_.size(); ++camera) {
            const auto costs = costs_of(camera, steps, camera);
            const ShiftCost& best = *std::min_element(costs.begin(), costs.end());
            note_rival(camera, costs, best);
            found_.clocks[camera].offset += best.shift;
        }
        // They are nearly right by now: once more against all.
        for (std::size_t camera = 1; sights_.size() > 2 && camera < sights_.size(); ++camera) {
            const auto costs = costs_of(camera, std::min(steps, kNearSteps), sights_.size());
            found_.clocks[camera].offset += std::min_element(costs.begin(), costs.end())->shift;
        }
    }

    // Of all shifts at which half as much is seen as at most of them; at least one.
    [[nodiscard]] std::vector<ShiftCost> costs_of(std::size_t camera,
                                                  int reach,
                                                  std::size_t others) const {
        constexpr std::size_t kTriedMoments = 200;
        const std::size_t every = std::max<std::size_t>(1, moments_.size() / kTriedMoments);
        std::vector<ShiftCost> costs;
        double most = 0.0;
        for (int step = -reach; step <= reach; ++step) {
            costs.push_back(cost_of(camera, kShiftStep * step, every, others));
            most = std::max(most, costs.back().count);
        }
        costs.erase(
            std::remove_if(costs.begin(),
                           costs.end(),
                           [most](const ShiftCost& cost) { return cost.count < 0.5 * most; }),
            costs.end());
        return costs;
    }

    // A shift that stands out nearly as much: a dance that repeats itself is there again.
    void note_rival(std::size_t camera,
                    const std::vector<ShiftCost>& costs,
                    const ShiftCost& best) {
        constexpr double kApart = 0.3;         // seconds
        constexpr double kNearlyAsMuch = 0.3;  // of how much the best stands out
        std::vector<double> usual;
        const ShiftCost* rival = nullptr;
        for (const ShiftCost& cost : costs) {
            usual.push_back(cost.cost);
            const bool is_apart = std::abs(cost.shift - best.shift) > kApart;
            rival = is_apart && (rival == nullptr || cost < *rival) ? &cost : rival;
        }
        std::nth_element(usual.begin(),
                         usual.begin() + static_cast<std::ptrdiff_t>(usual.size() / 2),
                         usual.end());
        const double outstanding = usual[usual.size() / 2] - best.cost;
        if (rival != nullptr && rival->cost - best.cost < kNearlyAsMuch * outstanding) {
            const double offset = found_.clocks[camera].offset;
            found_.rivals.push_back({camera, offset + best.shift, offset + rival->shift});
        }
    }

    // One of Gauss' and Newton's steps over offsets (at the middle of the take) and drifts of all
    // cameras but the first. False: nothing to see.
    bool step() {
        const auto size = static_cast<Eigen::Index>(2 * (sights_.size() - 1));
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
        Eigen::VectorXd vector = Eigen::VectorXd::Zero(size);
        std::vector<double> distances;
        double weighted = 0.0;
        double weights = 0.0;
        for (const double moment : moments_) {
            std::vector<std::vector<MovingPoint>> all;
            for (std::size_t i = 0; i < sights_.size(); ++i) {
                all.push_back(seen(i, moment));
            }
            for (std::size_t i = 0; i < sights_.size(); ++i) {
                for (std::size_t j = 0; j < sights_.size(); ++j) {
                    if (i == j) {
                        continue;
                    }
                    for_pairs(all[i], all[j], i, j, [&](const Miss& miss) {
                        const double off = miss.distance / options_.error;
                        const double weight = 1.0 / ((1.0 + off * off) * (1.0 + off * off));
                        add(i, j, moment - middle_, miss, weight, matrix, vector);
                        distances.push_back(std::abs(miss.distance));
                        weighted += weight * miss.distance * miss.distance;
                        weights += weight;
                    });
                }
            }
        }
        if (distances.empty()) {
            return false;
        }
        hold_drifts(matrix);
        const Eigen::LDLT<Eigen::MatrixXd> solver(matrix);
        const Eigen::VectorXd change = -solver.solve(vector);
        if (!change.allFinite()) {
            return false;
        }
        const Eigen::MatrixXd spread = solver.solve(Eigen::MatrixXd::Identity(size, size));
        found_.deviation.assign(sights_.size(), 0.0);
        for (std::size_t i = 1; i < sights_.size(); ++i) {
            const auto at = static_cast<Eigen::Index>(2 * (i - 1));
            move(i, std::clamp(change(at), -kMostStep, kMostStep), change(at + 1));
            found_.deviation[i] = std::sqrt(std::max(0.0, spread(at, at) * weighted / weights));
        }
        const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
        std::nth_element(distances.begin(), middle, distances.end());
        found_.distance = *middle;
        found_.points = distances.size();
        return true;
    }

    // A clock that is later by x shows what happened x before: sights change by - velocity x.
    void add(std::size_t i,
             std::size_t j,
             double time,
             const Miss& miss,
             double weight,
             Eigen::MatrixXd& matrix,
             Eigen::VectorXd& vector) const {
        std::array<std::pair<Eigen::Index, double>, 4> terms{};
        std::size_t count = 0;
        for (const auto& [camera, slope] :
             {std::pair(i, -miss.by_from), std::pair(j, -miss.by_to)}) {
            if (camera > 0) {
                const auto at = static_cast<Eigen::Index>(2 * (camera - 1));
                terms[count++] = {at, slope};
                terms[count++] = {at + 1, slope * time};
            }
        }
        for (std::size_t a = 0; a < count; ++a) {
            vector(terms[a].first) += weight * terms[a].second * miss.distance;
            for (std::size_t b = 0; b < count; ++b) {
                matrix(terms[a].first, terms[b].first) +=
                    weight * terms[a].second * terms[b].second;
            }
        }
    }

    // Clocks of phones drift by some 30 parts in a million: of a short take their own does not tell
    // more than that.
    void hold_drifts(Eigen::MatrixXd& matrix) const {
        constexpr double kUsualDrift = 30e-6;
        const double error = options_.error * options_.error;
        for (Eigen::Index at = 1; at < matrix.rows(); at += 2) {
            matrix(at, at) += options_.fits_drift ? error / (kUsualDrift * kUsualDrift) : 1e30;
        }
    }

    void move(std::size_t camera, double shift, double drift) {
        Clock& clock = found_.clocks[camera];
        // Drift turns about the middle of the take: there the clock moves by the shift alone.
        const double camera_middle = clock.camera_time(middle_);
        clock.offset += shift;
        if (options_.fits_drift) {
            clock.drift_ppm += 1e6 * drift;
            clock.offset -= drift * camera_middle;
        }
    }

    const Rig& rig_;
    const std::vector<MovingSights>& sights_;
    const MotionSyncOptions& options_;
    std::vector<double> moments_;  // capture times
    std::vector<glm::dmat3> lines_;
    double middle_ = 0.0;
    MotionSync found_;
};

}  // namespace

MovingSights::MovingSights(const KeypointFilm& film, const Lens& lens) {
    for (std::size_t i = 0; i + 1 < film.pictures.size(); ++i) {
        const KeypointPicture& now = film.pictures[i];
        const KeypointPicture& next = film.pictures[i + 1];
        Step step{now.time, next.time - now.time, {}};
        for (const BodyPoint point : kMainPoints) {
            if (now[point].visibility >= kSureJoint && next[point].visibility >= kSureJoint &&
                step.seconds < kLongestPictureStep) {
                step.points.push_back(moving(static_cast<std::size_t>(point),
                                             direction_of(lens, now[point].pixel),
                                             direction_of(lens, next[point].pixel),
                                             step.seconds));
            }
        }
        steps_.push_back(std::move(step));
    }
    if (!film.pictures.empty()) {
        first_ = film.pictures.front().time;
        last_ = film.pictures.back().time;
    }
}

MovingSights::MovingSights(const SeenFilm& film, const Lens& lens, double reach) {
    const auto nearest = [reach](const Detection& spot, const SeenPicture& picture) {
        std::optional<std::size_t> found;
        double least = reach;
        for (std::size_t i = 0; i < picture.detections.size(); ++i) {
            const double away = glm::distance(spot.pixel, picture.detections[i].pixel);
            if (picture.detections[i].colour == spot.colour && away < least) {
                least = away;
                found = i;
            }
        }
        return found;
    };
    for (std::size_t i = 0; i + 1 < film.pictures.size(); ++i) {
        const SeenPicture& now = film.pictures[i];
        const SeenPicture& next = film.pictures[i + 1];
        Step step{now.time, next.time - now.time, {}};
        for (std::size_t spot = 0; spot < now.detections.size(); ++spot) {
            const auto there = nearest(now.detections[spot], next);
            const bool is_same = there && step.seconds < kLongestPictureStep &&
                                 nearest(next.detections[*there], now) == spot;
            if (is_same) {
                step.points.push_back(moving(now.detections[spot].colour,
                                             direction_of(lens, now.detections[spot].pixel),
                                             direction_of(lens, next.detections[*there].pixel),
                                             step.seconds));
            }
        }
        steps_.push_back(std::move(step));
    }
    if (!film.pictures.empty()) {
        first_ = film.pictures.front().time;
        last_ = film.pictures.back().time;
    }
}

std::vector<MovingPoint> MovingSights::at(double camera_time) const {
    const auto after = std::upper_bound(
        steps_.begin(), steps_.end(), camera_time, [](double time, const Step& step) {
            return time < step.time;
        });
    if (after == steps_.begin()) {
        return {};
    }
    const Step& step = *(after - 1);
    const double since = camera_time - step.time;
    if (since > step.seconds) {
        return {};
    }
    std::vector<MovingPoint> points = step.points;
    for (MovingPoint& point : points) {
        point.direction += since * point.velocity;
    }
    return points;
}

Expected<MotionSync> sync_by_motion(const Rig& rig,
                                    const std::vector<MovingSights>& sights,
                                    const std::vector<Clock>& start,
                                    const MotionSyncOptions& options) {
    if (sights.size() < 2 || sights.size() != rig.cameras.size() || start.size() != sights.size()) {
        return fail("clocks are told from two cameras or more, each with a place and a clock");
    }
    return ClockSearch(rig, sights, start, options).run();
}

}  // namespace raks::capture
