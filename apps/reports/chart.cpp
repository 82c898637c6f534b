#include "apps/reports/chart.hpp"

#include <algorithm>
#include <cmath>

#include "apps/reports/svg_path.hpp"
#include "apps/reports/web_page.hpp"

#include <fmt/format.h>

namespace raks::apps {

// The step of 1, 2, 5 or 10 powers of ten that is nearest to range / wanted; the bounds lie about
// half-way between these on a logarithmic axis.
double round_step(double range, int wanted) {
    // An empty range would have no logarithm.
    const double raw = std::max(range, 1e-9) / std::max(wanted, 1);
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    const double share = raw / power;
    return power * (share < 1.5 ? 1.0 : share < 3.5 ? 2.0 : share < 7.5 ? 5.0 : 10.0);
}

Chart::Chart(const Plan& plan) : plan_(plan) {
    body_ = fmt::format(
        "<rect class=\"frame\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\"/>\n",
        plan_.left,
        plan_.top,
        plan_.width - plan_.left - plan_.right,
        plan_.height - plan_.top - plan_.bottom);
    if (!plan_.x_label.empty()) {
        body_ += fmt::format("<text class=\"label\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                             0.5 * (plan_.left + plan_.width - plan_.right),
                             plan_.height - 3.0,
                             xml_text(plan_.x_label));
    }
}

// Linear from [low, high] to the pixels between the margins.
double Chart::x(double value) const noexcept {
    const double share = (value - plan_.x.low) / (plan_.x.high - plan_.x.low);
    return plan_.left + share * (plan_.width - plan_.left - plan_.right);
}

double Chart::y(double value) const noexcept {
    const double share = (value - plan_.y.low) / (plan_.y.high - plan_.y.low);
    return plan_.height - plan_.bottom - share * (plan_.height - plan_.top - plan_.bottom);
}

void Chart::grid_y(int wanted) {
    const double step = round_step(plan_.y.high - plan_.y.low, wanted);
    // As many decimals as the step has; 1e-9 keeps a step of exactly 0.1 at one.
    const int decimals = std::max(0, static_cast<int>(std::ceil(-std::log10(step) - 1e-9)));
    // The first multiple of the step inside the range, with room for rounding at the ends.
    const double from = std::ceil(plan_.y.low / step - 1e-9);
    for (double i = from; i * step <= plan_.y.high + 1e-9 * step; i += 1.0) {
        const double value = i * step == 0.0 ? 0.0 : i * step;  // no "-0"
        body_ += fmt::format("<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>",
                             plan_.left,
                             y(value),
                             plan_.width - plan_.right);
        tick_y(value, fmt::format("{:.{}f}", value, decimals));
    }
}

void Chart::tick_x(double value, std::string_view label) {
    body_ += fmt::format(
        "<text class=\"axis\" text-anchor=\"middle\" x=\"{:.1f}\" y=\"{:.1f}\">"
        "{}</text>\n",
        x(value),
        plan_.height - plan_.bottom + 14.0,
        xml_text(label));
}

void Chart::tick_y(double value, std::string_view label) {
    body_ += fmt::format(
        "<text class=\"axis\" text-anchor=\"end\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
        plan_.left - 6.0,
        y(value) + 4.0,
        xml_text(label));
}

void Chart::line(std::span<const Point> points, std::string_view style) {
    SvgPath path;
    for (const Point& point : points) {
        path.to(x(point.first), y(point.second));
    }
    body_ += fmt::format(
        "<path d=\"{}\" fill=\"none\" stroke-linejoin=\"round\" {}/>\n", path.data(), style);
}

void Chart::dot(Point at, double radius, std::string_view style) {
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n",
                         x(at.first),
                         y(at.second),
                         radius,
                         style);
}

void Chart::box(Point from, Point to, std::string_view style) {
    // Corners may come in any order, and the axis may be turned over.
    const double left = std::min(x(from.first), x(to.first));
    const double top = std::min(y(from.second), y(to.second));
    body_ +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n",
                    left,
                    top,
                    std::abs(x(to.first) - x(from.first)),
                    std::abs(y(to.second) - y(from.second)),
                    style);
}

void Chart::mark(Point at, double dy, std::string_view colour, std::string_view text) {
    body_ +=
        fmt::format("<text class=\"mark\" style=\"fill:{}\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n",
                    colour,
                    x(at.first),
                    y(at.second) + dy,
                    xml_text(text));
}

std::string Chart::svg() const {
    return fmt::format(
               "<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
               "height=\"{1:.0f}\" role=\"img\">\n",
               plan_.width,
               plan_.height) +
           body_ + "</svg>\n";
}

}  // namespace raks::apps
