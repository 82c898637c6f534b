#include "motion/skeleton/formats/mmd/vmd_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace raks::motion {
namespace {

glm::dquat camera_turn(const glm::dvec3& turn) {
    // The file's turns are about its own axes, whose z is opposite to ours, the other way round:
    // first about z, then about x, then about y.
    return glm::angleAxis(turn.y, glm::dvec3(0.0, 1.0, 0.0)) *
           glm::angleAxis(turn.x, glm::dvec3(1.0, 0.0, 0.0)) *
           glm::angleAxis(-turn.z, glm::dvec3(0.0, 0.0, 1.0));
}

// The frame of a time; one that is all but whole is whole, so that a film of 30 pictures a second
// cuts where the file does.
double frame_at(double seconds) {
    constexpr double kWhole = 0.02;  // of a frame: what times are rounded by
    const double frame = std::max(0.0, seconds * kMmdRate);
    const double whole = std::round(frame);
    return std::abs(frame - whole) < kWhole ? whole : frame;
}

}  // namespace

Expected<MmdCameraPath> MmdCameraPath::parse(std::string_view bytes, std::string_view name) {
    const std::string file(name);
    if (bytes.substr(0, kVmdMark.size()) != kVmdMark) {
        return fail(file + ": is not a VMD, the only kind of file that moves a camera");
    }
    auto read = read_vmd(bytes);
    if (!read) {
        return fail(std::move(read.error()).in(file));
    }
    if (read->camera.empty()) {
        return fail(file + ": moves no camera" +
                    (read->motion.has_body() ? ", but a body; give it as --motion" : ""));
    }
    return MmdCameraPath(std::move(read->camera));
}

MmdView MmdCameraPath::at(double seconds) const {
    const double frame = frame_at(seconds);
    const auto behind = std::upper_bound(
        keys_.begin(), keys_.end(), frame, [](double when, const MmdCameraKey& key) {
            return when < static_cast<double>(key.frame);
        });
    const MmdCameraKey& from = behind == keys_.begin() ? keys_.front() : *std::prev(behind);
    const MmdCameraKey& to = behind == keys_.end() ? keys_.back() : *behind;
    double share = 0.0;
    if (to.frame > from.frame + 1) {
        share =
            std::clamp((frame - from.frame) / static_cast<double>(to.frame - from.frame), 0.0, 1.0);
    }
    std::array<double, 6> way{};
    for (std::size_t channel = 0; channel < way.size(); ++channel) {
        way[channel] = mmd_progress(to.curves[channel], share);
    }
    MmdView view;
    for (int axis = 0; axis < 3; ++axis) {
        view.target[axis] = std::lerp(static_cast<double>(from.target[axis]),
                                      static_cast<double>(to.target[axis]),
                                      way[static_cast<std::size_t>(axis)]);
    }
    view.turn = camera_turn(glm::mix(glm::dvec3(from.turn), glm::dvec3(to.turn), way[3]));
    view.distance =
        std::lerp(static_cast<double>(from.distance), static_cast<double>(to.distance), way[4]);
    view.view_angle =
        std::lerp(static_cast<double>(from.view_angle), static_cast<double>(to.view_angle), way[5]);
    return view;
}

}  // namespace raks::motion
