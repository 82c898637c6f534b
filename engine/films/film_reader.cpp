#include "engine/films/film_reader.hpp"

#include <fmt/format.h>

#include <utility>

#include "engine/films/film_child.hpp"
#include "engine/films/numbered_pictures.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using NextPicture = Expected<std::optional<FilmPicture>>;

/// A film in one file.
class FilmFile final : public FilmReader {
 public:
    explicit FilmFile(std::unique_ptr<FilmChild> child) : child_(std::move(child)) {}

    [[nodiscard]] Expected<void> open(const fs::path& path) {
        auto info = child_->open(path);
        if (!info) {
            return fail(info.error());
        }
        info_ = std::move(*info);
        return {};
    }

    NextPicture next() override {
        auto picture = child_->next();
        warning_ = child_->warning();
        return picture;
    }

 private:
    std::unique_ptr<FilmChild> child_;
};

/// A folder of pictures: each a film of one picture.
class PictureFolder final : public FilmReader {
 public:
    PictureFolder(std::unique_ptr<FilmChild> child, double rate)
        : child_(std::move(child)), rate_(rate) {}

    [[nodiscard]] Expected<void> open(const fs::path& folder) {
        auto pictures = list_numbered_pictures(folder);
        if (!pictures) {
            return fail(pictures.error());
        }
        pictures_ = std::move(*pictures);
        const auto first = child_->open(pictures_.front().path);
        if (!first) {
            return fail(first.error());
        }
        info_ = *first;
        info_.pictures_per_second = rate_;
        info_.claimed_seconds = seconds_of(pictures_.back()) + 1.0 / rate_;
        info_.format = "pictures";
        return {};
    }

    NextPicture next() override {
        if (at_ == pictures_.size()) {
            return std::nullopt;
        }
        const NumberedPicture& numbered = pictures_[at_];
        if (at_ > 0) {
            if (const auto opened = child_->open(numbered.path); !opened) {
                return fail(opened.error());
            }
        }
        auto picture = child_->next();
        if (!picture || !*picture) {
            return picture ? fail(numbered.path.string() + ": is not a picture") : picture;
        }
        if (const auto end = child_->next(); !end || *end) {
            return end ? fail(numbered.path.string() + ": holds several pictures, must be one")
                       : end;
        }
        return check_size(numbered, std::move(**picture));
    }

 private:
    [[nodiscard]] double seconds_of(const NumberedPicture& picture) const {
        return static_cast<double>(picture.number - pictures_.front().number) / rate_;
    }

    // The size of the first picture holds: a photograph's own turn may show in its pixels only.
    NextPicture check_size(const NumberedPicture& numbered, FilmPicture picture) {
        if (at_ == 0) {
            info_.width = picture.width;
            info_.height = picture.height;
        }
        if (picture.width != info_.width || picture.height != info_.height) {
            return fail(fmt::format("{}: has {} x {} pixels, but the first picture {} x {}",
                                    numbered.path.string(),
                                    picture.width,
                                    picture.height,
                                    info_.width,
                                    info_.height));
        }
        if (warning_.empty()) {
            warning_ = child_->warning();
        }
        picture.seconds = seconds_of(numbered);
        ++at_;
        return picture;
    }

    std::unique_ptr<FilmChild> child_;
    double rate_;
    std::vector<NumberedPicture> pictures_;
    std::size_t at_ = 0;  // of the next
};

template <typename Reader>
Expected<std::unique_ptr<FilmReader>> opened(std::unique_ptr<Reader> reader, const fs::path& path) {
    if (auto done = reader->open(path); !done) {
        return fail(done.error());
    }
    return std::unique_ptr<FilmReader>(std::move(reader));
}

}  // namespace

Expected<std::unique_ptr<FilmReader>> FilmReader::open(const fs::path& path,
                                                       const FilmOptions& options) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) {
        return fail(path.string() + ": is not there");
    }
    // A pipe would keep one waiting, and films are read with seeks.
    if (!fs::is_directory(status) && !fs::is_regular_file(status)) {
        return fail(path.string() + ": is neither a file nor a folder");
    }
    auto child = FilmChild::start(options.is_stop_requested);
    if (!child) {
        return fail(path.string() + ": " + child.error().message);
    }
    if (fs::is_directory(status)) {
        return opened(
            std::make_unique<PictureFolder>(std::move(*child), options.folder_pictures_per_second),
            path);
    }
    return opened(std::make_unique<FilmFile>(std::move(*child)), path);
}

}  // namespace raks::engine
