#include <iterator>

#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

std::ptrdiff_t threads_of_this_process() {
    const std::filesystem::directory_iterator threads("/proc/self/task");
    return std::distance(begin(threads), end(threads));
}

// A third would be x264's that looks ahead, which at times loses a picture.
TEST(FilmEncoders, h264_has_two_threads_that_encode_and_no_other) {
    const raks::test::TemporaryFolder folder;
    for (const VideoQuality quality :
         {VideoQuality::draft, VideoQuality::normal, VideoQuality::high}) {
        const std::ptrdiff_t before = threads_of_this_process();
        const auto film = VideoWriter::create(folder / "film.mp4",
                                              {.width = 64, .height = 48, .quality = quality});
        ASSERT_TRUE(film) << film.error().message;
        EXPECT_EQ(threads_of_this_process(), before + 2);
    }
}

}  // namespace
}  // namespace raks::render
