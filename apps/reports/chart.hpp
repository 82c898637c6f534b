#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace raks::apps {

/// One small chart with two linear axes, written as an SVG element for a page. Lengths in CSS
/// pixels; texts use the page's classes `axis`, `label` and `mark`. Threads: one. Real-time: no.
class Chart {
 public:
    struct Range {
        double low = 0.0;
        double high = 1.0;
    };
    struct Plan {
        double width = 380.0;
        double height = 220.0;
        Range x;
        Range y;  ///< high is up; a range from high to low turns the axis over
        std::string_view x_label = {};
        double left = 46.0;    ///< room for the ticks of y
        double bottom = 34.0;  ///< and of x with their label
        double top = 10.0;
        double right = 8.0;
    };
    using Point = std::pair<double, double>;

    /// Draws the frame.
    explicit Chart(const Plan& plan);

    [[nodiscard]] double x(double value) const noexcept;
    [[nodiscard]] double y(double value) const noexcept;

    /// Ticks at round values, with lines across (about `wanted` of them).
    void grid_y(int wanted);
    void tick_x(double value, std::string_view label);
    void tick_y(double value, std::string_view label);

    /// `style`: SVG attributes, such as `stroke="#2563eb" stroke-width="2"`.
    void line(std::span<const Point> points, std::string_view style);
    void dot(Point at, double radius, std::string_view style);
    void box(Point from, Point to, std::string_view style);
    /// A small text in the middle over a point, `dy` pixels below it.
    void mark(Point at, double dy, std::string_view colour, std::string_view text);

    [[nodiscard]] std::string svg() const;

 private:
    Plan plan_;
    std::string body_;
};

/// A round step (1, 2 or 5 times a power of ten) that gives about `wanted` steps over a range.
[[nodiscard]] double round_step(double range, int wanted);

}  // namespace raks::apps
