#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "render/video/video_writer.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::render {

using Rgba = std::vector<std::uint8_t>;

inline Rgba plain_picture(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
    Rgba rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 255);
    for (std::size_t i = 0; i < rgba.size(); i += 4) {
        rgba[i] = r;
        rgba[i + 1] = g;
        rgba[i + 2] = b;
    }
    return rgba;
}

/// Noise: what compresses worst.
inline Rgba noise_picture(int width, int height, std::uint64_t seed) {
    Rgba rgba(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    const CounterRandom random(seed);
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        rgba[i] = static_cast<std::uint8_t>(random.bits(i));
    }
    return rgba;
}

/// What FFmpeg's own program decodes: one byte of grey a pixel, all pictures in a row.
inline std::string decoded_grey(const std::filesystem::path& film) {
    return test::run_program(
        {"ffmpeg", "-v", "error", "-i", film.string(), "-f", "rawvideo", "-pix_fmt", "gray", "-"});
}

inline std::string decoded_rgb(const std::filesystem::path& film) {
    return test::run_program(
        {"ffmpeg", "-v", "error", "-i", film.string(), "-f", "rawvideo", "-pix_fmt", "rgb24", "-"});
}

/// The first channel's samples.
inline std::vector<float> decoded_sound(const std::filesystem::path& film) {
    const std::string bytes = test::run_program({"ffmpeg",
                                                 "-v",
                                                 "error",
                                                 "-i",
                                                 film.string(),
                                                 "-af",
                                                 "pan=mono|c0=c0",
                                                 "-f",
                                                 "f32le",
                                                 "-"});
    std::vector<float> samples(bytes.size() / sizeof(float));
    std::memcpy(samples.data(), bytes.data(), samples.size() * sizeof(float));
    return samples;
}

/// One value that ffprobe tells of a stream: "v:0" or "a:0".
inline std::string probe(const std::filesystem::path& film,
                         const std::string& stream,
                         const std::string& entry) {
    std::string text = test::run_program({"ffprobe",
                                          "-v",
                                          "error",
                                          "-select_streams",
                                          stream,
                                          "-show_entries",
                                          "stream=" + entry,
                                          "-of",
                                          "csv=p=0",
                                          film.string()});
    while (!text.empty() && (text.back() == '\n' || text.back() == ',')) {
        text.pop_back();
    }
    return text;
}

}  // namespace raks::render
