#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/expected.hpp"
#include "motion/skeleton/text_lines.hpp"

namespace raks::motion {

/// The text of a BVH file, read line by line, and its faults. Views into the file's text.
class BvhText {
 public:
    BvhText(std::string_view text, std::string_view name)
        : lines_(split_lines(text)), name_(name) {}

    [[nodiscard]] bool is_at_end() const noexcept { return next_ >= lines_.size(); }
    /// The line at hand; there must be one.
    [[nodiscard]] const Line& line() const { return lines_[next_]; }
    void advance() noexcept { ++next_; }
    /// Number of the line at hand, or of the last one.
    [[nodiscard]] std::size_t line_number() const noexcept;

    [[nodiscard]] tl::unexpected<Error> fault(std::size_t line, const std::string& what) const;
    [[nodiscard]] tl::unexpected<Error> fault(const std::string& what) const;

    /// A word as a number. Errors: none, out of range, not finite.
    [[nodiscard]] Expected<double> number(std::string_view word, std::size_t line) const;
    /// "Key words: value" at the line at hand, which is passed: the value's text.
    [[nodiscard]] Expected<std::string_view> value_of(std::string_view key);

 private:
    std::vector<Line> lines_;
    std::string name_;
    std::size_t next_ = 0;
};

}  // namespace raks::motion
