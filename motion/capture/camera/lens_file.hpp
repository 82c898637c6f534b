// Files of one lens: OpenCV's YAML, as its calibration programs write it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/capture/camera/calibrated_camera.hpp"
#include "motion/capture/camera/opencv_yaml.hpp"

/// The format (OpenCV's FileStorage, of which only what is needed is understood):
///
///     %YAML:1.0
///     ---
///     image_width: 640
///     image_height: 480
///     camera_matrix: !!opencv-matrix
///        rows: 3
///        cols: 3
///        dt: d
///        data: [ fx, 0., cx, 0., fy, cy, 0., 0., 1. ]
///     distortion_coefficients: !!opencv-matrix
///        ...
///
/// Threads: any. Real-time: no.
namespace raks::capture {

/// Reads a lens: image_width, image_height, camera_matrix, and distortion_coefficients of 4, 5 or 8
/// numbers in a row or a column; other keys are passed over. `name`: the file's, for messages.
/// Errors, with file and line: a key missing or twice, a matrix without its rows, cols and data, or
/// with another count of numbers than those say; numbers that are none or not finite; a skewed
/// lens; a picture or focal length that is not positive; more than 1 MiB.
[[nodiscard]] Expected<Lens> parse_lens_yaml(std::string_view text, const std::string& name);

/// Reads a camera matrix, 3 x 3, from the matrix of a key. Errors: none there; skew; a focal length
/// that is not positive.
[[nodiscard]] Expected<void> read_lens_matrix(const YamlEntries& reader,
                                              std::string_view key,
                                              Lens& lens);
/// Reads distortion, 4, 5 or 8 numbers, from the matrix of a key. Errors: none there, others.
[[nodiscard]] Expected<void> read_lens_distortion(const YamlEntries& reader,
                                                  std::string_view key,
                                                  Lens& lens);

/// The same from a file.
[[nodiscard]] Expected<Lens> read_lens_yaml(const std::filesystem::path& path);

/// A lens as a text that OpenCV reads too, and that parse_lens_yaml reads back to the same bits.
[[nodiscard]] std::string lens_yaml_text(const Lens& lens);

}  // namespace raks::capture
