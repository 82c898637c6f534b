// Calibration by the dancer alone, and a body solved from keypoints, against what is known.
#include "motion/capture/calibration/dancer_calibration.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/capture/markerless/keypoint_markers.hpp"
#include "motion/capture/markerless/keypoint_tracks.hpp"
#include "motion/capture/solving/solve.hpp"
#include "motion/evaluate/body_track.hpp"
#include "tests/motion/capture/markerless/keypoint_scene.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

std::vector<DancerCamera> cameras_of(const Rig& rig, bool has_lenses) {
    std::vector<DancerCamera> cameras;
    for (const Camera& camera : rig.cameras) {
        cameras.push_back({camera.name, camera.lens.width, camera.lens.height, std::nullopt});
        if (has_lenses) {
            cameras.back().lens = camera.lens;
        }
    }
    return cameras;
}

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180.0 / M_PI;
}

TEST(DancerCalibration, report) {
    const char* clip = std::getenv("CLIP");
    const char* f = std::getenv("FOCAL");
    const char* sd = std::getenv("SEED");
    const char* ang = std::getenv("ANGLE");
    const bool known = std::getenv("KNOWN") != nullptr;
    auto dance = clip ? *test::dance_of(clip, 12.0) : test::written_dance("rock", 0, 12.0);
    const double focal = f ? atof(f) : 1559.0;
    Rig rig = test::ring({0.0, ang ? atof(ang) : 90.0}, 4.3, focal, f ? 720 : 720);
    test::NetworkErrors errors;
    errors.pixels *= focal / 1559;
    if (std::getenv("PX")) errors.pixels = atof(std::getenv("PX"));
    if (std::getenv("JT")) errors.joints = atof(std::getenv("JT"));
    errors.seed = sd ? atoi(sd) : 1;
    auto clocks = test::true_clocks(rig);
    auto films = test::filmed(dance, rig, clocks, errors);
    auto take = keypoint_take(films, clocks, 30.0);
    ASSERT_TRUE(take) << take.error().message;
    auto done = calibrate_by_dancer(*take, cameras_of(rig, known), kMannequinHeight);
    ASSERT_TRUE(done) << done.error().message;
    for (auto& p : done->pairs)
        printf("pair %zu %zu angle %.1f agree %.2f\n", p.from, p.to, p.angle, p.agreeing);
    // relative rotation
    auto rel = [](const Rig& r) {
        return r.cameras[1].rotation * glm::transpose(r.cameras[0].rotation);
    };
    glm::dmat3 d = rel(done->rig) * glm::transpose(rel(rig));
    printf("relative rotation off %.2f deg; cost %.1f\n",
           std::acos((d[0][0] + d[1][1] + d[2][2] - 1) / 2) * 180 / M_PI,
           done->adjusted.cost);
    for (int i = 0; i < 2; ++i) {
        auto up = done->rig.cameras[i].rotation * glm::dvec3(0, 1, 0);
        auto tr = rig.cameras[i].rotation * glm::dvec3(0, 1, 0);
        auto c = done->rig.cameras[i].centre();
        printf("cam %d f %.0f up off %.2f deg, at %.2f %.2f %.2f dist %.3f rms %.1f\n",
               i,
               done->rig.cameras[i].lens.fx,
               degrees_between(up, tr),
               c.x,
               c.y,
               c.z,
               glm::length(glm::dvec2(c.x, c.z)),
               done->adjusted.camera_rms[i]);
    }
    printf("floor steps %zu spread %.3f disagreement %.2f baseline %.3f true %.3f\n",
           done->floor.steps,
           done->floor.spread,
           done->floor.disagreement,
           glm::distance(done->rig.cameras[0].centre(), done->rig.cameras[1].centre()),
           glm::distance(rig.cameras[0].centre(), rig.cameras[1].centre()));
    std::vector<double> errs{usual_error(*take, 0), usual_error(*take, 1)};
    printf("errors %.1f %.1f\n", errs[0], errs[1]);
    for (size_t i = 0; i < kLimbLengths; ++i)
        printf("L%zu %.3f ",
               i,
               done->adjusted.lengths[i] / (limb_lengths()[i].of_height * kMannequinHeight));
    printf("\n");
    if (std::getenv("NOSOLVE")) return;
    Tracks tracks = keypoint_tracks(done->rig, *take, errs);
    for (size_t i = 0; i < tracks.flags.size() && i < 5; ++i)
        printf("flag %d %s %zu %zu\n",
               int(tracks.flags[i].doubt),
               tracks.markers[tracks.flags[i].marker].c_str(),
               tracks.flags[i].first,
               tracks.flags[i].last);
    printf("%zu flags\n", tracks.flags.size());
    SolveOptions options;
    options.height = kMannequinHeight;
    options.frames_per_second = 60.0;
    options.marker_deviation = 0.03;
    auto solved = solve(tracks, keypoint_markers(), options);
    ASSERT_TRUE(solved) << solved.error().message;
    auto is = motion::body_track(dance.skeleton, dance.poses, 60.0);
    auto got = motion::body_track(solved->skeleton, solved->poses, 60.0);
    // distance between hips-relative after yaw: align by all joints
    size_t n = std::min(is.frames(), got.frames());
    glm::dvec3 ma{}, mb{};
    double cnt = 0;
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < 19; ++j) {
            ma += is.joints[k][j];
            mb += got.joints[k][j];
            cnt += 1;
        }
    ma /= cnt;
    mb /= cnt;
    double s = 0, c = 0;
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < 19; ++j) {
            auto a = is.joints[k][j] - ma, b = got.joints[k][j] - mb;
            c += a.x * b.x + a.z * b.z;
            s += b.z * a.x - b.x * a.z;
        }
    double th = std::atan2(s, c);
    double sum = 0;
    std::array<double, 19> by{};
    for (size_t k = 0; k < n; ++k)
        for (size_t j = 0; j < 19; ++j) {
            auto b = got.joints[k][j] - mb;
            glm::dvec3 r(c * b.x + s * b.z, 0, -s * b.x + c * b.z);
            r.x /= std::hypot(s, c);
            r.z /= std::hypot(s, c);
            r.y = b.y;
            double dd = glm::distance(r, is.joints[k][j] - ma);
            sum += dd;
            by[j] += dd;
        }
    printf("yaw %.1f joints mean %.1f mm, height offset %.1f mm, size %.3f\n",
           th * 180 / M_PI,
           1000 * sum / cnt,
           1000 * (mb.y - ma.y),
           solved->size.whole);
    for (size_t j = 0; j < 19; ++j)
        printf("%s %.0f  ",
               std::string(motion::kBoneNames[index_of(motion::kBodyBones[j])]).c_str(),
               1000 * by[j] / n);
    printf("\n");
}

}  // namespace
}  // namespace raks::capture
