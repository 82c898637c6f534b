#include "render/video/video_writer.hpp"

#include <algorithm>
#include <cctype>
#include <string>

#include "render/video/video_forms.hpp"

namespace raks::render {
namespace {

// Limits as in VideoOptions.
constexpr int kMinSide = 16;
constexpr int kMaxSide = 8192;
constexpr double kMinFps = 1.0;
constexpr double kMaxFps = 240.0;

/// "1280x720".
std::string size_text(int width, int height) {
    return std::to_string(width) + "x" + std::to_string(height);
}

/// The first fault of the options that every form shares, or nothing.
Expected<void> check_options(const VideoOptions& options) {
    if (std::min(options.width, options.height) < kMinSide ||
        std::max(options.width, options.height) > kMaxSide) {
        return fail("a picture of " + size_text(options.width, options.height) +
                    " cannot be written; each side must be " + std::to_string(kMinSide) + " to " +
                    std::to_string(kMaxSide));
    }
    if (options.rate.numerator <= 0 || options.rate.denominator <= 0 ||
        options.rate.fps() < kMinFps || options.rate.fps() > kMaxFps) {
        return fail("a rate of " + std::to_string(options.rate.numerator) + "/" +
                    std::to_string(options.rate.denominator) +
                    " pictures a second; must be 1 to 240");
    }
    if (options.audio_channels < 0 || options.audio_channels > 2) {
        return fail("sound of " + std::to_string(options.audio_channels) +
                    " channels; must be 1 or 2, or 0 for none");
    }
    if (options.audio_channels > 0 &&
        (options.audio_rate < 8'000 || options.audio_rate > 192'000)) {
        return fail("sound of " + std::to_string(options.audio_rate) +
                    " Hz; must be 8000 to 192000");
    }
    return {};
}

/// 4:2:0 halves the colour's resolution both ways, so films need even sides.
Expected<void> check_even(const VideoOptions& options) {
    if (options.width % 2 != 0 || options.height % 2 != 0) {
        return fail("a film of " + size_text(options.width, options.height) +
                    " cannot be encoded; sides must be even: use " +
                    size_text(options.width / 2 * 2, options.height / 2 * 2));
    }
    return {};
}

/// ".MP4" means ".mp4".
std::string lower_extension(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    return extension;
}

/// No extension means a folder, and so does a folder that exists, whatever its name.
Expected<std::unique_ptr<VideoWriter>> create_by_extension(const std::filesystem::path& path,
                                                           const VideoOptions& options) {
    const std::string extension = lower_extension(path);
    std::error_code ignored;
    if (extension.empty() || std::filesystem::is_directory(path, ignored)) {
        return create_picture_folder(path, options);
    }
    if (extension != ".mp4" && extension != ".avi") {
        return fail(path.string() + ": unknown kind of film \"" + extension +
                    "\"; known: .mp4, .avi, or a folder for numbered .png pictures");
    }
    if (auto even = check_even(options); !even) {
        return fail(std::move(even.error()).in(path.string()));
    }
    return create_film(path, extension == ".mp4" ? FilmForm::mp4 : FilmForm::avi, options);
}

}  // namespace

Expected<void> check_picture(std::span<const std::uint8_t> rgba, const VideoOptions& options) {
    const std::size_t bytes =
        static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height) * 4;
    if (rgba.size() != bytes) {
        return fail("a picture of " + size_text(options.width, options.height) + " does not have " +
                    std::to_string(rgba.size()) + " bytes");
    }
    return {};
}

Expected<std::unique_ptr<VideoWriter>> VideoWriter::create(const std::filesystem::path& path,
                                                           const VideoOptions& options) {
    if (auto valid = check_options(options); !valid) {
        return fail(std::move(valid.error()).in(path.string()));
    }
    return create_by_extension(path, options);
}

}  // namespace raks::render
