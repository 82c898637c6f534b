#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "audio/io/device_stream.hpp"
#include "audio/io/devices.hpp"
#include "audio/music/generator/music_generator.hpp"
#include "base/expected.hpp"
#include "engine/trials/block_clock.hpp"

/// Records what leaves by the loudspeaker's ports, through a loop of JACK ports: the reference for
/// latency.
///
/// When is a sample "out"? When the input says that it was heard, see DeviceStream::heard_after.
/// Under JACK all samples of a cycle move at once, and neither an output nor an input has a
/// converter of its own; the cycle's start is the only moment there is. There sample i of a block
/// is out at
///
///     entry of the recorder's callback + i / rate - JACK's capture latency
///
/// that is, as if a converter at the end of the loop began to play the block when it was handed to
/// it. JACK's latencies have the same convention: an output that leads to our input alone is 0
/// periods late, as its client is called before the recorder in the same cycle. What a loop of
/// ports cannot see is the driver's own buffers and the converters: that needs a cable.
namespace raks::engine {

/// One recorded channel, with the host time of every sample.
class LoopRecording {
 public:
    /// `clock`: marked with the frame behind each block. `samples`: one channel, from frame 0 on.
    LoopRecording(BlockClock clock, std::vector<float> samples)
        : clock_(std::move(clock)), samples_(std::move(samples)) {}

    /// Of the samples.
    [[nodiscard]] SampleRate rate() const noexcept { return clock_.rate(); }
    /// All samples from the start of the recording.
    [[nodiscard]] std::span<const float> samples() const noexcept { return samples_; }
    /// When this sample was out, as defined above. Needs at least one block.
    [[nodiscard]] HostTime heard_at(std::int64_t frame) const { return clock_.heard_at(frame); }
    /// When all samples were out. Needs at least one block.
    [[nodiscard]] const BlockClock& clock() const noexcept { return clock_; }

 private:
    BlockClock clock_;
    std::vector<float> samples_;
};

/// Records an input; through JACK our own output.
/// Threads: main. Real-time: no (its callback is).
class LoopRecorder {
 public:
    /// Opens `input`. `seconds`: room for that much. Errors: it cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<LoopRecorder>> start(
        const audio::AudioDevice& input, double seconds);
    /// Opens the input of the JACK device that `output` plays on. Errors: `output` is not JACK's,
    /// or has no input; it cannot be opened.
    [[nodiscard]] static Expected<std::unique_ptr<LoopRecorder>> start_beside(
        std::span<const audio::AudioDevice> devices,
        const audio::AudioDevice& output,
        double seconds);
    ~LoopRecorder();  ///< closes the input
    /// Not copied: the stream calls into it.
    LoopRecorder(const LoopRecorder&) = delete;
    LoopRecorder& operator=(const LoopRecorder&) = delete;  ///< likewise

    /// Starts keeping what comes.
    void keep() noexcept;
    /// Connects the running `output`, and nothing else, to the input and starts keeping what comes.
    /// Errors: JACK refuses.
    [[nodiscard]] Expected<void> close_loop(const audio::DeviceStream& output);

    /// What came back so far. Errors: nothing did.
    [[nodiscard]] Expected<LoopRecording> recording() const;

 private:
    class Tape;
    explicit LoopRecorder(std::unique_ptr<Tape> tape);

    std::unique_ptr<Tape> tape_;  // before the stream, which calls it
    std::unique_ptr<audio::DeviceStream> stream_;
};

/// A beat of the generated music that was found in the recording.
struct AudibleBeat {
    std::size_t beat = 0;  ///< index in GeneratedMusic::beats
    HostTime heard{};      ///< when its sound was out
};

/// Finds every beat's attack (its first 20 ms, left channel) in the recording, to the sample, by
/// normalized cross-correlation; beats whose best correlation is below 0.9 are left out. The music
/// must begin with silence. Empty when the recording's rate is not the music's.
[[nodiscard]] std::vector<AudibleBeat> audible_beats(const LoopRecording& recording,
                                                     const audio::GeneratedMusic& music);

}  // namespace raks::engine
