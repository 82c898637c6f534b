#include <array>
#include <cstdio>
#include <utility>

#include "base/file.hpp"
#include "render/video/png.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {
namespace {

namespace fs = std::filesystem;

/// Writes NAME.part/000001.png, ... and renames the folder at the end.
class PictureFolder final : public VideoWriter {
 public:
    PictureFolder(fs::path path, PendingFile folder, const VideoOptions& options)
        : path_(std::move(path)), folder_(std::move(folder)), options_(options) {}

    Expected<void> add_picture(std::span<const std::uint8_t> rgba) override {
        if (auto fits = check_picture(rgba, options_); !fits) {
            return fail(std::move(fits.error()).in(path_.string()));
        }
        std::array<char, 32> name{};
        // Numbered from 1; six digits sort by name for 9 hours at 30 pictures a second.
        std::snprintf(name.data(), name.size(), "%06lld.png", ++pictures_);
        return write_png(folder_.part() / name.data(), options_.width, options_.height, rgba);
    }

    Expected<void> add_sound(std::span<const float> /*interleaved*/) override { return {}; }

    // The folder gets its name only when complete, like a film.
    Expected<void> finish() override {
        if (pictures_ == 0) {
            return fail(path_.string() + ": no picture was drawn; nothing is written");
        }
        return folder_.commit();
    }

 private:
    fs::path path_;
    PendingFile folder_;
    VideoOptions options_;
    long long pictures_ = 0;
};

}  // namespace

Expected<std::unique_ptr<VideoWriter>> create_picture_folder(const fs::path& path,
                                                             const VideoOptions& options) {
    auto folder = PendingFile::create_folder(path);
    if (!folder) {
        return fail(folder.error());
    }
    return std::make_unique<PictureFolder>(path, std::move(*folder), options);
}

}  // namespace raks::render
