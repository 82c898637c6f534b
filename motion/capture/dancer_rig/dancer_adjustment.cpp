#include "motion/capture/dancer_rig/dancer_adjustment.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include "motion/capture/camera/rotation.hpp"
#include "motion/capture/triangulation/triangulation.hpp"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace raks::capture {
namespace {

constexpr int kPose = 6;  // rotation vector, translation
// Of the logarithm of a guessed focal length. Phones film within 50 to 70 degrees, but a network's
// errors seem to shorten it, and a wrong one hardly changes the dance: so it is held tight.
constexpr double kFocalDeviation = 0.06;
constexpr int kMostRounds = 60;

// Distance of a joint from where it was seen. A lens is the logarithm of its focal length over the
// one that the direction was taken by.
struct JointMiss {
    glm::dvec2 direction;
    double focal;   // pixels
    double weight;  // 1 / pixels

    template <typename T>
    bool operator()(const T* lens, const T* camera, const T* joint, T* miss) const {
        T p[3];
        ceres::AngleAxisRotatePoint(camera, joint, p);
        for (int i = 0; i < 3; ++i) {
            p[i] += camera[3 + i];
        }
        const T scale = ceres::exp(lens[0]);
        miss[0] = (scale * p[0] / p[2] - direction.x) * focal * weight;
        miss[1] = (scale * p[1] / p[2] - direction.y) * focal * weight;
        return true;
    }
};

// By how much two joints are not as far apart as the limb is long.
struct LimbMiss {
    double bends;

    template <typename T>
    bool operator()(const T* from, const T* to, const T* length, T* miss) const {
        const T d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
        const T far = ceres::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + 1e-9);
        miss[0] = (far * ceres::exp(-length[0]) - 1.0) / bends;
        return true;
    }
};

// How unusual a number is.
struct Unusual {
    double usual;
    double deviation;

    template <typename T>
    bool operator()(const T* number, T* miss) const {
        miss[0] = (number[0] - usual) / deviation;
        return true;
    }
};

// Numbers and residuals of the problem.
class DancerProblem {
 public:
    DancerProblem(const Rig& rig,
                  const std::vector<DancerMoment>& moments,
                  const DancerAdjustment& how)
        : moments_(moments), how_(how), cameras_(rig.cameras.size()) {
        for (const Camera& camera : rig.cameras) {
            const glm::dvec3 turn = rotation_vector(camera.rotation);
            const glm::dvec3& shift = camera.translation;
            poses_.insert(poses_.end(), {turn.x, turn.y, turn.z, shift.x, shift.y, shift.z});
            focals_.push_back(0.5 * (camera.lens.fx + camera.lens.fy));
        }
        lenses_.assign(cameras_, 0.0);
        for (const LimbLength& limb : limb_lengths()) {
            lengths_.push_back(std::log(limb.of_height * how.height));
        }
        place_joints(rig);
        add_all();
    }

    bool solve(double& cost) {
        ceres::Solver::Options options;
        options.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
        options.num_threads = 1;
        options.max_num_iterations = kMostRounds;
        options.function_tolerance = 1e-6;
        options.logging_type = ceres::SILENT;
        ceres::Solver::Summary summary;
        ceres::Solve(options, &problem_, &summary);
        cost = summary.final_cost;
        return summary.IsSolutionUsable() &&
               std::all_of(poses_.begin(), poses_.end(), [](double v) { return std::isfinite(v); });
    }

    void give(Rig& rig) const {
        for (std::size_t i = 0; i < cameras_; ++i) {
            const double* const v = poses_.data() + i * kPose;
            Camera& camera = rig.cameras[i];
            camera.rotation = rotation_of({v[0], v[1], v[2]});
            camera.translation = {v[3], v[4], v[5]};
            camera.lens.fx *= std::exp(lenses_[i]);
            camera.lens.fy *= std::exp(lenses_[i]);
        }
    }

    [[nodiscard]] AdjustedDancer result() const {
        AdjustedDancer adjusted;
        for (std::size_t i = 0; i < kLimbLengths; ++i) {
            adjusted.lengths[i] = std::exp(lengths_[i]);
        }
        for (std::size_t camera = 0; camera < cameras_; ++camera) {
            adjusted.camera_rms.push_back(rms_of(camera));
        }
        adjusted.knees_ahead = knees_ahead();
        return adjusted;
    }

 private:
    [[nodiscard]] double* joint_at(std::size_t moment, std::size_t joint) {
        const std::size_t at = joint_of_[moment * kMainPoints.size() + joint];
        return at == kNone ? nullptr : joints_.data() + at * 3;
    }
    [[nodiscard]] const double* joint_at(std::size_t moment, std::size_t joint) const {
        const std::size_t at = joint_of_[moment * kMainPoints.size() + joint];
        return at == kNone ? nullptr : joints_.data() + at * 3;
    }

    // Joints that two cameras see, where these put them.
    void place_joints(const Rig& rig) {
        for (const DancerMoment& moment : moments_) {
            for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
                std::vector<PointView> views;
                for (std::size_t camera = 0; camera < cameras_; ++camera) {
                    if (moment[camera][joint].weight > 0.0) {
                        views.push_back({camera, moment[camera][joint].direction});
                    }
                }
                joint_of_.push_back(views.size() >= 2 ? joints_.size() / 3 : kNone);
                if (views.size() >= 2) {
                    const glm::dvec3 place = joint_near(rig, views);
                    joints_.insert(joints_.end(), {place.x, place.y, place.z});
                }
            }
        }
    }

    // Where the views put a joint; where that cannot be, on the ray of the first of them, at a
    // usual distance: a start must neither lose joints nor have them behind a camera.
    static glm::dvec3 joint_near(const Rig& rig, const std::vector<PointView>& views) {
        constexpr double kNearest = 0.5;        // metres from a camera
        constexpr double kFarthest = 30.0;      // likewise
        constexpr double kUsualDistance = 4.0;  // likewise
        const auto place = triangulate_linear(rig, views);
        const bool is_good =
            place && std::all_of(views.begin(), views.end(), [&](const PointView& view) {
                const double z = rig.cameras[view.camera].in_camera(*place).z;
                return z > kNearest && z < kFarthest;
            });
        if (is_good) {
            return *place;
        }
        const Camera& camera = rig.cameras[views.front().camera];
        const glm::dvec3 ray =
            glm::transpose(camera.rotation) * glm::dvec3(views.front().direction, 1.0);
        return camera.centre() + kUsualDistance * ray;
    }

    void add_all() {
        for (std::size_t moment = 0; moment < moments_.size(); ++moment) {
            add_sights(moment);
            add_limbs(moment);
        }
        for (std::size_t i = 0; i < kLimbLengths; ++i) {
            add_prior(&lengths_[i], lengths_[i], limb_lengths()[i].deviation);
        }
        for (std::size_t i = 0; i < cameras_; ++i) {
            if (!problem_.HasParameterBlock(&lenses_[i])) {
                continue;
            }
            if (how_.free_lenses[i]) {
                add_prior(&lenses_[i], 0.0, kFocalDeviation);
            } else {
                problem_.SetParameterBlockConstant(&lenses_[i]);
            }
        }
        if (problem_.HasParameterBlock(poses_.data())) {
            problem_.SetParameterBlockConstant(poses_.data());
        }
    }

    void add_prior(double* number, double usual, double deviation) {
        problem_.AddResidualBlock(
            new ceres::AutoDiffCostFunction<Unusual, 1, 1>(new Unusual{usual, deviation}),
            nullptr,
            number);
    }

    void add_sights(std::size_t moment) {
        for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
            double* const place = joint_at(moment, joint);
            for (std::size_t camera = 0; place != nullptr && camera < cameras_; ++camera) {
                const JointSight& sight = moments_[moment][camera][joint];
                if (sight.weight > 0.0) {
                    auto* const miss = new JointMiss{
                        sight.direction, focals_[camera], sight.weight / how_.errors[camera]};
                    problem_.AddResidualBlock(
                        new ceres::AutoDiffCostFunction<JointMiss, 2, 1, kPose, 3>(miss),
                        new ceres::SoftLOneLoss(1.0),
                        &lenses_[camera],
                        poses_.data() + camera * kPose,
                        place);
                }
            }
        }
    }

    void add_limbs(std::size_t moment) {
        for (const DancerLimb& limb : dancer_limbs()) {
            double* const from = joint_at(moment, limb.from);
            double* const to = joint_at(moment, limb.to);
            if (from != nullptr && to != nullptr) {
                auto* const miss = new LimbMiss{limb_lengths()[limb.length].bends};
                problem_.AddResidualBlock(
                    new ceres::AutoDiffCostFunction<LimbMiss, 1, 3, 3, 1>(miss),
                    new ceres::SoftLOneLoss(1.0),
                    from,
                    to,
                    &lengths_[limb.length]);
            }
        }
    }

    [[nodiscard]] double rms_of(std::size_t camera) const {
        double squares = 0.0;
        double count = 0.0;
        for (std::size_t moment = 0; moment < moments_.size(); ++moment) {
            for (std::size_t joint = 0; joint < kMainPoints.size(); ++joint) {
                const double* const place = joint_at(moment, joint);
                const JointSight& sight = moments_[moment][camera][joint];
                if (place != nullptr && sight.weight > 0.0) {
                    double miss[2];
                    JointMiss{sight.direction, focals_[camera], 1.0}(
                        &lenses_[camera], poses_.data() + camera * kPose, place, miss);
                    squares += miss[0] * miss[0] + miss[1] * miss[1];
                    count += 1.0;
                }
            }
        }
        return count > 0.0 ? std::sqrt(squares / count) : 0.0;
    }

    [[nodiscard]] double knees_ahead() const {
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t moment = 0; moment < moments_.size(); ++moment) {
            // By kMainPoints: shoulders, hips, knees, ankles, each left, then right.
            std::array<glm::dvec3, 8> at{};
            bool is_whole = true;
            constexpr std::array<std::size_t, 8> kJoints = {0, 1, 6, 7, 8, 9, 10, 11};
            for (std::size_t i = 0; i < kJoints.size(); ++i) {
                const double* const place = joint_at(moment, kJoints[i]);
                is_whole = is_whole && place != nullptr;
                at[i] = place != nullptr ? glm::dvec3(place[0], place[1], place[2]) : glm::dvec3();
            }
            if (is_whole) {
                const glm::dvec3 up = at[0] + at[1] - at[2] - at[3];
                const glm::dvec3 ahead = glm::normalize(glm::cross(at[2] - at[3], up));
                sum += glm::dot(at[4] - 0.5 * (at[2] + at[6]), ahead) +
                       glm::dot(at[5] - 0.5 * (at[3] + at[7]), ahead);
                count += 2.0;
            }
        }
        return count > 0.0 ? sum / count : 0.0;
    }

    static constexpr std::size_t kNone = ~std::size_t{0};

    const std::vector<DancerMoment>& moments_;
    const DancerAdjustment& how_;
    std::size_t cameras_;
    std::vector<double> focals_;         // pixels, where directions were taken by
    std::vector<double> lenses_;         // logarithms of how much longer they are
    std::vector<double> poses_;          // kPose a camera
    std::vector<double> lengths_;        // logarithms of metres
    std::vector<double> joints_;         // metres
    std::vector<std::size_t> joint_of_;  // moments x kMainPoints: index in joints_, or kNone
    ceres::Problem problem_;
};

}  // namespace

Expected<AdjustedDancer> adjust_to_dancer(Rig& rig,
                                          const std::vector<DancerMoment>& moments,
                                          const DancerAdjustment& how) {
    DancerProblem problem(rig, moments, how);
    double cost = 0.0;
    if (!problem.solve(cost)) {
        return fail(
            "the views of the dancer contradict one another: are the films in sync, and did the "
            "cameras stand still?");
    }
    problem.give(rig);
    AdjustedDancer adjusted = problem.result();
    adjusted.cost = cost;
    return adjusted;
}

}  // namespace raks::capture
