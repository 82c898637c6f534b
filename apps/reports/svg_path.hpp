#pragma once

#include <string>

namespace raks::apps {

/// The attribute `d` of an SVG path of straight lines, to a tenth: "M1.0 2.0L3.0 4.0". M moves to
/// a line's first point, L draws to each later one.
class SvgPath {
 public:
    /// The next point of a line; the first of one at the start and after lift() and close().
    void to(double x, double y);
    void lift() noexcept { is_drawing_ = false; }
    /// Draws back to the line's first point.
    void close();

    [[nodiscard]] const std::string& data() const noexcept { return data_; }

 private:
    std::string data_;
    bool is_drawing_ = false;
};

}  // namespace raks::apps
