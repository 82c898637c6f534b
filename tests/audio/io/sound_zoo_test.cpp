// What Raks reads of sound files is what ffmpeg decodes: over the zoo of scripts/sound_zoo.sh. With
// RAKS_SOUND_ZOO=whole in the environment over all of it, else over its short form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "audio/io/decoders.hpp"
#include "tests/support/extent.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio {
namespace {

namespace fs = std::filesystem;

constexpr double kSameLength = 0.020;  // seconds
constexpr double kLeastCorrelation = 0.999;
constexpr double kLargestShift = 0.030;  // seconds, for the alignment

/// The first channel at a rate.
struct Sound {
    int rate = 0;
    std::vector<float> samples;
    std::string warning;
};

Sound read_by_raks(const fs::path& path) {
    const auto reader = open_audio_file(path);
    if (!reader) {
        ADD_FAILURE() << reader.error().message;
        return {};
    }
    const auto channels = static_cast<std::size_t>((*reader)->info().channels);
    Sound sound{static_cast<int>((*reader)->info().rate.hertz()), {}, {}};
    std::vector<float> block(4096 * channels);
    while (const std::size_t frames = (*reader)->read(block)) {
        for (std::size_t i = 0; i < frames; ++i) {
            sound.samples.push_back(block[i * channels]);
        }
    }
    sound.warning = (*reader)->warning();
    return sound;
}

/// On the file's own time line: silence before what begins late, and in gaps.
Sound read_by_ffmpeg(const fs::path& path, int rate) {
    const std::string name = path.filename().string();
    const bool has_silence = name.starts_with("late-") || name.starts_with("gap-");
    const std::string bytes = raks::test::run_program(
        {"ffmpeg",
         "-v",
         "quiet",
         "-i",
         path.string(),
         "-map",
         "0:a:0",
         "-af",
         std::string(has_silence ? "aresample=async=1:first_pts=0," : "") + "pan=mono|c0=c0",
         "-ar",
         std::to_string(rate),
         "-f",
         "f32le",
         "-c:a",
         "pcm_f32le",
         "-"});
    Sound sound{rate, std::vector<float>(bytes.size() / sizeof(float)), {}};
    std::memcpy(sound.samples.data(), bytes.data(), sound.samples.size() * sizeof(float));
    return sound;
}

/// Samples [from, to) of ours and theirs, theirs moved by `shift`: normalized correlation.
double correlation(const Sound& ours,
                   const Sound& theirs,
                   std::int64_t shift,
                   std::int64_t from,
                   std::int64_t to) {
    double ab = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    from = std::max(from, -shift);
    to = std::min({to, std::ssize(ours.samples), std::ssize(theirs.samples) - shift});
    for (std::int64_t i = from; i < to; ++i) {
        const double x = ours.samples[static_cast<std::size_t>(i)];
        const double y = theirs.samples[static_cast<std::size_t>(i + shift)];
        ab += x * y;
        aa += x * x;
        bb += y * y;
    }
    return aa > 0.0 && bb > 0.0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// Of a stretch at the best small shift, which is found on its first 2.5 s: from none outwards as
/// far as it takes to be alike, and from there up to the top of this hill; over all where none is
/// alike.
double aligned_correlation(const Sound& ours,
                           const Sound& theirs,
                           std::int64_t from,
                           std::int64_t to) {
    const auto reach = static_cast<std::int64_t>(kLargestShift * ours.rate);
    const auto part = std::min(from + static_cast<std::int64_t>(2.5 * ours.rate), to);
    double best = -1.0;
    std::int64_t best_shift = 0;
    const auto take = [&](std::int64_t shift) {
        const double value = correlation(ours, theirs, shift, from, part);
        const bool is_better = value > best;
        if (is_better) {
            best = value;
            best_shift = shift;
        }
        return is_better;
    };
    for (std::int64_t shift = 0; shift <= reach && best < kLeastCorrelation; ++shift) {
        take(shift);
        take(-shift);
    }
    for (const std::int64_t step : {1, -1}) {
        while (std::abs(best_shift + step) <= reach && take(best_shift + step)) {
        }
    }
    return correlation(ours, theirs, best_shift, from, to);
}

/// Of all; the lower one of two parts where ffmpeg may place the second a little elsewhere. Of
/// joined files it leaves a codec's delay in, and behind a gap the time stamps are rounded.
double least_correlation(const fs::path& path, const Sound& ours, const Sound& theirs) {
    const std::int64_t all = std::ssize(ours.samples);
    const std::string name = path.filename().string();
    std::int64_t first_ends = all;
    std::int64_t second_begins = all;
    if (name.starts_with("joined-")) {
        first_ends = all / 2 - ours.rate / 10;
        second_begins = all / 2 + ours.rate / 10;
    } else if (name.starts_with("gap-")) {
        first_ends = 2 * ours.rate - ours.rate / 10;  // the gap is from 2 to 3.5 s
        second_begins = 37 * ours.rate / 10;
    }
    const double first = aligned_correlation(ours, theirs, 0, first_ends);
    return second_begins == all
               ? first
               : std::min(first, aligned_correlation(ours, theirs, second_begins, all));
}

void compare(const fs::path& path) {
    SCOPED_TRACE(path.filename().string());
    const Sound ours = read_by_raks(path);
    if (ours.rate == 0) {
        return;
    }
    const Sound theirs = read_by_ffmpeg(path, ours.rate);
    const double seconds = static_cast<double>(ours.samples.size()) / ours.rate;
    EXPECT_NEAR(seconds, static_cast<double>(theirs.samples.size()) / ours.rate, kSameLength)
        << ours.warning;
    EXPECT_GE(least_correlation(path, ours, theirs), kLeastCorrelation) << ours.warning;
    const bool is_cut = path.filename().string().starts_with("cut-");
    EXPECT_TRUE(is_cut || ours.warning.find("damaged") == std::string::npos)
        << "nothing is lost: " << ours.warning;
}

/// All samples and what is said, as raks-decode gives them and as they are decoded in this process.
void compare_with_this_process(const fs::path& path) {
    SCOPED_TRACE(path.filename().string());
    auto child = open_audio_file(path);
    auto here = open_by_decoders(path, *FileWindow::open(path));
    ASSERT_TRUE(child && here);
    EXPECT_EQ((*child)->info().format, (*here)->info().format);
    EXPECT_EQ((*child)->info().claimed_frames, (*here)->info().claimed_frames);
    ASSERT_EQ((*child)->info().channels, (*here)->info().channels);
    const auto channels = static_cast<std::size_t>((*here)->info().channels);
    std::vector<float> block(3'000 * channels);
    std::vector<float> other(block.size());
    for (std::size_t frames = 1; frames > 0;) {
        frames = (*here)->read(block);
        ASSERT_EQ((*child)->read(other), frames);
        // Bits: NaN is like itself.
        ASSERT_EQ(std::memcmp(block.data(), other.data(), frames * channels * sizeof(float)), 0);
    }
    EXPECT_EQ((*child)->warning(), (*here)->warning());
}

TEST(SoundZoo, is_read_as_ffmpeg_decodes_it) {
    const bool is_whole = raks::test::is_whole("RAKS_SOUND_ZOO");
    const raks::test::TemporaryFolder folder;
    static_cast<void>(
        raks::test::run_program({"bash",
                                 std::string(RAKS_SOURCE_DIR) + "/scripts/sound_zoo.sh",
                                 folder.path().string(),
                                 is_whole ? "whole" : "short"}));
    std::size_t count = 0;
    for (const auto& file : fs::directory_iterator(folder.path())) {
        compare(file.path());
        compare_with_this_process(file.path());
        ++count;
    }
    EXPECT_GE(count, is_whole ? 120U : 20U);
}

}  // namespace
}  // namespace raks::audio
