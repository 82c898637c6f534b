#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace raks::apps {

/// One small chart with two linear axes, written as an SVG element for a page. Lengths in CSS
/// pixels; texts use the page's classes `frame`, `grid`, `label` and `mark`. Threads: one.
/// Real-time: no.
class Chart {
 public:
    /// The values that an axis spans.
    struct Range {
        double low = 0.0;   ///< at the left or bottom end
        double high = 1.0;  ///< at the right or top end; must differ from low
    };
    /// Size, axes and margins of a chart.
    struct Plan {
        double width = 380.0;   ///< of the whole element, pixels
        double height = 220.0;  ///< of the whole element, pixels
        Range x;                ///< of the horizontal axis
        Range y;                ///< of the vertical axis; a range from high to low turns it over
        std::string_view x_label = {};  ///< below the horizontal axis; empty: none
        double left = 46.0;             ///< margin with the ticks of y
        double bottom = 34.0;           ///< margin with the ticks of x and their label
        double top = 10.0;              ///< margin
        double right = 8.0;             ///< margin
    };
    using Point = std::pair<double, double>;

    /// An empty chart: the frame and the label.
    explicit Chart(const Plan& plan);

    /// Pixel of a value on the horizontal axis.
    [[nodiscard]] double x(double value) const noexcept;
    /// Pixel of a value on the vertical axis; pixels count downwards.
    [[nodiscard]] double y(double value) const noexcept;

    /// About `wanted` ticks at round values, each with a line across the chart.
    void grid_y(int wanted);
    /// A label below the horizontal axis.
    void tick_x(double value, std::string_view label);
    /// A label left of the vertical axis.
    void tick_y(double value, std::string_view label);

    /// A line through points in values. `style`: SVG attributes, such as `stroke="#2563eb"
    /// stroke-width="2"`.
    void line(std::span<const Point> points, std::string_view style);
    /// A disc around a point; `radius` in pixels.
    void dot(Point at, double radius, std::string_view style);
    /// A rectangle between two opposite corners, in values.
    void box(Point from, Point to, std::string_view style);
    /// A small text centred over a point, `dy` pixels below it.
    void mark(Point at, double dy, std::string_view colour, std::string_view text);

    /// The whole SVG element.
    [[nodiscard]] std::string svg() const;

 private:
    Plan plan_;
    std::string body_;
};

/// A round step (1, 2 or 5 times a power of ten) that gives about `wanted` steps over a range.
[[nodiscard]] double round_step(double range, int wanted);

}  // namespace raks::apps
