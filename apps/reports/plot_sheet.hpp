#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace raks::apps {

/// A column of panels over a common time axis, written as SVG. Lengths in SVG units (pixels at
/// scale 1). Threads: one. Real-time: no.
class PlotSheet {
 public:
    /// Width of the document.
    static constexpr double kWidth = 1400.0;
    /// X of the time axis at 0 s.
    static constexpr double kLeft = 92.0;
    /// X of the time axis at its end.
    static constexpr double kRight = 1376.0;

    /// `seconds`: length of the time axis.
    explicit PlotSheet(double seconds);

    /// A panel that was begun: where it lies and what its vertical axis spans.
    struct Panel {
        double top = 0.0;     ///< y of its upper edge
        double height = 0.0;  ///< of the panel
        double low = 0.0;     ///< value at the bottom
        double high = 1.0;    ///< value at the top
        /// Y of a value, clamped to the panel.
        [[nodiscard]] double y(double value) const noexcept;
    };
    /// What a panel is begun with.
    struct PanelPlan {
        std::string_view id;     ///< of its SVG group
        std::string_view title;  ///< written over it
        std::string_view unit;   ///< of the values, written along the axis; may be empty
        double height;           ///< of the panel
        double low;              ///< value at the bottom
        double high;             ///< value at the top
    };
    /// Opens the next panel with title, frame and time lines; all drawing until end_panel() is part
    /// of its group.
    Panel begin_panel(const PanelPlan& plan);
    /// Closes the group of the panel.
    void end_panel();

    /// X of a time, clamped to the axis.
    [[nodiscard]] double x(double seconds) const noexcept;

    /// The two lines at the top of the document.
    void header(std::string_view title, std::string_view subtitle);
    /// A mark and label of a value at the left axis.
    void tick(const Panel& panel, double value, std::string_view label);
    /// Adds an entry to the panel's legend, which grows from the right to the left.
    void legend(const Panel& panel, std::string_view colour, std::string_view label);
    /// A text in the middle of the panel.
    void note(const Panel& panel, std::string_view text);
    /// Adds SVG elements as they are.
    void raw(std::string_view svg) { body_ += svg; }

    /// The whole document, with the time axis below the last panel. Call it once.
    [[nodiscard]] std::string finish();

 private:
    [[nodiscard]] double time_step() const noexcept;

    double seconds_;
    double next_top_ = 72.0;
    double legend_x_ = kRight;
    std::string body_;
};

/// Base64 of these bytes (RFC 4648, with padding).
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace raks::apps
