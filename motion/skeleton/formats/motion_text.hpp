// Motion text: lines, numbers and errors of a motion file that is text.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {

/// A cursor over the lines of a motion file, which makes its errors. The lines are views into the
/// file's text.
class MotionText {
 public:
    /// `name` stands for the file in errors; `text` must outlive this.
    MotionText(std::string_view text, std::string_view name)
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

}  // namespace raks::motion
