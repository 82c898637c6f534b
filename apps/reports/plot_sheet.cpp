#include "apps/reports/plot_sheet.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "apps/reports/web_page.hpp"

#include <fmt/format.h>

namespace raks::apps {
namespace {

// Room above each panel for its title.
constexpr double kTitleHeight = 30.0;
// Room below the last panel for the time axis.
constexpr double kFoot = 44.0;
// More labels of the time axis would touch.
constexpr double kMostTicks = 16.0;

// A time as "30 s", "2:30" or "1:02:30", alike for all ticks of an axis.
std::string time_label(double seconds, double longest) {
    const auto whole = static_cast<long>(std::lround(seconds));
    if (longest < 120.0) {
        return fmt::format("{} s", whole);
    }
    if (longest < 3600.0) {
        return fmt::format("{}:{:02}", whole / 60, whole % 60);
    }
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

}  // namespace

// Three bytes become four digits of six bits; the last group is filled up with '='.
std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            word = word << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            const std::uint32_t digit = word >> (18U - 6U * k) & 63U;
            out += k <= count ? kDigits[digit] : '=';
        }
    }
    return out;
}

// Values outside the range stay on the panel's edge.
double PlotSheet::Panel::y(double value) const noexcept {
    const double share = (value - low) / (high - low);
    return top + height * (1.0 - std::clamp(share, 0.0, 1.0));
}

// An empty file still has an axis.
PlotSheet::PlotSheet(double seconds) : seconds_(std::max(seconds, 0.01)) {}

double PlotSheet::x(double seconds) const noexcept {
    return kLeft + (kRight - kLeft) * std::clamp(seconds / seconds_, 0.0, 1.0);
}

// The smallest usual step that gives at most 16 ticks.
double PlotSheet::time_step() const noexcept {
    constexpr std::array kSteps = {
        1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 120.0, 300.0, 600.0, 1800.0, 3600.0};
    for (const double step : kSteps) {
        if (seconds_ / step <= kMostTicks) {
            return step;
        }
    }
    return 3600.0 * std::ceil(seconds_ / 3600.0 / kMostTicks);
}

void PlotSheet::header(std::string_view title, std::string_view subtitle) {
    body_ += fmt::format(
        "<text x=\"{:.0f}\" y=\"34\" class=\"title\">{}</text>\n"
        "<text x=\"{:.0f}\" y=\"56\" class=\"sub\">{}</text>\n",
        kLeft,
        xml_text(title),
        kLeft,
        xml_text(subtitle));
}

// The legend begins anew at the right edge.
PlotSheet::Panel PlotSheet::begin_panel(const PanelPlan& plan) {
    const Panel panel{next_top_ + kTitleHeight, plan.height, plan.low, plan.high};
    next_top_ = panel.top + panel.height;
    legend_x_ = kRight;
    body_ +=
        fmt::format("<g id=\"{}\">\n<text x=\"{:.0f}\" y=\"{:.0f}\" class=\"head\">{}</text>\n",
                    plan.id,
                    kLeft,
                    panel.top - 8.0,
                    plan.title);
    // The unit is written upwards beside the axis.
    const double middle = panel.top + 0.5 * panel.height;
    body_ += fmt::format(
        "<text transform=\"translate(26 {:.0f}) rotate(-90)\" class=\"unit\">{}</text>\n",
        middle,
        plan.unit);
    body_ += fmt::format(
        "<rect x=\"{:.0f}\" y=\"{:.0f}\" width=\"{:.0f}\" height=\"{:.0f}\" class=\"frame\"/>\n"
        "<path class=\"grid\" d=\"",
        kLeft,
        panel.top,
        kRight - kLeft,
        panel.height);
    // Time lines run through all panels at the same places.
    for (double time = time_step(); time < seconds_; time += time_step()) {
        body_ += fmt::format("M{:.1f} {:.0f}v{:.0f}", x(time), panel.top, panel.height);
    }
    body_ += "\"/>\n";
    return panel;
}

// Panels are groups, so that they can be addressed by id.
void PlotSheet::end_panel() { body_ += "</g>\n"; }

void PlotSheet::tick(const Panel& panel, double value, std::string_view label) {
    const double at = panel.y(value);
    body_ += fmt::format(
        "<path class=\"tick\" d=\"M{:.0f} {:.1f}h-5\"/>"
        "<text x=\"{:.0f}\" y=\"{:.1f}\" class=\"value\">{}</text>\n",
        kLeft,
        at,
        kLeft - 9.0,
        at + 4.0,
        xml_text(label));
}

void PlotSheet::legend(const Panel& panel, std::string_view colour, std::string_view label) {
    // Fonts differ: the widest usual one has about 7 units a character at 12.
    const double width = 7.0 * static_cast<double>(label.size()) + 36.0;
    legend_x_ -= width;
    body_ += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"14\" height=\"8\" rx=\"2\" fill=\"{}\"/>"
        "<text x=\"{:.1f}\" y=\"{:.1f}\" class=\"key\">{}</text>\n",
        legend_x_ + 12.0,
        panel.top - 16.0,
        colour,
        legend_x_ + 31.0,
        panel.top - 8.0,
        xml_text(label));
}

void PlotSheet::note(const Panel& panel, std::string_view text) {
    body_ += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\" class=\"note\">{}</text>\n",
                         0.5 * (kLeft + kRight),
                         panel.top + 0.5 * panel.height + 4.0,
                         xml_text(text));
}

// The height is known only when all panels are drawn.
std::string PlotSheet::finish() {
    std::string axis;
    for (double time = 0.0; time <= seconds_; time += time_step()) {
        axis += fmt::format(
            "<path class=\"tick\" d=\"M{:.1f} {:.0f}v5\"/>"
            "<text x=\"{:.1f}\" y=\"{:.0f}\" class=\"time\">{}</text>\n",
            x(time),
            next_top_,
            x(time),
            next_top_ + 19.0,
            time_label(time, seconds_));
    }
    const double height = next_top_ + kFoot;
    return fmt::format(
               "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
               "<svg xmlns=\"http://www.w3.org/2000/svg\" "
               "xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"{0:.0f}\" height=\"{1:.0f}\" "
               "viewBox=\"0 0 {0:.0f} {1:.0f}\" font-family=\"Inter, Helvetica, Arial, "
               "sans-serif\">\n<style>\n",
               kWidth,
               height) +
           // The style sheet of the classes used above.
           "text{fill:#334155;font-size:12px}\n"
           ".title{font-size:22px;font-weight:600;fill:#0f172a}\n"
           ".sub{font-size:14px;fill:#64748b}\n"
           ".head{font-size:13px;font-weight:600;fill:#0f172a}\n"
           ".unit{fill:#64748b;text-anchor:middle}\n"
           ".value{text-anchor:end}\n"
           ".time,.note{text-anchor:middle}\n"
           ".note{fill:#94a3b8;font-style:italic}\n"
           // A light edge keeps a name readable on what lies below it.
           ".event{font-size:11px;stroke:#ffffff;stroke-width:3px;paint-order:stroke;"
           "stroke-linejoin:round}\n"
           ".frame{fill:#f8fafc;stroke:#cbd5e1}\n"
           ".grid{stroke:#e2e8f0;fill:none}\n"
           ".tick{stroke:#94a3b8;fill:none}\n"
           "</style>\n" +
           fmt::format(
               "<rect width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#ffffff\"/>\n", kWidth, height) +
           body_ + "<g id=\"time\">\n" + axis + "</g>\n</svg>\n";
}

}  // namespace raks::apps
