#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/expected.hpp"

/// Films as pictures with their times, for what looks at them (capture). Decoded by the program
/// raks-decode in a cage, so that no film harms this process.
namespace raks::engine {

/// One picture, as it is to be seen: the turn that a film's metadata asks for is applied.
///
/// RGB and not the film's own YUV: markers burnt out are told by their largest channel, windows
/// show RGB, pictures in PNG are RGB; and matrix, range and the places of halved colour differ from
/// film to film, which is settled once, where FFmpeg knows them. It costs 1 to 2 ms of 720 lines.
struct FilmPicture {
    /// Seconds on the film's own clock, whose 0 is what comes first of sound and picture; where the
    /// sound begins less than 20 ms behind the picture, its begin. Later than that of the picture
    /// before. Not at even distances: telephones film at a varying rate.
    double seconds = 0.0;
    int width = 0;                  ///< pixels, 1 to 8192
    int height = 0;                 ///< likewise
    std::vector<std::uint8_t> rgb;  ///< width x height x 3 bytes, top row first, full range
};

/// What a film says of itself.
struct FilmInfo {
    int width = 0;                          ///< pixels, as its pictures are to be seen
    int height = 0;                         ///< likewise
    double pictures_per_second = 0.0;       ///< on average, as claimed; 0: unknown
    std::optional<double> claimed_seconds;  ///< its length, for a progress line alone
    int turned = 0;                         ///< degrees clockwise that its metadata asks for
    /// When it was recorded, by its metadata: begin or end, as phones have it; seconds since 1970.
    std::optional<double> recorded{};
    std::string format;  ///< "h264 in mov,mp4,...", or "pictures"
};

/// How a film is read.
struct FilmOptions {
    /// Of a folder of pictures, which has no times: > 0.
    double folder_pictures_per_second = 30.0;
    /// Asked before each picture, and every 50 ms while one is waited for; true ends the reading.
    std::function<bool()> is_stop_requested = [] { return false; };
};

/// Reads a film's pictures from front to back, one at a time. Forms: MP4, QuickTime, 3GP, Matroska,
/// WebM, Ogg, AVI, ASF, FLV, MPEG, MXF, NUT, Y4M with H.264, HEVC, MPEG-4, Motion JPEG, VP8, VP9,
/// AV1, ProRes, PNG or uncompressed pictures; a single PNG or JPEG picture; a folder of them, which
/// are taken in the order of the last number in their names (a missing number is a gap in time).
///
///     auto film = FilmReader::open("camera1.mp4");
///     while (auto picture = (*film)->next()) { if (!*picture) break; look_at(**picture); }
///
/// A film that is damaged or cut off ends early or has damaged pictures, and warning() says so.
/// Threads: one at a time. Real-time: no.
class FilmReader {
 public:
    /// Errors, one line each: missing, empty, not a film, without pictures, a codec that is not on
    /// the list, pictures over 8192 x 8192, cut off before its index; a folder without numbered
    /// pictures or with one number twice; raks-decode is not there, broke off or hung (30 s without
    /// a picture); stopped.
    [[nodiscard]] static Expected<std::unique_ptr<FilmReader>> open(
        const std::filesystem::path& path, const FilmOptions& options = {});
    FilmReader(const FilmReader&) = delete;             ///< one film, one reader
    FilmReader& operator=(const FilmReader&) = delete;  ///< likewise
    virtual ~FilmReader() = default;

    /// The next picture; none at the end. Errors: no picture at all; stopped; of a folder, a
    /// picture of another size or that cannot be read.
    [[nodiscard]] virtual Expected<std::optional<FilmPicture>> next() = 0;

    /// Known from open() on.
    [[nodiscard]] const FilmInfo& info() const noexcept { return info_; }
    /// One line, such as "x.mp4: is damaged or cut off at 12.30 s; 3.40 s are missing"; empty when
    /// nothing is. Complete at the end of the film only.
    [[nodiscard]] const std::string& warning() const noexcept { return warning_; }

 protected:
    FilmReader() = default;

    FilmInfo info_;
    std::string warning_;
};

}  // namespace raks::engine
