// Foreign keypoints: joints in pictures as other programs write them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "motion/capture/keypoints/keypoints.hpp"
#include "motion/capture/keypoints/point_names.hpp"

namespace raks::capture {

/// What the files of others do not say.
struct ForeignFilm {
    std::string camera;                ///< its name in capture.toml
    int width = 0;                     ///< of the pictures; pixels
    int height = 0;                    ///< likewise
    double pictures_per_second = 0.0;  ///< > 0
    PointNameMap names;                ///< what a person says of single names
};

/// Builds a film from the files of OpenPose (--write_json, one a picture, in order): body of 25
/// joints, or of 18. Of several people the one nearest to where the dancer was is taken, at first
/// the surest; an empty list is a picture with nobody.
class OpenPoseReader {
 public:
    /// `film`: its `names` are not needed.
    explicit OpenPoseReader(const ForeignFilm& film);
    /// Adds a picture. `file`: its name, for messages; the last number in it is the picture's.
    /// Errors, one line: no JSON (NaN is none), no list of people, joints that are no numbers or
    /// not of such a body, a negative likelihood, numbers that do not go on.
    [[nodiscard]] Expected<void> add(std::string_view text, const std::string& file);
    /// What was read.
    [[nodiscard]] KeypointFilm take() { return std::move(result_); }

 private:
    KeypointFilm result_;
    double pictures_per_second_;
    std::optional<glm::dvec2> last_;  // where the dancer was
};

/// Reads a table of joints in pictures, a row a picture, with commas, semicolons or tabs. Known
/// layouts: a head with NAME_x, NAME_y and NAME_v (or _c, _p, _score, _conf, _confidence,
/// _likelihood, _visibility; without: sure), where other columns are passed over but for `frame`,
/// `picture` or `image` and `time`, `timestamp` or `seconds`; DeepLabCut (rows scorer, bodyparts,
/// coords). Places all within [0, 1] are shares of width and height. Blank or NaN: not found.
/// Errors, one line: another layout (the known ones are named), no joint of ours (with the map that
/// would help), a map that names a column which is not there, likelihoods outside [0, 1], pictures
/// or times that do not go on.
[[nodiscard]] Expected<KeypointFilm> read_foreign_table(std::string_view text,
                                                        const std::string& file,
                                                        const ForeignFilm& film);

}  // namespace raks::capture
