#include "motion/choreography/follow_figure.hpp"

#include <cmath>
#include <utility>

#include "motion/choreography/splines.hpp"

namespace raks::motion {
namespace {

// A floor vector of a frame that is turned by `degrees`, in the frame that it is turned in.
glm::dvec2 turned(const glm::dvec2& vector, double degrees) {
    const double c = std::cos(degrees * kDegree);
    const double s = std::sin(degrees * kDegree);
    return {c * vector.x + s * vector.y, c * vector.y - s * vector.x};
}

Side other(Side side) { return side == Side::left ? Side::right : Side::left; }

// Where he steps on the heel she steps back on the ball, and the other way round.
FootLanding against(FootLanding on) {
    switch (on) {
        case FootLanding::heel:
            return FootLanding::ball;
        case FootLanding::ball:
            return FootLanding::heel;
        default:
            return on;
    }
}

// Her place, in her frame, while his place and heading in his frame are these.
glm::dvec2 before_lead(const glm::dvec2& place, double degrees, const glm::dvec2& apart) {
    return apart - (place + turned(apart, degrees));
}

bool is_yaw(Control control) {
    return control == Control::hip_yaw || control == Control::chest_yaw ||
           control == Control::head_yaw;
}

void negate(Track& track) {
    for (TrackKey& key : track.keys) {
        key.value = -key.value;
    }
    track.wave = -track.wave;
    track.rest = -track.rest;
}

// Controls of the other side, with the opposite sign where that changes in the mirror.
void mirror_body(const AuthoredFigure& lead, bool keeps_yaws, AuthoredFigure& follow) {
    for (std::size_t i = 0; i < kControlCount; ++i) {
        const auto control = static_cast<Control>(i);
        std::vector<Track>& tracks = follow.body[index_of(mirrored(control))];
        tracks = lead.tracks(control);
        if (info_of(control).mirror_sign < 0.0 && !(keeps_yaws && is_yaw(control))) {
            for (Track& track : tracks) {
                negate(track);
            }
        }
    }
}

}  // namespace

AuthoredFigure follow_of(const AuthoredFigure& lead, const CoupleStyle& couple) {
    const bool is_mirror = couple.follow == CoupleStyle::Follow::mirror;
    AuthoredFigure follow = lead;
    follow.follow_steps.clear();
    mirror_body(lead, !is_mirror, follow);
    if (is_mirror) {
        follow.travel.x = -lead.travel.x;
        follow.turn = -lead.turn;
    } else {
        follow.travel = before_lead(lead.travel, lead.turn, couple.apart);
    }
    for (FootStep& step : follow.steps) {
        step.foot = other(step.foot);
        if (is_mirror) {
            step.turn = -step.turn;
            step.to = step.to ? std::optional(glm::dvec2(-step.to->x, step.to->y)) : step.to;
        } else {
            step.on = against(step.on);
            step.to =
                step.to ? std::optional(before_lead(*step.to, step.turn, couple.apart)) : step.to;
        }
    }
    if (!lead.follow_steps.empty()) {
        follow.steps = lead.follow_steps;
    }
    return follow;
}

}  // namespace raks::motion
