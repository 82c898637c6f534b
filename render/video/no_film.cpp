#include "render/video/video_forms.hpp"

namespace raks::render {

// Stands for film.cpp where the build has no FFmpeg.
Expected<std::unique_ptr<VideoWriter>> create_film(const std::filesystem::path& path,
                                                   FilmForm /*form*/,
                                                   const VideoOptions& /*options*/) {
    return fail(path.string() +
                ": this build has no FFmpeg; name a folder to get numbered .png pictures");
}

}  // namespace raks::render
