// What is done with joints in pictures, and with the networks that find them.
#include <cmath>
#include <string>

#include "motion/capture/keypoints/foreign_keypoints.hpp"
#include "motion/capture/keypoints/keypoint_doubts.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/keypoints/pose_model_file.hpp"
#include "motion/capture/keypoints/still_camera.hpp"
#include "tests/fuzz/promise.hpp"
#include "tests/fuzz/readers.hpp"

namespace raks::fuzz {
namespace {

/// What is true of every film that was read.
bool are_sound_keypoints(const Expected<capture::KeypointFilm>& film) {
    if (!film) {
        must_be_one_line(film.error().message);
        return false;
    }
    for (const capture::KeypointPicture& picture : film->pictures) {
        must(picture.score >= 0.0 && picture.score <= 1.0);
        if (const auto& place = picture.background) {
            must(std::isfinite(place->move.x) && std::isfinite(place->move.y) && place->size > 0.0);
        }
        for (const capture::Keypoint& point : picture.points) {
            must(std::isfinite(point.pixel.x) && std::isfinite(point.pixel.y));
            must(point.visibility >= 0.0 && point.visibility <= 1.0);
        }
    }
    const capture::KeypointShares shares = capture::keypoint_shares(*film);
    static_cast<void>(capture::why_no_dance(shares));
    for (const std::string& doubt : capture::keypoint_doubts(shares)) {
        must_be_one_line(doubt);
    }
    must_be_one_line(capture::why_not_still(*film));
    static_cast<void>(capture::surely_stood_still(*film));
    // Written once it is rounded; from then on it reads back to the same bits.
    const std::string written = capture::keypoints_text(*film);
    const auto again = capture::read_keypoints(written, "y");
    must(again && capture::keypoints_text(*again) == written);
    return true;
}

capture::ForeignFilm film_of_fuzzers() { return {"left", 640, 480, 25.0, {}}; }

}  // namespace

bool read_keypoint_file(std::string_view text) {
    return are_sound_keypoints(capture::read_keypoints(text, "x"));
}

bool read_openpose_file(std::string_view text) {
    capture::OpenPoseReader reader(film_of_fuzzers());
    if (const auto added = reader.add(text, "x_1.json"); !added) {
        must_be_one_line(added.error().message);
        return false;
    }
    static_cast<void>(reader.add(text, "x_2.json"));
    return are_sound_keypoints(reader.take());
}

bool read_keypoint_table(std::string_view text) {
    return are_sound_keypoints(capture::read_foreign_table(text, "x", film_of_fuzzers()));
}

bool read_point_name_file(std::string_view text) {
    const auto names = capture::read_point_names(text, "x");
    if (!names) {
        must_be_one_line(names.error().message);
        return false;
    }
    for (const auto& [name, point] : *names) {
        must(capture::body_point_meant(name, *names) == point);
    }
    return true;
}

bool read_pose_network(std::string_view bytes) {
    if (const auto known = capture::known_pose_network(bytes); !known) {
        must_be_one_line(known.error().message);
    }
    const auto onnx = capture::pose_file_as_onnx(bytes);
    if (!onnx) {
        must_be_one_line(onnx.error().message);
    }
    return onnx.has_value();
}

}  // namespace raks::fuzz
