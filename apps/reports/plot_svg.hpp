#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/reports/plot_data.hpp"

namespace raks::apps {

/// The texts and the reference of a picture.
struct PlotLabels {
    std::string title;   ///< the file's name
    std::string method;  ///< how the beats were found
    /// Beats to compare with; none: nothing is compared.
    std::optional<std::vector<BeatEvent>> reference;
};

/// One SVG over a common time axis: waveform, spectrogram, onset strength with its threshold (the
/// paper's Fig. 8), beats against the reference, tempo, bar position, confidence, energy, form
/// (parts and events), accents. Each panel is a group with its name as id. The same data give the
/// same bytes; 0.1 to 2 MB for a file of any length. Errors: the spectrogram's image cannot be
/// encoded. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> draw_plot(const PlotData& data, const PlotLabels& labels);

}  // namespace raks::apps
