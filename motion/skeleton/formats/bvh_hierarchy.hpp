// BVH hierarchy: the text of a BVH file, and the part of it before MOTION.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/motion_clip.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {

// BVH text: lines, numbers and errors of a BVH file.

/// A cursor over the lines of a BVH file, which makes its errors. The lines are views into the
/// file's text.
class BvhText {
 public:
    /// `name` stands for the file in errors; `text` must outlive this.
    BvhText(std::string_view text, std::string_view name)
        : lines_(split_lines(text)), name_(name) {}

    /// Whether all lines are read.
    [[nodiscard]] bool is_at_end() const noexcept { return next_ >= lines_.size(); }
    /// The present line; there must be one.
    [[nodiscard]] const Line& line() const { return lines_[next_]; }
    /// Moves to the next line.
    void advance() noexcept { ++next_; }
    /// Number of the present line, or at the end that of the last one.
    [[nodiscard]] std::size_t line_number() const noexcept;

    /// An error in a line.
    [[nodiscard]] tl::unexpected<Error> fault(std::size_t line, const std::string& what) const;
    /// An error of the whole file.
    [[nodiscard]] tl::unexpected<Error> fault(const std::string& what) const;

    /// A word as a number. Errors: no number, out of range, not finite.
    [[nodiscard]] Expected<double> number(std::string_view word, std::size_t line) const;
    /// The value of a line "Key words: value", which must be the present one and is then passed.
    /// `key` in lower case. Errors: another line.
    [[nodiscard]] Expected<std::string_view> value_of(std::string_view key);

 private:
    std::vector<Line> lines_;
    std::string name_;
    std::size_t next_ = 0;
};

/// The six channels of a BVH joint, in the order of their codes: X, Y, Z position, X, Y, Z
/// rotation.
enum class BvhChannel : std::uint8_t {
    x_position,
    y_position,
    z_position,
    x_rotation,
    y_rotation,
    z_rotation
};

/// Joints and channels of a BVH file.
struct BvhHierarchy {
    std::vector<ClipJoint> joints;                  ///< parents before their children
    std::vector<std::vector<BvhChannel>> channels;  ///< by joint
    std::size_t channel_count = 0;                  ///< of all joints together: numbers in a frame
    int roots = 0;                                  ///< number of ROOT joints
};

/// Reads from HIERARCHY up to MOTION; `text` is then past that line. Errors: the line and what is
/// wrong.
[[nodiscard]] Expected<BvhHierarchy> read_bvh_hierarchy(BvhText& text);

}  // namespace raks::motion
