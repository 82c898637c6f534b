#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/reports/plot_data.hpp"
#include "apps/reports/plot_sheet.hpp"
#include "apps/reports/plot_svg.hpp"
#include "base/expected.hpp"
#include "base/music_state.hpp"

/// The parts that the panels of a plot share. The panels of the sound are in plot_svg.cpp, those of
/// what the tracker found in plot_beats.cpp, those of what the music does in plot_form.cpp.
namespace raks::apps {

/// The colours of the panels.
namespace plot_colour {
inline constexpr const char* kBlue = "#2563eb";    ///< tracker; onsets above the threshold
inline constexpr const char* kPale = "#bfdbfe";    ///< onsets below the threshold
inline constexpr const char* kOrange = "#f97316";  ///< reference; threshold
inline constexpr const char* kGreen = "#16a34a";   ///< beats that match
inline constexpr const char* kRed = "#dc2626";     ///< beats that do not match
inline constexpr const char* kGrey = "#64748b";    ///< waveform
inline constexpr const char* kTeal = "#0d9488";    ///< confidence
}  // namespace plot_colour

/// Draws the panels, one method each. Threads: one.
class Plotter {
 public:
    /// Both must outlive this.
    Plotter(const PlotData& data, const PlotLabels& labels)
        : data_(data), labels_(labels), sheet_(data.duration()) {}

    /// The whole document. Errors: the spectrogram's image cannot be encoded.
    Expected<std::string> draw();

 private:
    using Panel = PlotSheet::Panel;
    using Values = std::vector<double>;

    [[nodiscard]] double column_x(std::size_t column) const {
        return sheet_.x(static_cast<double>(column) * data_.seconds_per_column());
    }

    /// A line through the values of the columns; NaN breaks it.
    [[nodiscard]] std::string line(const Panel& panel, const Values& values) const;

    /// The area between two rows of values.
    [[nodiscard]] std::string area(const Panel& panel, const Values& high, const Values& low) const;
    void stroke(std::string_view path, std::string_view colour, double width);
    /// Dots, where the path has lines of length 0: their ends are round.
    void dots(std::string_view path, std::string_view colour, double width);
    void fill(std::string_view path, std::string_view colour);

    /// `value(column)` for every column.
    template <typename Value>
    [[nodiscard]] Values collect(Value&& value) const {
        Values values;
        values.reserve(data_.columns().size());
        for (const PlotColumn& column : data_.columns()) {
            values.push_back(value(column));
        }
        return values;
    }

    /// F-measure of the beats from 5 s on, within 70 ms, against the reference, which must exist.
    [[nodiscard]] double f_measure() const;

    void head();
    void waveform();
    Expected<void> spectrogram();
    void onsets();
    void beats();
    /// A row of marks for `beats`; those that match one of `others` have another colour. `foot`: y
    /// of the lower ends; `length`: of a downbeat's mark.
    void beat_row(std::span<const BeatEvent> beats,
                  std::span<const BeatEvent> others,
                  double foot,
                  double length);
    void tempo();
    void rival_tempi(const Panel& panel);
    void bar();
    void confidence();
    void beat_parts();
    void numbers();
    /// The panel of a row of kMusicTable; none where nothing of it is drawn.
    void numbers_of(std::size_t row);
    void form();
    /// Of a song that is known, the stretches of bars that repeat earlier ones.
    void repeats();
    void accents();

    const PlotData& data_;
    const PlotLabels& labels_;
    PlotSheet sheet_;
};

}  // namespace raks::apps
