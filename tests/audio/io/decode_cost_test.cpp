// What decoding in another program costs, against the same decoders in this one: CPU time of both
// programs for whole files, time until the first samples behind a seek. Pairs, one after the other,
// in one run. RAKS_DECODE_COST=20 in the environment makes so many of each.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "audio/io/decoders.hpp"
#include "audio/io/file_window.hpp"
#include "audio/io/wav_writer.hpp"
#include "base/random.hpp"
#include "tests/audio/io/sound_files.hpp"
#include "tests/support/extent.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

namespace fs = std::filesystem;
using Open = std::function<std::unique_ptr<AudioFileReader>()>;

constexpr double kSeconds = 120.0;  // of the music

/// Of this process and of all children that have ended.
double cpu_seconds() {
    double sum = 0.0;
    for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
        rusage used{};
        getrusage(who, &used);
        for (const timeval& time : {used.ru_utime, used.ru_stime}) {
            sum += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
        }
    }
    return sum;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// CPU seconds to open a file, decode all of it and close it.
double decode_all(const Open& open) {
    const double before = cpu_seconds();
    auto reader = open();
    std::vector<float> block(512U * static_cast<std::size_t>(reader->info().channels));
    while (reader->read(block) > 0) {
    }
    reader.reset();
    return cpu_seconds() - before;
}

/// Milliseconds of the clock from asking for a place to its first samples.
double seek_once(AudioFileReader& reader, double seconds) {
    std::vector<float> block(512U * static_cast<std::size_t>(reader.info().channels));
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(reader.seek(static_cast<std::int64_t>(seconds * reader.info().rate.hertz())));
    EXPECT_GT(reader.read(block), 0U);
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
        .count();
}

class DecodeCost : public test::SoundFilesTest {
 protected:
    void SetUp() override {
        if (!raks::test::number_from("RAKS_DECODE_COST")) {
            GTEST_SKIP() << "RAKS_DECODE_COST=20 in the environment runs it: it takes minutes";
        }
        pairs_ = *raks::test::number_from("RAKS_DECODE_COST");
        const auto music = test::drums(kSeconds, 44'100, 2);
        const fs::path wav = folder_ / "x.wav";
        ASSERT_TRUE(write_wav(wav, music.samples, 2, music.rate));
        files_ = {wav};
        for (const char* name : {"x.flac", "x.mp3", "x.m4a", "x.ogg"}) {
            files_.push_back(encode(wav, name));
        }
    }
    static Open in_child(const fs::path& path) {
        return [path] { return open_audio_file(path).value(); };
    }
    static Open in_this_process(const fs::path& path) {
        return [path] { return open_by_decoders(path, *FileWindow::open(path)).value(); };
    }

    std::int64_t pairs_ = 0;
    std::vector<fs::path> files_;
};

TEST_F(DecodeCost, is_at_most_a_few_hundredths_of_the_decoding) {
    for (const fs::path& file : files_) {
        std::vector<double> here;
        std::vector<double> ratios;
        for (std::int64_t i = 0; i < pairs_; ++i) {
            here.push_back(decode_all(in_this_process(file)));
            ratios.push_back(decode_all(in_child(file)) / here.back());
        }
        std::cout << fmt::format("{}: {:.1f} ms of CPU here, in a child {:+.1f} %\n",
                                 file.extension().string(),
                                 1e3 * median(here),
                                 100.0 * (median(ratios) - 1.0));
    }
}

TEST_F(DecodeCost, a_seek_takes_hardly_longer) {
    const CounterRandom random(1);
    std::uint64_t drawn = 0;
    for (const fs::path& file : files_) {
        const auto here = in_this_process(file)();
        const auto child = in_child(file)();
        std::vector<double> one;
        std::vector<double> longer;
        for (std::int64_t i = 0; i < 10 * pairs_; ++i) {
            const double place = 1e-3 * static_cast<double>(random.below(drawn++, 115'000));
            one.push_back(seek_once(*here, place));
            longer.push_back(seek_once(*child, place) - one.back());
        }
        std::cout << fmt::format("{}: {:.2f} ms here, in a child {:+.2f} ms more\n",
                                 file.extension().string(),
                                 median(one),
                                 median(longer));
        EXPECT_LE(median(longer), 20.0);
    }
}

}  // namespace
}  // namespace raks::audio
