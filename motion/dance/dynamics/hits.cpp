#include "motion/dance/dynamics/hits.hpp"

#include <algorithm>
#include <cmath>

namespace raks::motion {
namespace {

constexpr float kLeastStrength = 0.65F;
constexpr double kRise = 0.07;      // seconds to the farthest
constexpr double kOver = 0.60;      // seconds
constexpr float kHitTurn = 0.085F;  // radians of one bone

/// 0 at 0, 1 at kRise, then back to 0.
float pulse(double seconds) noexcept {
    if (seconds <= 0.0 || seconds >= kOver) {
        return 0.0F;
    }
    // Squared at its beginning: no jerk. What the end lacks is less than a thousandth.
    const double t = seconds / kRise;
    return static_cast<float>(t * t * std::exp(2.0 - 2.0 * t));
}

void nod(Bone bone, float radians, Pose& pose) noexcept {
    pose.rotation(bone) = pose.rotation(bone) *
                          glm::quat(std::cos(0.5F * radians), std::sin(0.5F * radians), 0.0F, 0.0F);
}

}  // namespace

void Hits::advance(const MusicState& music, float size) noexcept RAKS_NONBLOCKING {
    const MusicAccent& accent = music.accent;
    if (accent.strength < kLeastStrength) {
        return;
    }
    hits_[next_] = {music.time, size * accent.strength, accent.band};
    next_ = (next_ + 1) % hits_.size();
}

void Hits::apply(StreamTime time, Pose& pose) const noexcept RAKS_NONBLOCKING {
    for (const Hit& hit : hits_) {
        const float angle = kHitTurn * hit.size * pulse(to_seconds(time - hit.since));
        if (angle == 0.0F) {
            continue;
        }
        switch (hit.band) {
            case MusicAccent::Band::low:  // the waist draws in
                nod(Bone::spine, 0.8F * angle, pose);
                nod(Bone::chest, 0.6F * angle, pose);
                break;
            case MusicAccent::Band::middle:  // the chest lifts, the head stays
                nod(Bone::chest, -angle, pose);
                nod(Bone::upper_chest, -0.6F * angle, pose);
                nod(Bone::neck, angle, pose);
                break;
            case MusicAccent::Band::high:  // the head
                nod(Bone::neck, 0.7F * angle, pose);
                nod(Bone::head, 0.7F * angle, pose);
                break;
        }
    }
}

}  // namespace raks::motion
