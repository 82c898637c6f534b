#include "motion/capture/calibration/rig_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include "motion/capture/camera/rotation.hpp"

namespace raks::capture {

namespace {

constexpr int kLensSize = 12;  // fx fy cx cy, then the distortion
constexpr int kPoseSize = 6;   // rotation vector, translation

// Distance of a corner from where it was seen: the model of camera.hpp, for numbers that carry
// their derivatives.
struct CornerMiss {
    glm::dvec2 place;  // on the board
    glm::dvec2 pixel;

    template <typename T>
    bool operator()(const T* lens, const T* camera, const T* board, T* miss) const {
        const T on_board[3] = {T(place.x), T(place.y), T(0.0)};
        T world[3];
        ceres::AngleAxisRotatePoint(board, on_board, world);
        for (int i = 0; i < 3; ++i) {
            world[i] += board[3 + i];
        }
        T p[3];
        ceres::AngleAxisRotatePoint(camera, world, p);
        for (int i = 0; i < 3; ++i) {
            p[i] += camera[3 + i];
        }
        const T x = p[0] / p[2];
        const T y = p[1] / p[2];
        const T r2 = x * x + y * y;
        const T* const k = lens + 4;
        const T radial = (1.0 + r2 * (k[0] + r2 * (k[1] + r2 * k[4]))) /
                         (1.0 + r2 * (k[5] + r2 * (k[6] + r2 * k[7])));
        const T u = x * radial + 2.0 * k[2] * x * y + k[3] * (r2 + 2.0 * x * x);
        const T v = y * radial + k[2] * (r2 + 2.0 * y * y) + 2.0 * k[3] * x * y;
        miss[0] = lens[0] * u + lens[2] - pixel.x;
        miss[1] = lens[1] * v + lens[3] - pixel.y;
        return true;
    }
};

// The numbers that are adjusted, one after the other in one array: Ceres orders its blocks by their
// addresses, and sums in that order.
class Unknowns {
 public:
    Unknowns(const Rig& rig, const BoardPlaces& places) : cameras_(rig.cameras.size()) {
        numbers_.reserve(cameras_ * (kLensSize + kPoseSize) + places.size() * kPoseSize);
        for (const Camera& camera : rig.cameras) {
            const Lens& lens = camera.lens;
            numbers_.insert(numbers_.end(), {lens.fx, lens.fy, lens.cx, lens.cy});
            numbers_.insert(numbers_.end(), lens.distortion.begin(), lens.distortion.end());
            add(pose_of(camera));
        }
        for (const auto& [moment, place] : places) {
            boards_.emplace(moment, boards_.size());
            add(place);
        }
    }

    [[nodiscard]] std::size_t cameras() const noexcept { return cameras_; }
    [[nodiscard]] std::size_t boards() const noexcept { return boards_.size(); }
    [[nodiscard]] double* lens(std::size_t camera) noexcept {
        return numbers_.data() + camera * (kLensSize + kPoseSize);
    }
    [[nodiscard]] double* pose(std::size_t camera) noexcept { return lens(camera) + kLensSize; }
    [[nodiscard]] double* board(std::size_t index) noexcept {
        return lens(cameras_) + index * kPoseSize;
    }
    // Null: the board has no place at this moment.
    [[nodiscard]] double* board_at(std::size_t moment) noexcept {
        const auto found = boards_.find(moment);
        return found == boards_.end() ? nullptr : board(found->second);
    }

    // False: a number is not finite, or a focal length not positive.
    bool give(Rig& rig, BoardPlaces& places) {
        if (!std::all_of(
                numbers_.begin(), numbers_.end(), [](double v) { return std::isfinite(v); })) {
            return false;
        }
        for (std::size_t i = 0; i < cameras_; ++i) {
            const double* const values = lens(i);
            Lens& adjusted = rig.cameras[i].lens;
            adjusted.fx = values[0];
            adjusted.fy = values[1];
            adjusted.cx = values[2];
            adjusted.cy = values[3];
            std::copy(values + 4, values + kLensSize, adjusted.distortion.begin());
            if (!(adjusted.fx > 0.0) || !(adjusted.fy > 0.0)) {
                return false;
            }
            set_pose(rig.cameras[i], motion_at(pose(i)));
        }
        for (auto& [moment, place] : places) {
            place = motion_at(board_at(moment));
        }
        return true;
    }

 private:
    void add(const RigidMotion& motion) {
        const glm::dvec3 turn = rotation_vector(motion.rotation);
        const glm::dvec3& shift = motion.translation;
        numbers_.insert(numbers_.end(), {turn.x, turn.y, turn.z, shift.x, shift.y, shift.z});
    }
    static RigidMotion motion_at(const double* v) noexcept {
        return {rotation_of({v[0], v[1], v[2]}), {v[3], v[4], v[5]}};
    }

    std::size_t cameras_;
    std::map<std::size_t, std::size_t> boards_;  // moment -> index
    std::vector<double> numbers_;
};

// Which numbers of cameras stay as they are.
void hold_fast(ceres::Problem& problem, Unknowns& unknowns, LensFreedom freedom) {
    for (std::size_t i = 0; i < unknowns.cameras(); ++i) {
        double* const lens = unknowns.lens(i);
        if (!problem.HasParameterBlock(lens)) {
            continue;
        }
        if (freedom == LensFreedom::fixed) {
            problem.SetParameterBlockConstant(lens);
        } else if (freedom == LensFreedom::five) {
            problem.SetManifold(lens, new ceres::SubsetManifold(kLensSize, {9, 10, 11}));
        }
    }
    if (problem.HasParameterBlock(unknowns.pose(0))) {
        problem.SetParameterBlockConstant(unknowns.pose(0));
    }
}

ceres::Solver::Options options_for(Unknowns& unknowns, const ceres::Problem& problem) {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_SCHUR;
    options.num_threads = 1;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-9;
    options.logging_type = ceres::SILENT;
    // Boards, of which there are many, are eliminated first.
    auto ordering = std::make_shared<ceres::ParameterBlockOrdering>();
    const auto add = [&](double* block, int group) {
        if (problem.HasParameterBlock(block)) {
            ordering->AddElementToGroup(block, group);
        }
    };
    for (std::size_t i = 0; i < unknowns.boards(); ++i) {
        add(unknowns.board(i), 0);
    }
    for (std::size_t i = 0; i < unknowns.cameras(); ++i) {
        add(unknowns.pose(i), 1);
        add(unknowns.lens(i), 1);
    }
    options.linear_solver_ordering = ordering;
    return options;
}

void measure(const Rig& rig,
             const BoardPlaces& places,
             const Board& board,
             const std::vector<Sighting>& sightings,
             Adjustment& adjustment) {
    std::vector<double> sums(rig.cameras.size(), 0.0);
    std::vector<double> counts(rig.cameras.size(), 0.0);
    for (const Sighting& sighting : sightings) {
        const auto place = places.find(sighting.moment);
        if (place == places.end()) {
            continue;
        }
        const Camera& camera = rig.cameras[sighting.camera];
        const double rms = reprojection_rms(
            camera.lens, board, pose_of(camera).after(place->second), sighting.corners);
        const auto corners = static_cast<double>(sighting.corners.size());
        sums[sighting.camera] += rms * rms * corners;
        counts[sighting.camera] += corners;
    }
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        adjustment.camera_rms.push_back(counts[i] > 0.0 ? std::sqrt(sums[i] / counts[i]) : 0.0);
        sum += sums[i];
        count += counts[i];
    }
    adjustment.rms = count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace

Expected<Adjustment> adjust_rig(Rig& rig,
                                BoardPlaces& places,
                                const Board& board,
                                const std::vector<Sighting>& sightings,
                                LensFreedom freedom) {
    Unknowns unknowns(rig, places);
    ceres::SoftLOneLoss loss(1.0);
    ceres::Problem::Options ownership;
    ownership.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    ceres::Problem problem(ownership);
    for (const Sighting& sighting : sightings) {
        double* const place = unknowns.board_at(sighting.moment);
        if (place == nullptr) {
            continue;
        }
        for (const BoardCorner& corner : sighting.corners) {
            auto* const miss = new CornerMiss{corner_place(board, corner.corner), corner.pixel};
            problem.AddResidualBlock(
                new ceres::AutoDiffCostFunction<CornerMiss, 2, kLensSize, kPoseSize, kPoseSize>(
                    miss),
                &loss,
                unknowns.lens(sighting.camera),
                unknowns.pose(sighting.camera),
                place);
        }
    }
    if (problem.NumResidualBlocks() == 0) {
        return fail("the cameras saw no board");
    }
    hold_fast(problem, unknowns, freedom);
    ceres::Solver::Summary summary;
    ceres::Solve(options_for(unknowns, problem), &problem, &summary);
    if (!summary.IsSolutionUsable() || !unknowns.give(rig, places)) {
        return fail(
            "the views of the board contradict one another: are the films in sync, and did "
            "the cameras stand still?");
    }
    Adjustment adjustment;
    adjustment.rounds = static_cast<int>(summary.iterations.size());
    measure(rig, places, board, sightings, adjustment);
    return adjustment;
}

}  // namespace raks::capture
