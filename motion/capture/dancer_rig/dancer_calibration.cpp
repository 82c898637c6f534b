#include "motion/capture/dancer_rig/dancer_calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "motion/capture/markerless/keypoint_tracks.hpp"
#include "motion/capture/markerless/standing_cameras.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr std::size_t kPairMoments = 400;    // from which pairs are found
constexpr std::size_t kStartMoments = 40;    // from which each start of a pair is fitted
constexpr std::size_t kFittedMoments = 160;  // that all cameras are fitted to
constexpr double kLeastAgreeing = 0.5;       // share of the joints of a pair
constexpr double kFewAgreeing = 0.7;

// Where the second camera of a pair may stand, degrees.
constexpr std::array<double, 6> kStartAngles = {50.0, -50.0, 90.0, -90.0, 140.0, -140.0};

double focal_of(const Lens& lens) { return 0.5 * (lens.fx + lens.fy); }

bool is_well_placed(const CameraPair& pair) {
    return pair.angle >= kLeastPairAngle && pair.angle <= kMostPairAngle &&
           pair.agreeing >= kLeastAgreeing;
}

std::string reason_of(const CameraPair& pair, const std::vector<DancerCamera>& cameras) {
    const std::string names =
        fmt::format("{} and {}", cameras[pair.from].name, cameras[pair.to].name);
    if (pair.angle > kMostPairAngle) {
        return fmt::format(
            "{} stand opposite one another ({:.0f} degrees), where distances cannot be told: put "
            "them 70 to 100 degrees apart, as seen from the dancer",
            names,
            pair.angle);
    }
    if (pair.angle < kLeastPairAngle) {
        return fmt::format(
            "{} stand side by side ({:.0f} degrees), where distances cannot be told: put them 70 "
            "to 100 degrees apart, as seen from the dancer",
            names,
            pair.angle);
    }
    return fmt::format(
        "{} do not see the same dance: only {:.0f} % of the joints agree. Are the films in sync, "
        "of "
        "one take, not mirrored, and did the cameras stand still?",
        names,
        100.0 * pair.agreeing);
}

// One attempt, with lenses that are assumed.
class DancerRig {
 public:
    DancerRig(const KeypointTake& take,
              const std::vector<DancerCamera>& cameras,
              std::vector<double> errors,
              double height)
        : take_(take), cameras_(cameras), errors_(std::move(errors)), height_(height) {}

    Expected<DancerCalibration> calibrate() {
        assume_lenses();
        if (auto placed = place_cameras(); !placed) {
            return fail(std::move(placed.error()));
        }
        const auto moments = dancer_moments(take_, lenses_, kFittedMoments);
        DancerAdjustment how;
        how.height = height_;
        how.errors = errors_;
        for (const DancerCamera& camera : cameras_) {
            how.free_lenses.push_back(!camera.lens);
        }
        auto adjusted = adjust_to_dancer(done_.rig, moments, how);
        if (!adjusted) {
            return fail(std::move(adjusted.error()));
        }
        done_.adjusted = std::move(*adjusted);
        return done_;
    }

 private:
    void assume_lenses() {
        for (const DancerCamera& camera : cameras_) {
            lenses_.push_back(camera.lens.value_or(guessed_lens(camera.width, camera.height)));
            done_.rig.cameras.push_back({camera.name, lenses_.back(), glm::dmat3(1.0), {}});
        }
    }

    void find_pairs() {
        const auto moments = dancer_moments(take_, lenses_, kPairMoments);
        for (std::size_t from = 0; from < cameras_.size(); ++from) {
            for (std::size_t to = from + 1; to < cameras_.size(); ++to) {
                if (const auto pair = best_pair(moments, from, to)) {
                    done_.pairs.push_back(*pair);
                }
            }
        }
    }

    // The pair that explains best what both see, from several starts: the errors of a network lead
    // an essential matrix far astray, and from a wrong side least squares find no way back.
    std::optional<CameraPair> best_pair(const std::vector<DancerMoment>& moments,
                                        std::size_t from,
                                        std::size_t to) const {
        std::vector<double> sizes;
        for (std::size_t i = 0; i < cameras_.size(); ++i) {
            sizes.push_back(body_size(errors_[i]) / focal_of(lenses_[i]));
        }
        const double error =
            0.5 * (errors_[from] / focal_of(lenses_[from]) + errors_[to] / focal_of(lenses_[to]));
        const auto found = find_pair(moments, from, to, error, height_);
        if (!found) {
            return std::nullopt;
        }
        std::vector<CameraPair> starts = {*found};
        for (const double angle : kStartAngles) {
            starts.push_back(guess_pair(moments, from, to, angle, sizes, height_));
        }
        const auto few = two_cameras(dancer_moments(take_, lenses_, kStartMoments), from, to);
        std::optional<CameraPair> best;
        double least = 0.0;
        for (const CameraPair& start : starts) {
            Rig rig{{done_.rig.cameras[from], done_.rig.cameras[to]}};
            rig.cameras[1].rotation = start.rotation;
            rig.cameras[1].translation = start.translation;
            DancerAdjustment how;
            how.height = height_;
            how.errors = {errors_[from], errors_[to]};
            how.free_lenses = {false, false};
            const auto adjusted = adjust_to_dancer(rig, few, how);
            const bool is_body = adjusted && adjusted->knees_ahead > 0.0;
            if (is_body && (!best || adjusted->cost < least)) {
                least = adjusted->cost;
                best = CameraPair{
                    from, to, rig.cameras[1].rotation, rig.cameras[1].translation, 0.0, 0.0, 0};
            }
        }
        if (best) {
            measure_pair(moments, error, *best);
        }
        return best;
    }

    static std::vector<DancerMoment> two_cameras(const std::vector<DancerMoment>& moments,
                                                 std::size_t from,
                                                 std::size_t to) {
        std::vector<DancerMoment> two;
        two.reserve(moments.size());
        for (const DancerMoment& moment : moments) {
            two.push_back({moment[from], moment[to]});
        }
        return two;
    }

    // The error that says which camera hangs on no other one, and why.
    [[nodiscard]] Error lonely(const std::vector<bool>& is_placed) const {
        const CameraPair* best = nullptr;
        for (const CameraPair& pair : done_.pairs) {
            if (is_placed[pair.from] != is_placed[pair.to] &&
                (best == nullptr || pair.agreeing > best->agreeing)) {
                best = &pair;
            }
        }
        if (best != nullptr) {
            return Error{reason_of(*best, cameras_)};
        }
        const auto alone = static_cast<std::size_t>(
            std::find(is_placed.begin(), is_placed.end(), false) - is_placed.begin());
        return Error{fmt::format(
            "{} sees hardly anything of the dancer that another camera sees at the same time; the "
            "whole body must be in view of two cameras, and the films in sync",
            cameras_[alone].name)};
    }

    // Each camera by the pair that agrees best with one that stands already.
    Expected<void> place_cameras() {
        find_pairs();
        std::vector<bool> is_placed(cameras_.size(), false);
        is_placed[0] = true;
        for (std::size_t round = 1; round < cameras_.size(); ++round) {
            const CameraPair* best = nullptr;
            for (const CameraPair& pair : done_.pairs) {
                if (is_placed[pair.from] != is_placed[pair.to] && is_well_placed(pair) &&
                    (best == nullptr || pair.agreeing > best->agreeing)) {
                    best = &pair;
                }
            }
            if (best == nullptr) {
                return fail(lonely(is_placed));
            }
            place_by(*best, is_placed[best->from]);
            is_placed[best->from] = is_placed[best->to] = true;
        }
        return {};
    }

    void place_by(const CameraPair& pair, bool is_from_placed) {
        Camera& from = done_.rig.cameras[pair.from];
        Camera& to = done_.rig.cameras[pair.to];
        if (is_from_placed) {
            to.rotation = pair.rotation * from.rotation;
            to.translation = pair.rotation * from.translation + pair.translation;
        } else {
            const glm::dmat3 back = glm::transpose(pair.rotation);
            from.rotation = back * to.rotation;
            from.translation = back * (to.translation - pair.translation);
        }
    }

    const KeypointTake& take_;
    const std::vector<DancerCamera>& cameras_;
    std::vector<double> errors_;
    double height_;
    std::vector<Lens> lenses_;
    DancerCalibration done_;
};

// Where the adjusted cameras stand must still be good.
Expected<void> check_angles(const DancerCalibration& done,
                            const std::vector<DancerCamera>& cameras,
                            const glm::dvec3& dancer) {
    CameraPair worst;
    bool is_any_good = false;
    for (std::size_t from = 0; from < cameras.size(); ++from) {
        for (std::size_t to = from + 1; to < cameras.size(); ++to) {
            const double angle = angle_at(done.rig.cameras[from], done.rig.cameras[to], dancer);
            is_any_good = is_any_good || (angle >= kLeastPairAngle && angle <= kMostPairAngle);
            worst = CameraPair{from, to, glm::dmat3(1.0), {}, angle, 1.0, 0};
        }
    }
    return is_any_good ? Expected<void>() : fail(reason_of(worst, cameras));
}

void doubt(const std::vector<DancerCamera>& cameras, DancerCalibration& done) {
    for (const CameraPair& pair : done.pairs) {
        if (is_well_placed(pair) && pair.agreeing < kFewAgreeing) {
            done.doubts.push_back(
                fmt::format("{} and {}: only {:.0f} % of the joints agree; are the films in sync, "
                            "and did the cameras stand still?",
                            cameras[pair.from].name,
                            cameras[pair.to].name,
                            100.0 * pair.agreeing));
        }
    }
    constexpr double kLargeDisagreement = 8.0;  // degrees
    if (done.floor.disagreement > kLargeDisagreement) {
        done.doubts.push_back(
            fmt::format("the floor by the feet leans by {:.0f} degrees against the dancer: is it "
                        "level, and are the feet in view?",
                        done.floor.disagreement));
    }
}

}  // namespace

Lens guessed_lens(int width, int height) {
    Lens lens;
    lens.width = width;
    lens.height = height;
    lens.fx = lens.fy =
        0.5 * static_cast<double>(std::max(width, height)) / std::tan(kGuessedView * M_PI / 360.0);
    lens.cx = 0.5 * (static_cast<double>(width) - 1.0);
    lens.cy = 0.5 * (static_cast<double>(height) - 1.0);
    return lens;
}

Expected<DancerCalibration> calibrate_by_dancer(const KeypointTake& take,
                                                const std::vector<DancerCamera>& cameras,
                                                double height) {
    std::vector<double> errors;
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        errors.push_back(usual_error(take, i));
        if (!(errors.back() > 0.0)) {
            return fail(
                fmt::format("{}: no whole body is visible in it: nose and both ankles must "
                            "be in view",
                            cameras[i].name));
        }
    }
    Expected<DancerCalibration> best = DancerRig(take, cameras, errors, height).calibrate();
    if (!best) {
        return best;
    }
    const Tracks tracks = keypoint_tracks(best->rig, take, errors);
    auto floor = put_on_dancers_floor(best->rig, tracks, height);
    if (!floor) {
        return fail(std::move(floor.error()));
    }
    best->floor = *floor;
    constexpr double kTrunkHeight = 1.0;  // metres
    if (auto checked = check_angles(*best, cameras, {0.0, kTrunkHeight, 0.0}); !checked) {
        return fail(std::move(checked.error()));
    }
    doubt(cameras, *best);
    std::vector<bool> are_still;
    are_still.reserve(cameras.size());
    for (const DancerCamera& camera : cameras) {
        are_still.push_back(camera.is_surely_still);
    }
    for (std::string& line : standing_doubts(best->rig, take, are_still)) {
        best->doubts.push_back(std::move(line));
    }
    return best;
}

}  // namespace raks::capture
