#include "apps/raks_capture/solve_figures.hpp"

#include <cmath>

#include "base/json.hpp"
#include "motion/choreography/joint_limits.hpp"

namespace raks::apps {
namespace {

using Figures = Json;

constexpr double kMillimetres = 1000.0;  // in a metre

Figures markers_json(const capture::SolvedDance& dance) {
    Figures markers = Figures::array();
    for (const capture::MarkerFit& marker : dance.markers) {
        markers.push_back({{"name", marker.name},
                           {"seen", marker.seen},
                           {"difference_mm", kMillimetres * marker.difference},
                           {"shift_mm",
                            {kMillimetres * marker.shift.x,
                             kMillimetres * marker.shift.y,
                             kMillimetres * marker.shift.z}}});
    }
    return markers;
}

double residual_of(const capture::SolvedDance& dance) {
    double squares = 0.0;
    for (const capture::MarkerFit& marker : dance.markers) {
        squares += marker.difference * marker.difference;
    }
    return std::sqrt(squares / static_cast<double>(dance.markers.size()));
}

Figures limits_json(const capture::SolvedDance& dance) {
    std::size_t beyond = 0;
    motion::JointExcess worst;
    bool is_any = false;
    for (const motion::Pose& pose : dance.poses) {
        const auto excess = motion::worst_joint(pose);
        if (!excess) {
            continue;
        }
        ++beyond;
        if (!is_any || excess->beyond() > worst.beyond()) {
            worst = *excess;
            is_any = true;
        }
    }
    Figures limits = {
        {"frames_beyond", static_cast<double>(beyond) / static_cast<double>(dance.poses.size())}};
    if (is_any) {
        limits["worst_joint"] = worst.joint;
        limits["worst_degrees"] = worst.beyond();
    }
    return limits;
}

Figures foot_json(const FootFacts& foot) {
    return {{"planted", foot.planted},
            {"median_m_s", foot.median},
            {"ninety_m_s", foot.ninety},
            {"lowest_mm", kMillimetres * foot.lowest}};
}

}  // namespace

std::string solve_json(const capture::SolvedDance& dance, const std::optional<BodyFacts>& body) {
    Figures document = {
        {"format", "raks-solve"},
        {"version", 1},
        {"seconds", static_cast<double>(dance.poses.size()) / dance.frames_per_second},
        {"frames_per_second", dance.frames_per_second},
        {"first_time", dance.first_time},
        {"height_m", capture::kMannequinHeight * dance.size.whole},
        {"residual_mm", kMillimetres * residual_of(dance)}};
    if (body) {
        Figures bones = Figures::array();
        for (const BoneLength& bone : body->lengths) {
            bones.push_back({{"name", bone.name}, {"left_m", bone.left}, {"right_m", bone.right}});
        }
        document["bones"] = bones;
        document["feet"] = {{"left", foot_json(body->left)}, {"right", foot_json(body->right)}};
    }
    document["limits"] = limits_json(dance);
    document["markers"] = markers_json(dance);
    Figures doubts = Figures::array();
    for (const capture::SolveDoubt& doubt : dance.doubts) {
        doubts.push_back({{"what", doubt.what}, {"first", doubt.first}, {"last", doubt.last}});
    }
    document["doubts"] = doubts;
    return document.text(2) + "\n";
}

}  // namespace raks::apps
