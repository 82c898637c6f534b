#include "apps/raks_capture/film_pictures.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "render/video/png.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::apps {
namespace {

constexpr int kSide = 16;

/// Two films of numbered pictures, whose grey tells which they are.
class FilmPicturesTest : public ::testing::Test {
 protected:
    FilmPicturesTest() {
        for (const int film : {0, 1}) {
            const auto folder = folder_ / ("film" + std::to_string(film));
            std::filesystem::create_directories(folder);
            for (int number = 0; number < 6; ++number) {
                const std::vector<std::uint8_t> rgba(
                    std::size_t{4} * kSide * kSide,
                    static_cast<std::uint8_t>(100 * film + 10 * number));
                EXPECT_TRUE(render::write_png(
                    folder / ("p" + std::to_string(number) + ".png"), kSide, kSide, rgba));
            }
            films_.push_back({"cam", folder});
        }
    }

    /// What is shown once it is what is waited for.
    static ShownPicture shown_when(const FilmPictures& pictures,
                                   std::size_t film,
                                   const std::function<bool(const ShownPicture&)>& is_right) {
        for (;;) {
            const ShownPicture shown = pictures.shown(film);
            if (is_right(shown)) {
                return shown;
            }
            std::this_thread::yield();
        }
    }
    static int grey(FilmPictures& pictures, std::size_t film, std::size_t number) {
        pictures.want(film, number);
        const ShownPicture shown = shown_when(pictures, film, [&](const ShownPicture& one) {
            return one.picture != nullptr && one.number == number;
        });
        return shown.picture->rgb.front();
    }

    test::TemporaryFolder folder_;
    std::vector<CameraFilm> films_;
};

TEST_F(FilmPicturesTest, gives_any_picture_of_any_film_on_and_back) {
    FilmPictures pictures(films_);
    EXPECT_EQ(grey(pictures, 0, 0), 0);
    EXPECT_EQ(grey(pictures, 1, 3), 130);
    EXPECT_EQ(grey(pictures, 0, 5), 50);
    EXPECT_EQ(grey(pictures, 1, 1), 110);
    EXPECT_EQ(grey(pictures, 1, 2), 120);
    EXPECT_TRUE(pictures.take_news());
    EXPECT_FALSE(pictures.take_news());
}

TEST_F(FilmPicturesTest, says_how_many_there_are_where_too_late_a_one_is_asked_for) {
    FilmPictures pictures(films_);
    pictures.want(0, 40);
    const ShownPicture shown =
        shown_when(pictures, 0, [](const ShownPicture& one) { return !one.problem.empty(); });
    EXPECT_EQ(shown.count, 6U);
    EXPECT_EQ(shown.picture, nullptr);
    EXPECT_EQ(grey(pictures, 0, 5), 50);
}

TEST_F(FilmPicturesTest, says_why_a_film_cannot_be_read) {
    films_[1].path = folder_ / "none.mp4";
    FilmPictures pictures(films_);
    pictures.want(1, 0);
    const ShownPicture shown =
        shown_when(pictures, 1, [](const ShownPicture& one) { return !one.problem.empty(); });
    EXPECT_NE(shown.problem.find("none.mp4"), std::string::npos);
}

TEST_F(FilmPicturesTest, a_camera_without_a_film_has_no_pictures_and_ends_at_once) {
    films_[0].path.clear();
    FilmPictures pictures(films_);
    pictures.want(0, 0);
    pictures.want(1, 5);
    EXPECT_EQ(pictures.shown(0).picture, nullptr);
}

}  // namespace
}  // namespace raks::apps
