#include "motion/capture/solving/smoother.hpp"

#include <algorithm>
#include <cmath>

#include "motion/capture/solving/block_band.hpp"

#include <glm/geometric.hpp>

namespace raks::capture {
namespace {

using motion::Bone;
using motion::Side;

constexpr double kSolvedSeconds = 8.0;  // seconds that are solved at once
constexpr double kOverlap = 1.0;        // seconds after which what comes later does not matter
constexpr double kHipsPlaceAcceleration = 10.0;  // m / s^2 at 60 frames a second
constexpr double kPlantedSpeed = 0.03;           // m / s of a sole that stands
constexpr double kSteadyStep = 10.0;             // damping: 1 / (0.3)^2

/// Entries of three matrices: what an acceleration says of the frame before, itself, and after.
struct Acceleration {
    glm::dvec3 value{};
    std::array<glm::dmat3, 3> change{};  // by frame: of the value
};

/// The frames [first, last) whose states are unknown; the others stay.
class Window {
 public:
    Window(const FrameContext& context,
           const std::vector<FrameSight>& sights,
           const SmoothOptions& options,
           std::vector<BodyState>& states,
           std::size_t first,
           std::size_t last)
        : context_(context),
          sights_(sights),
          options_(options),
          states_(states),
          first_(first),
          last_(last) {}

    /// One step of Gauss-Newton. False: nothing could be solved.
    bool step();

 private:
    void add_frame(std::size_t frame);
    void add_accelerations(std::size_t frame);
    void add_planted(std::size_t frame);
    void add_acceleration(std::size_t frame,
                          std::size_t variable,
                          std::size_t size,
                          const Acceleration& acceleration,
                          double weight);
    [[nodiscard]] bool is_inside(std::size_t frame) const {
        return frame >= first_ && frame < last_;
    }

    const FrameContext& context_;
    const std::vector<FrameSight>& sights_;
    const SmoothOptions& options_;
    std::vector<BodyState>& states_;
    std::size_t first_;
    std::size_t last_;
    BlockBand band_{0, 0};
    std::vector<PlacedBody> bodies_;  // by frame of the window, and the one before
    FrameSystem system_;
};

void Window::add_frame(std::size_t frame) {
    system_.clear(context_.model.variables());
    add_frame_terms(context_, states_[frame], bodies_[frame - first_ + 1], sights_[frame], system_);
    band_.at(frame - first_, 0) += system_.matrix;
    band_.at(frame - first_, 0).diagonal().array() += kSteadyStep;
    band_.right(frame - first_) -= system_.gradient;
}

void Window::add_acceleration(std::size_t frame,
                              std::size_t variable,
                              std::size_t size,
                              const Acceleration& acceleration,
                              double weight) {
    const auto n = static_cast<glm::length_t>(size);
    const auto at = static_cast<Eigen::Index>(variable);
    for (std::size_t row = 0; row < 3; ++row) {
        if (!is_inside(frame - 1 + row)) {
            continue;
        }
        const std::size_t block = frame - 1 + row - first_;
        const glm::dmat3 transposed = glm::transpose(acceleration.change[row]);
        const glm::dvec3 pull = weight * (transposed * acceleration.value);
        for (glm::length_t i = 0; i < n; ++i) {
            band_.right(block)(at + i) -= pull[i];
        }
        for (std::size_t column = 0; column <= row; ++column) {
            if (!is_inside(frame - 1 + column)) {
                continue;
            }
            const glm::dmat3 product = weight * (transposed * acceleration.change[column]);
            Eigen::MatrixXd& into = band_.at(frame - 1 + column - first_, row - column);
            for (glm::length_t i = 0; i < n; ++i) {
                for (glm::length_t k = 0; k < n; ++k) {
                    into(at + i, at + k) += product[k][i];
                }
            }
        }
    }
}

/// Acceleration of joints and hips around a frame that has both neighbours.
void Window::add_accelerations(std::size_t frame) {
    const BodyState& before = states_[frame - 1];
    const BodyState& now = states_[frame];
    const BodyState& after = states_[frame + 1];
    const double rate = options_.frames_per_second;
    // White accelerations: their variance grows with the rate.
    const double scale = options_.smoothness * options_.smoothness * (60.0 / rate);
    const auto weight = [&](double deviation) {
        const double per_frame = deviation / (rate * rate);
        return scale / (per_frame * per_frame);
    };
    Acceleration straight;
    straight.value = after.hips - 2.0 * now.hips + before.hips;
    straight.change = {glm::dmat3(1.0), glm::dmat3(-2.0), glm::dmat3(1.0)};
    add_acceleration(frame, kHipsPlace, 3, straight, weight(kHipsPlaceAcceleration));
    const auto& joints = context_.model.joints();
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const TurningJoint& joint = joints[i];
        if (joint.is_hinge) {
            straight.value = {after.angles[i] - 2.0 * now.angles[i] + before.angles[i], 0.0, 0.0};
            add_acceleration(frame, joint.first, 1, straight, weight(joint.acceleration));
            continue;
        }
        const glm::dvec3 arriving = turn_vector(glm::conjugate(before.turns[i]) * now.turns[i]);
        const glm::dvec3 leaving = turn_vector(glm::conjugate(now.turns[i]) * after.turns[i]);
        const glm::dmat3 arrives = turn_vector_change(arriving);
        const glm::dmat3 leaves = turn_vector_change(leaving);
        Acceleration turning;
        turning.value = static_cast<double>(joint.count) * (leaving - arriving);
        turning.change = {glm::transpose(arrives), -(glm::transpose(leaves) + arrives), leaves};
        add_acceleration(frame, joint.first, 3, turning, weight(joint.acceleration));
    }
}

/// Soles that stand at a frame and the one before are at the same place in both.
void Window::add_planted(std::size_t frame) {
    const double per_frame = kPlantedSpeed / options_.frames_per_second;
    const PlacedBody& before = bodies_[frame - first_];
    const PlacedBody& now = bodies_[frame - first_ + 1];
    for (const Side side : motion::kSides) {
        for (std::size_t i = 0; i < kSolePoints; ++i) {
            const double planted =
                std::min(sights_[frame - 1].planted[static_cast<std::size_t>(side)][i],
                         sights_[frame].planted[static_cast<std::size_t>(side)][i]);
            if (planted <= 0.0) {
                continue;
            }
            const auto which = static_cast<SolePoint>(i);
            const Bone bone = sole_bone(side, which);
            const glm::dvec3 local = context_.shape.sole_point(side, which);
            const glm::dvec3 was = before.point(bone, local);
            const glm::dvec3 is = now.point(bone, local);
            const glm::dvec3 weight(planted / (per_frame * per_frame));
            const PointMotion moves = context_.model.motion_of(now, bone, is);
            system_.clear(context_.model.variables());
            system_.add(moves, is - was, weight);
            band_.at(frame - first_, 0) += system_.matrix;
            band_.right(frame - first_) -= system_.gradient;
            if (frame == first_) {
                continue;  // the frame before stays
            }
            const PointMotion moved = context_.model.motion_of(before, bone, was);
            system_.clear(context_.model.variables());
            system_.add(moved, was - is, weight);
            band_.at(frame - first_ - 1, 0) += system_.matrix;
            band_.right(frame - first_ - 1) -= system_.gradient;
            Eigen::MatrixXd& mixed = band_.at(frame - first_ - 1, 1);
            for (std::size_t row = 0; row < moves.count; ++row) {
                for (std::size_t column = 0; column < moved.count; ++column) {
                    mixed(static_cast<Eigen::Index>(moves.variables[row]),
                          static_cast<Eigen::Index>(moved.variables[column])) -=
                        glm::dot(weight * moves.moves[row], moved.moves[column]);
                }
            }
        }
    }
}

bool Window::step() {
    band_ = BlockBand(last_ - first_, context_.model.variables());
    bodies_.clear();
    for (std::size_t frame = first_; frame <= last_; ++frame) {
        bodies_.push_back(
            context_.model.place(context_.shape, states_[frame == 0 ? 0 : frame - 1]));
    }
    for (std::size_t frame = first_; frame < last_; ++frame) {
        add_frame(frame);
        if (frame > 0) {
            add_planted(frame);
        }
    }
    // The end of a window is free; its beginning goes on from the frames before.
    const std::size_t from = first_ == 0 ? 1 : first_ - 1;
    for (std::size_t frame = std::max<std::size_t>(1, from); frame + 1 < last_; ++frame) {
        add_accelerations(frame);
    }
    if (!band_.solve()) {
        return false;
    }
    for (std::size_t frame = first_; frame < last_; ++frame) {
        states_[frame] = context_.model.moved(states_[frame], band_.right(frame - first_).data());
    }
    return true;
}

}  // namespace

void smooth(const FrameContext& context,
            const std::vector<FrameSight>& sights,
            const SmoothOptions& options,
            std::vector<BodyState>& states) {
    const auto frames_of = [&](double seconds) {
        return static_cast<std::size_t>(std::max(4.0, seconds * options.frames_per_second));
    };
    const std::size_t size = frames_of(kSolvedSeconds);
    const std::size_t hop = size - frames_of(kOverlap);
    for (std::size_t first = 0; first < states.size(); first += hop) {
        const std::size_t last = std::min(states.size(), first + size);
        Window window(context, sights, options, states, first, last);
        for (int round = 0; round < options.rounds; ++round) {
            if (!window.step()) {
                break;
            }
        }
        if (last == states.size()) {
            break;
        }
    }
}

}  // namespace raks::capture
