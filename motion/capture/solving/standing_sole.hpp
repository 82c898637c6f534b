// Standing sole: how slow and low a point of a sole is that stands on the floor.
#pragma once

namespace raks::capture {

/// A sole stands where it is slower and lower than the first of two limits, does not beyond the
/// second, and between them by halves. The defaults are for markers.
struct StandingSole {
    double still = 0.15;   ///< m/s
    double moving = 0.35;  ///< m/s
    double low = 0.025;    ///< metres over the floor
    double lifted = 0.06;  ///< metres
    /// Heels are held, too. Where heights are not sure, a heel that is a little lifted would be set
    /// down, and the knee stretched.
    bool are_heels_held = true;
};

}  // namespace raks::capture
