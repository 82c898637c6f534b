#include <algorithm>

#include "tests/render/video/film_support.hpp"

namespace raks::render {
namespace {

struct SyncCase {
    const char* name;
    FrameRate rate;
    int audio_rate;
    int channels;
    double sound_lead;  // seconds that the sound is added ahead of the pictures; < 0: behind
};

constexpr int kFilmWidth = 64;
constexpr int kFilmHeight = 48;
constexpr int kSyncPictures = 100;
constexpr int kFlashEvery = 20;
constexpr std::size_t kChannel = 0;
constexpr double kAacFrame = 1024.0;  // samples

std::int64_t sample_of_picture(const SyncCase& c, int picture) {
    return std::int64_t{picture} * c.audio_rate * c.rate.denominator / c.rate.numerator;
}

/// Sound with a click (a 2 ms burst of 2 kHz) at the first sample of every flashing picture.
std::vector<float> clicks(const SyncCase& c) {
    const auto total = static_cast<std::size_t>(sample_of_picture(c, kSyncPictures));
    const auto channels = static_cast<std::size_t>(c.channels);
    std::vector<float> sound(total * channels);
    for (int picture = kFlashEvery; picture < kSyncPictures; picture += kFlashEvery) {
        const auto start = static_cast<std::size_t>(sample_of_picture(c, picture));
        const auto length = static_cast<std::size_t>(c.audio_rate / 500);
        for (std::size_t i = start; i < std::min(start + length, total); ++i) {
            const double t = static_cast<double>(i - start) / c.audio_rate;
            sound[i * channels + kChannel] =
                static_cast<float>(0.8 * std::cos(2.0 * M_PI * 2000.0 * t));
        }
    }
    return sound;
}

/// Times (s) at which |x| first passes half of its greatest value after 50 ms below it.
std::vector<double> onsets(const std::vector<float>& x, double rate) {
    float peak = 0.0F;
    for (const float sample : x) {
        peak = std::max(peak, std::abs(sample));
    }
    std::vector<double> times;
    double last = -1.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        if (std::abs(x[i]) > 0.5F * peak) {
            const double time = static_cast<double>(i) / rate;
            if (time - last > 0.05) {
                times.push_back(time);
            }
            last = time;
        }
    }
    return times;
}

void write_film(const std::filesystem::path& path, const SyncCase& c) {
    auto film = VideoWriter::create(path,
                                    {.width = kFilmWidth,
                                     .height = kFilmHeight,
                                     .rate = c.rate,
                                     .audio_rate = c.audio_rate,
                                     .audio_channels = c.channels});
    ASSERT_TRUE(film) << film.error().message;
    const std::vector<float> sound = clicks(c);
    const auto channels = static_cast<std::size_t>(c.channels);
    std::size_t added = 0;
    const auto add_sound_until = [&](double seconds) {
        const double wanted = std::max(0.0, seconds * c.audio_rate);
        const std::size_t until =
            std::min(sound.size(), static_cast<std::size_t>(wanted) * channels);
        while (added < until) {  // in uneven blocks
            const std::size_t block = std::min(until - added, std::size_t{777} * channels);
            ASSERT_TRUE((*film)->add_sound(std::span(sound).subspan(added, block)));
            added += block;
        }
    };
    const Rgba dark = plain_picture(kFilmWidth, kFilmHeight, 10, 10, 10);
    const Rgba flash = plain_picture(kFilmWidth, kFilmHeight, 240, 240, 240);
    for (int picture = 0; picture < kSyncPictures; ++picture) {
        add_sound_until(picture / c.rate.fps() + c.sound_lead);
        const bool is_flash = picture > 0 && picture % kFlashEvery == 0;
        ASSERT_TRUE((*film)->add_picture(is_flash ? flash : dark));
    }
    add_sound_until(1e6);
    const auto finished = (*film)->finish();
    ASSERT_TRUE(finished) << finished.error().message;
}

class FilmSync : public testing::TestWithParam<std::tuple<const char*, SyncCase>> {};

TEST_P(FilmSync, a_flash_is_seen_when_its_click_is_heard) {
    const auto& [extension, c] = GetParam();
    const raks::test::TemporaryFolder folder;
    const auto path = folder / (std::string("sync") + extension);
    ASSERT_NO_FATAL_FAILURE(write_film(path, c));

    // Both tracks start at 0 and end together.
    const double seconds = kSyncPictures / c.rate.fps();
    const bool is_mp4 = path.extension() == ".mp4";
    const bool is_matroska = path.extension() == ".mkv" || path.extension() == ".webm";
    // Opus has one rate for all.
    const double sound_rate = is_matroska ? 48'000 : c.audio_rate;
    if (is_matroska) {  // the encoder's delay, which decoders drop, lies before the start
        EXPECT_EQ(std::stod(probe(path, "v:0", "start_time")), 0.0);
        EXPECT_NEAR(std::stod(probe(path, "a:0", "start_time")), -0.0065, 0.001);
    }
    if (is_mp4) {  // an .avi holds neither: both start at once, its PCM ends where it ends
        EXPECT_EQ(std::stod(probe(path, "v:0", "start_time")), 0.0);
        EXPECT_EQ(std::stod(probe(path, "a:0", "start_time")), 0.0);
        EXPECT_NEAR(std::stod(probe(path, "v:0", "duration")), seconds, 0.001);
        EXPECT_NEAR(std::stod(probe(path, "a:0", "duration")), seconds, 0.001);
    }

    const std::string grey = decoded_grey(path);
    ASSERT_EQ(grey.size(), std::size_t{kFilmWidth} * kFilmHeight * kSyncPictures);
    std::vector<double> flashes;
    for (std::size_t picture = 0; picture < kSyncPictures; ++picture) {
        const auto middle = static_cast<std::uint8_t>(
            grey[(picture * kFilmHeight + kFilmHeight / 2) * kFilmWidth + kFilmWidth / 2]);
        if (middle > 128) {
            flashes.push_back(static_cast<double>(picture) / c.rate.fps());
        }
    }
    const std::vector<float> sound = decoded_sound(path);
    // Decoders hand out the last AAC frame whole; that the track ends before is in the container.
    const double audible_length = static_cast<double>(sound.size()) / sound_rate;
    EXPECT_GE(audible_length, seconds - 1.0 / sound_rate);
    // Matroska counts in milliseconds.
    EXPECT_LE(audible_length,
              seconds + (is_mp4        ? kAacFrame / c.audio_rate
                         : is_matroska ? 0.001
                                       : 0.0));
    const std::vector<double> heard = onsets(sound, sound_rate);

    ASSERT_EQ(flashes.size(), std::size_t{kSyncPictures / kFlashEvery - 1});
    ASSERT_EQ(heard.size(), flashes.size());
    for (std::size_t i = 0; i < heard.size(); ++i) {
        // Half a period of the click: AAC smears its edge; a lost priming would be 21 ms.
        EXPECT_NEAR(heard[i], flashes[i], 0.00026) << "flash " << i;
    }
}

constexpr std::array kCases = {
    SyncCase{"together", {25, 1}, 48'000, 2, 0.0},
    SyncCase{"ntsc_44k", {30'000, 1001}, 44'100, 2, 0.0},
    SyncCase{"sound_all_before", {30, 1}, 48'000, 2, 1e6},
    SyncCase{"sound_all_after", {60, 1}, 48'000, 1, -1e6},
    SyncCase{"low_rate", {24, 1}, 16'000, 1, 0.1},
};

INSTANTIATE_TEST_SUITE_P(forms_and_rates,
                         FilmSync,
                         testing::Combine(testing::Values(".mp4", ".mkv", ".webm", ".avi"),
                                          testing::ValuesIn(kCases)),
                         [](const auto& test_case) {
                             return std::string(std::get<0>(test_case.param)).substr(1) + "_" +
                                    std::get<1>(test_case.param).name;
                         });

TEST(FilmLength, sound_that_is_short_is_filled_and_sound_that_is_long_is_cut) {
    const raks::test::TemporaryFolder folder;
    for (const double seconds : {0.3, 3.0}) {
        for (const char* const name : {"length.mp4", "length.avi"}) {
            const auto path = folder / name;
            auto film = VideoWriter::create(path, {.width = 64, .height = 48, .audio_channels = 1});
            ASSERT_TRUE(film) << film.error().message;
            const std::vector<float> sound(static_cast<std::size_t>(seconds * 48'000), 0.25F);
            ASSERT_TRUE((*film)->add_sound(sound));
            for (int i = 0; i < 30; ++i) {
                ASSERT_TRUE((*film)->add_picture(plain_picture(64, 48, 9, 9, 9)));
            }
            ASSERT_TRUE((*film)->finish());
            const std::vector<float> heard = decoded_sound(path);
            const double length = path.extension() == ".mp4"
                                      ? std::stod(probe(path, "a:0", "duration"))
                                      : static_cast<double>(heard.size()) / 48'000;
            EXPECT_NEAR(length, 1.0, 1e-4) << name << " " << seconds;
            ASSERT_GE(heard.size(), 48'000U);
            EXPECT_NEAR(heard[7'200], 0.25F, 0.01) << name << " " << seconds;
            EXPECT_NEAR(heard[40'000], seconds > 1.0 ? 0.25F : 0.0F, 0.01) << name;
        }
    }
}

}  // namespace
}  // namespace raks::render
