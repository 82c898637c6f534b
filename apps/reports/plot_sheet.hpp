#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace raks::apps {

/// A column of panels over one time axis, written as SVG. Lengths in SVG units (pixels at scale 1).
/// Threads: one. Real-time: no.
class PlotSheet {
 public:
    static constexpr double kWidth = 1400.0;
    static constexpr double kLeft = 92.0;
    static constexpr double kRight = 1376.0;

    /// `seconds`: what the time axis spans.
    explicit PlotSheet(double seconds);

    struct Panel {
        double top = 0.0;
        double height = 0.0;
        double low = 0.0;   ///< value at the bottom
        double high = 1.0;  ///< value at the top
        [[nodiscard]] double y(double value) const noexcept;
    };
    struct PanelPlan {
        const char* id;
        const char* title;
        const char* unit;  ///< of the values, written along the axis; may be empty
        double height;
        double low;
        double high;
    };
    /// Opens the next panel with title, frame and time lines; until end_panel() all goes into it.
    Panel begin_panel(const PanelPlan& plan);
    void end_panel();

    [[nodiscard]] double x(double seconds) const noexcept;

    void header(std::string_view title, std::string_view subtitle);
    /// A value's mark and label on the left axis.
    void tick(const Panel& panel, double value, std::string_view label);
    /// An entry of the panel's legend, from the right to the left.
    void legend(const Panel& panel, std::string_view colour, std::string_view label);
    void note(const Panel& panel, std::string_view text);
    /// Any SVG, as it is.
    void raw(std::string_view svg) { body_ += svg; }

    /// The document, with the time axis below the last panel.
    [[nodiscard]] std::string finish();

 private:
    [[nodiscard]] double time_step() const noexcept;

    double seconds_;
    double next_top_ = 72.0;
    double legend_x_ = kRight;
    std::string body_;
};

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace raks::apps
