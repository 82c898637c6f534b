#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "audio/io/audio_file_backends.hpp"
#include "audio/io/hearing.hpp"

namespace raks::audio {

/// Listens to the start of a file to decide on its Hearing. Takes blocks of 100 ms and keeps a few
/// numbers of each. Threads: one. Real-time: no.
class HearingSurvey {
 public:
    /// For sound of this rate and number of channels.
    HearingSurvey(SampleRate rate, int channels);

    /// The next frames, interleaved.
    void add(std::span<const float> interleaved);
    /// Has enough been heard to know that the file is an ordinary one?
    [[nodiscard]] bool is_ordinary() const;
    /// What is decided from all that was heard.
    [[nodiscard]] Hearing hearing() const;
    /// What is out of the usual, for the user; empty for an ordinary file.
    [[nodiscard]] std::string note() const;

 private:
    struct Block {
        double level = 0.0;  // RMS of both sides, without their means
        double mid = 0.0;    // power of the mean of the sides, without its mean
        double side = 0.0;   // of half of their difference
    };
    void finish_block();
    [[nodiscard]] bool is_upside_down() const;
    [[nodiscard]] double loudest() const;
    [[nodiscard]] double usual() const;
    [[nodiscard]] double mean() const;
    [[nodiscard]] float gain_for(double level) const;

    std::size_t channels_;
    std::size_t block_frames_;
    std::vector<float> stereo_;
    // Sums over the open block:
    std::size_t frames_ = 0;
    double sum_left_ = 0.0;
    double sum_right_ = 0.0;
    double squares_left_ = 0.0;
    double squares_right_ = 0.0;
    double products_ = 0.0;
    // Over all finished blocks:
    std::vector<Block> sounding_;  // blocks that are not digital silence
    double mid_ = 0.0;
    double side_ = 0.0;
    double offset_ = 0.0;  // sum of the mixed samples' means
};

/// Decides on the Hearing of a file and gives a reader of it, `info().hearing` set. An ordinary
/// file is known after about a second of sound, which is kept and not decoded again; one out of the
/// usual is looked at for up to 10 minutes. `open` opens the file.
/// Errors: those of `open`. Threads: one. Real-time: no.
[[nodiscard]] Expected<AudioFileReaderPtr> survey_reader(
    AudioFileReaderPtr inner,
    const std::filesystem::path& path,
    const std::function<Expected<AudioFileReaderPtr>()>& open);

}  // namespace raks::audio
