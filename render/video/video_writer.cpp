#include "render/video/video_writer.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/file_set.hpp"
#include "base/pending_file.hpp"
#include "render/video/png.hpp"
#include "render/video/straight_alpha.hpp"
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
        if (failure_) {
            return fail(*failure_);
        }
        if (auto fits = check_picture(rgba, options_); !fits) {
            return fail(std::move(fits.error()).in(path_.string()));
        }
        if (options_.has_alpha) {
            straight_.assign(rgba.begin(), rgba.end());
            make_straight(straight_);
            rgba = straight_;
        }
        std::array<char, 32> name{};
        // Numbered from 1; six digits sort by name for 9 hours at 30 pictures a second.
        std::snprintf(name.data(), name.size(), "%06lld.png", pictures_ + 1);
        auto written =
            write_png(folder_.part() / name.data(), options_.width, options_.height, rgba);
        if (!written) {
            return give_up(named_as(path_, folder_.part(), std::move(written.error())));
        }
        if (++pictures_ == 1) {
            folder_.keep_from_here();
        }
        return {};
    }

    Expected<void> add_sound(std::span<const float> /*interleaved*/) override { return {}; }

    // The folder gets its name only when complete, like a film.
    Expected<void> finish() override {
        auto checked = check_has_pictures();
        return checked ? folder_.commit() : checked;
    }

    Expected<fs::path> finish_stopped() override {
        auto checked = check_has_pictures();
        return checked ? folder_.commit_stopped() : fail(std::move(checked.error()));
    }

 private:
    // As a rule the disk is full: the pictures before are kept.
    [[nodiscard]] tl::unexpected<Error> give_up(Error why) {
        failure_ = std::move(why);
        if (pictures_ > 0) {
            if (const auto kept = folder_.commit_stopped()) {
                failure_->message += "; the pictures before lie in " + kept->string();
            }
        }
        return fail(*failure_);
    }
    [[nodiscard]] Expected<void> check_has_pictures() const {
        if (failure_) {
            return fail(*failure_);
        }
        return pictures_ > 0 ? Expected<void>()
                             : fail(path_.string() + ": no picture was drawn; nothing is written");
    }

    fs::path path_;
    PendingFile folder_;
    VideoOptions options_;
    std::vector<std::uint8_t> straight_;  // of a picture with alpha
    long long pictures_ = 0;
    std::optional<Error> failure_;
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

FrameRate FrameRate::nearest(double fps) noexcept {
    // What television means by 23.976 (or 23.98), 29.97, 59.94 and their doubles.
    for (const int whole : std::array{24, 30, 48, 60, 120, 240}) {
        if (std::abs(fps - whole * 1000.0 / 1001.0) < 0.005) {
            return {whole * 1000, 1001};
        }
    }
    // Everything else is a fraction of thousandths in lowest terms; the bound keeps the int in
    // range.
    const int thousandths = static_cast<int>(std::lround(std::min(fps, 1e6) * 1000.0));
    const int common = std::gcd(thousandths, 1000);
    return {thousandths / common, 1000 / common};
}

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
bool is_for_folder(const std::filesystem::path& path) {
    std::error_code ignored;
    return path.extension().empty() || std::filesystem::is_directory(path, ignored);
}

/// Whether a form's codec has it.
bool has_alpha(FilmForm form) { return form == FilmForm::mov || form == FilmForm::webm; }

/// The form of a film, which must be one with even sides. Errors: an unknown ending, odd sides.
Expected<FilmForm> check_film(const std::filesystem::path& path, const VideoOptions& options) {
    const std::string extension = lower_extension(path);
    const auto form = film_form_of(extension);
    if (!form) {
        return fail(
            path.string() + ": unknown kind of film \"" + extension +
            "\"; known: .mp4, .mkv, .webm, .avi, with alpha .mov, or a folder for numbered .png "
            "pictures");
    }
    if (options.has_alpha && !has_alpha(*form)) {
        return fail(path.string() + ": a " + extension +
                    " has no alpha; use .mov, .webm, or a folder for numbered .png pictures");
    }
    if (!options.has_alpha && *form == FilmForm::mov) {
        return fail(path.string() + ": a .mov is written with alpha alone; use .mp4");
    }
    if (auto even = check_even(options); !even) {
        return fail(std::move(even.error()).in(path.string()));
    }
    return *form;
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

bool VideoWriter::keeps_alpha(const std::filesystem::path& path) {
    const auto form = film_form_of(lower_extension(path));
    return is_for_folder(path) || (form && has_alpha(*form));
}

Expected<void> VideoWriter::check(const std::filesystem::path& path, const VideoOptions& options) {
    if (auto valid = check_options(options); !valid) {
        return fail(std::move(valid.error()).in(path.string()));
    }
    if (is_for_folder(path)) {
        const auto folder = PendingFile::create_folder(path);
        return folder ? Expected<void>() : fail(folder.error());
    }
    const auto form = check_film(path, options);
    return form ? check_output(path, {}) : fail(form.error());
}

Expected<std::unique_ptr<VideoWriter>> VideoWriter::create(const std::filesystem::path& path,
                                                           const VideoOptions& options) {
    if (auto valid = check_options(options); !valid) {
        return fail(std::move(valid.error()).in(path.string()));
    }
    if (is_for_folder(path)) {
        return create_picture_folder(path, options);
    }
    const auto form = check_film(path, options);
    return form ? create_film(path, *form, options) : fail(form.error());
}

}  // namespace raks::render
