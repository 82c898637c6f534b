#pragma once

#include <string>

#include "motion/capture/keypoints/keypoints.hpp"

namespace raks::capture {

/// Whether a camera stood still, with a still lens, by the background of its pictures: it was moved
/// at some moment, or so far at once that the rest of the film shows nothing of the background, it
/// zooms, it moves all the time. At most one line, without the camera's name;
/// empty: nothing speaks against it, or the background shows too little to tell. Times are the
/// film's. Threads: any. Real-time: no.
[[nodiscard]] std::string why_not_still(const KeypointFilm& film);

/// Whether the background is seen all the time and stands still. Threads: any. Real-time: no.
[[nodiscard]] bool surely_stood_still(const KeypointFilm& film);

}  // namespace raks::capture
