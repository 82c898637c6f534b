#include "engine/offline/music_source.hpp"

#include <algorithm>
#include <limits>
#include <system_error>
#include <utility>

#include "audio/io/hearing.hpp"
#include "audio/io/wav_writer.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/file.hpp"
#include "engine/setup/user_folders.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

namespace fs = std::filesystem;

// Frames that next() gives at most.
constexpr std::size_t kBlockFrames = 1024;
// Part of the cached file's name: a changed generator must not play the piece that an older one
// made. To be raised with every change of the demo.
constexpr int kDemoVersion = 1;

}  // namespace

MusicSource::MusicSource(std::unique_ptr<audio::AudioFileReader> reader)
    : reader_(std::move(reader)),
      interleaved_(kBlockFrames * static_cast<std::size_t>(reader_->info().channels)),
      mono_(kBlockFrames),
      stereo_(2 * kBlockFrames) {}

Expected<MusicSource> MusicSource::open(const fs::path& path,
                                        double start,
                                        std::optional<double> duration,
                                        std::function<bool()> is_stopped) {
    auto reader = audio::open_audio_file(path, std::move(is_stopped));
    if (!reader) {
        return fail(reader.error());
    }
    MusicSource source(std::move(*reader));
    const double rate = source.rate().hertz();
    source.start_seconds_ = start;
    // At least one frame: a duration below half a sample would be the same as none.
    source.frames_left_ = duration ? std::max<std::int64_t>(1, std::llround(*duration * rate))
                                   : std::numeric_limits<std::int64_t>::max();
    if (start > 0.0) {
        if (auto sought = source.reader_->seek(std::llround(start * rate)); !sought) {
            return fail(sought.error());
        }
        // The file's head may be wrong about its length: only reading can tell.
        source.read_ahead_ = source.read_block();
        if (*source.read_ahead_ == 0) {
            const auto claimed = source.reader_->info().claimed_seconds;
            return fail(claimed && start >= *claimed
                            ? starts_behind_end(path, *claimed, start)
                            : fmt::format("{}: ends before {} s, where it should start",
                                          path.string(),
                                          start));
        }
    }
    return source;
}

MusicSource MusicSource::of(std::unique_ptr<audio::AudioFileReader> reader) {
    MusicSource source(std::move(reader));
    source.frames_left_ = std::numeric_limits<std::int64_t>::max();
    return source;
}

// Decodes the next block of the section; returns its frames. The section may end before the file
// does: then the file is not read any more.
std::size_t MusicSource::read_block() {
    const auto channels = static_cast<std::size_t>(reader_->info().channels);
    const auto wanted = static_cast<std::size_t>(
        std::min<std::int64_t>(frames_left_, static_cast<std::int64_t>(kBlockFrames)));
    return wanted == 0 ? 0 : reader_->read(std::span(interleaved_).first(wanted * channels));
}

MusicSource::Block MusicSource::next() {
    const auto channels = static_cast<std::size_t>(reader_->info().channels);
    const std::size_t got = read_ahead_ ? *read_ahead_ : read_block();
    read_ahead_.reset();
    frames_left_ -= static_cast<std::int64_t>(got);
    frames_given_ += static_cast<std::int64_t>(got);
    const std::span<const float> frames = std::span(interleaved_).first(got * channels);
    const std::span<float> mono = std::span(mono_).first(got);
    const std::span<float> stereo = std::span(stereo_).first(2 * got);
    // The analyzer gets mono, a film's sound track stereo: both of the same frames, as in playback.
    const audio::Hearing& hearing = reader_->info().hearing;
    audio::hear_stereo(frames, channels, hearing, stereo);
    audio::hear_mono(stereo, 2, audio::after_stereo(hearing), mono);
    return {mono, stereo};
}

Nanos MusicSource::given() const noexcept {
    return rate().time_of(frames_given_).time_since_epoch();
}

std::optional<double> MusicSource::seconds() const noexcept {
    const auto claimed = reader_->info().claimed_seconds;
    // The total is the section's, bounded by what the file claims to hold.
    const double rate = reader_->info().rate.hertz();
    double total = claimed ? *claimed - start_seconds_ : 0.0;
    // frames_left_ counts down from the maximum where no duration was given.
    if (frames_left_ < std::numeric_limits<std::int64_t>::max() / 2) {
        const double asked =
            (static_cast<double>(frames_given_) + static_cast<double>(frames_left_)) / rate;
        total = claimed ? std::min(total, asked) : asked;
    }
    return total > 0.0 ? std::optional(total) : std::nullopt;
}

std::optional<double> MusicSource::progress() const noexcept {
    const auto total = seconds();
    const double done = static_cast<double>(frames_given_) / reader_->info().rate.hertz();
    return total ? std::optional(std::min(1.0, done / *total)) : std::nullopt;
}

std::string starts_behind_end(const fs::path& path, double length, double start) {
    return fmt::format(
        "{}: is {:.1f} s long; it cannot start at {} s", path.string(), length, start);
}

Expected<fs::path> demo_music() {
    const std::string name = fmt::format("demo_{}.wav", kDemoVersion);
    const auto folder = kept_folder({});
    if (!folder) {
        return fail(folder.error());
    }
    // Made by an earlier run of the same version.
    fs::path place = *folder / name;
    if (is_there(place)) {
        return place;
    }
    const auto music = audio::generate(audio::demo_plan());
    if (!music) {
        return fail(music.error());
    }
    auto written = audio::write_wav(place, music->samples, music->channels, music->rate);
    // A disk that is full does not stop the dance.
    if (!written) {
        if (const auto other = private_temporary_folder()) {
            place = *other / name;
            written = audio::write_wav(place, music->samples, music->channels, music->rate);
        }
    }
    return written ? Expected<fs::path>(place) : fail(written.error());
}

}  // namespace raks::engine
