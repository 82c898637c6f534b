#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "audio/io/audio_file.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::audio::test {

/// A folder of its own for each test, gone afterwards.
class SoundFilesTest : public ::testing::Test {
 protected:
    /// Encodes `wav` by the ffmpeg program; the name's ending says into what.
    std::filesystem::path encode(const std::filesystem::path& wav,
                                 const std::string& name,
                                 const std::string& options = "") const {
        std::filesystem::path out = folder_ / name;
        const std::string command = "ffmpeg -nostdin -loglevel error -y -i '" + wav.string() +
                                    "' " + options + " '" + out.string() + "'";
        EXPECT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(concurrency-mt-unsafe)
        return out;
    }

    raks::test::TemporaryFolder folder_;
};

/// Some drums: broad-band, and different everywhere.
inline GeneratedMusic drums(double seconds, int rate, int channels) {
    return generate({.style = Style::drums,
                     .tempo = {{0.0, 133.0}},
                     .seconds = seconds,
                     .rate = SampleRate(rate),
                     .channels = channels})
        .value();
}

/// All that a reader still gives, read in blocks of `block` frames.
inline std::vector<float> read_rest(AudioFileReader& reader, std::size_t block = 4096) {
    const auto channels = static_cast<std::size_t>(reader.info().channels);
    std::vector<float> all;
    std::vector<float> chunk(block * channels);
    while (const std::size_t frames = reader.read(chunk)) {
        all.insert(all.end(),
                   chunk.begin(),
                   chunk.begin() + static_cast<std::ptrdiff_t>(frames * channels));
    }
    return all;
}

}  // namespace raks::audio::test
