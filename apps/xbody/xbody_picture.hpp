// A picture of a model with its bones, without a window.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "apps/xbody/shown_model.hpp"
#include "base/expected.hpp"
#include "engine/setup/settings.hpp"

namespace raks::apps {

/// What is drawn.
struct XbodyPicture {
    std::size_t frame = 0;               ///< of the clip
    std::string view = "front";          ///< or side, back, top
    engine::PictureSize size{960, 720};  ///< pixels
    bool has_names = false;              ///< beside the bones
};
/// Draws the model off-screen and writes it as PNG. Errors: a frame that the clip does not have, no
/// OpenGL, those of the file. Threads: main.
[[nodiscard]] Expected<void> write_xbody_picture(const std::filesystem::path& output,
                                                 const ShownModel& model,
                                                 const XbodyPicture& picture);

}  // namespace raks::apps
