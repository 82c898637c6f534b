#include <array>
#include <cstdio>
#include <system_error>
#include <utility>

#include "render/video/png.hpp"
#include "render/video/video_forms.hpp"

namespace raks::render {
namespace {

namespace fs = std::filesystem;

/// Writes NAME.part/000001.png, ... and renames the folder at the end.
class PictureFolder final : public VideoWriter {
 public:
    PictureFolder(fs::path path, fs::path part, const VideoOptions& options)
        : path_(std::move(path)), part_(std::move(part)), options_(options) {}

    ~PictureFolder() override {
        if (!part_.empty()) {
            std::error_code ignored;
            fs::remove_all(part_, ignored);
        }
    }
    PictureFolder(const PictureFolder&) = delete;
    PictureFolder& operator=(const PictureFolder&) = delete;

    Expected<void> add_picture(std::span<const std::uint8_t> rgba) override {
        if (auto fits = check_picture(rgba, options_); !fits) {
            return fail(std::move(fits.error()).in(path_.string()));
        }
        std::array<char, 32> name{};
        std::snprintf(name.data(), name.size(), "%06lld.png", ++pictures_);
        return write_png(part_ / name.data(), options_.width, options_.height, rgba);
    }

    Expected<void> add_sound(std::span<const float> /*interleaved*/) override { return {}; }

    Expected<void> finish() override {
        if (pictures_ == 0) {
            return fail(path_.string() + ": no picture was drawn; nothing is written");
        }
        std::error_code error;
        fs::rename(part_, path_, error);  // replaces an empty folder
        if (error) {
            return fail(path_.string() + ": cannot be written: " + error.message());
        }
        part_.clear();
        return {};
    }

 private:
    fs::path path_;
    fs::path part_;  // empty once finished
    VideoOptions options_;
    long long pictures_ = 0;
};

}  // namespace

Expected<std::unique_ptr<VideoWriter>> create_picture_folder(const fs::path& path,
                                                             const VideoOptions& options) {
    const fs::path folder = path.has_filename() ? path : path.parent_path();
    std::error_code error;
    if (fs::exists(folder, error) &&
        !(fs::is_directory(folder, error) && fs::is_empty(folder, error))) {
        return fail(folder.string() + ": exists already and is not an empty folder; name another");
    }
    fs::path part = folder;
    part += ".part";
    fs::remove_all(part, error);  // what a killed run left
    fs::create_directory(part, error);
    if (error || !fs::is_directory(part, error)) {
        return fail(folder.string() + ": cannot be written: " + error.message());
    }
    return std::make_unique<PictureFolder>(folder, std::move(part), options);
}

}  // namespace raks::render
