#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/reports/plot_data.hpp"

namespace raks::apps {

struct PlotLabels {
    std::string title;   ///< the file's name
    std::string method;  ///< how the beats were found
    std::optional<std::vector<BeatEvent>> reference;
};

/// One SVG over a shared time axis: waveform, spectrogram, onset strength with its threshold (the
/// paper's Fig. 8), beats against the reference, tempo, bar position, confidence. Each panel is a
/// group with its name as id. The same data give the same bytes; 0.1 to 2 MB however long the file.
/// Errors: the picture inside cannot be encoded. Threads: any. Real-time: no.
[[nodiscard]] Expected<std::string> draw_plot(const PlotData& data, const PlotLabels& labels);

}  // namespace raks::apps
