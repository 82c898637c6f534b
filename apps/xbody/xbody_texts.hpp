// Xbody texts: what a model is made of, and whose it is, as lines for the right pane.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "apps/xbody/shown_model.hpp"
#include "apps/xbody/xbody_pane.hpp"

namespace raks::apps {

/// What a window is named while it shows this model.
[[nodiscard]] std::string xbody_title(const ShownModel& model);

/// Three lines a sub-mesh: its name, what it is made of, its box.
[[nodiscard]] std::vector<XbodyLine> mesh_lines(const render::Model& model);

/// Format and counts, licence, what was mended or left out.
[[nodiscard]] std::vector<XbodyLine> file_lines(const ShownModel& model);

/// What a film is of, and where it goes. `folder`: empty is the current one.
[[nodiscard]] std::vector<XbodyLine> film_lines(const ShownModel& model,
                                                const std::filesystem::path& folder);

/// A text in lines of at most `width` letters, broken at spaces where there are some.
[[nodiscard]] std::vector<std::string> wrapped(std::string_view text, std::size_t width);

}  // namespace raks::apps
