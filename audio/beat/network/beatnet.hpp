#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "audio/features/spectrum.hpp"
#include "base/expected.hpp"
#include "base/realtime.hpp"

/// BeatNet's network for beats and downbeats, which its authors trained on recordings (M. Heydari,
/// F. Cwitkowitz, Z. Duan, "BeatNet: CRNN and particle filtering for online joint beat, downbeat
/// and meter tracking", ISMIR 2021): a second opinion beside our own networks, which know written
/// music alone.
namespace raks::audio {

/// Weights of BeatNet; a file gives the numbers. Its shape is fixed. Immutable once read. Threads:
/// any may read.
struct BeatNet {
    static constexpr std::size_t kBands = 136;          ///< 24 an octave from 30 Hz
    static constexpr std::size_t kInputs = 2 * kBands;  ///< bands, then how much each rose
    static constexpr std::size_t kTaps = 10;            ///< inputs that a filter covers
    static constexpr std::size_t kFilters = 2;
    /// The greater of each two neighbours of a filter's output is kept.
    static constexpr std::size_t kPooled = (kInputs - kTaps + 1) / 2;
    static constexpr std::size_t kUnits = 150;  ///< of the dense layer and of each LSTM
    static constexpr std::size_t kOutputs = 3;  ///< beat that is no downbeat, downbeat, neither

    /// A layer of long short-term memory; gates in the order input, forget, cell, output.
    struct Memory {
        std::vector<float> input;  ///< kUnits x 4 kUnits
        std::vector<float> state;  ///< likewise
        std::vector<float> bias;   ///< 4 kUnits
    };

    FilterBank bank{{}};              ///< kBands filters over the magnitudes of a frame
    std::vector<float> kernel;        ///< kFilters x kTaps
    std::vector<float> kernel_bias;   ///< kFilters
    std::vector<float> dense;         ///< kFilters kPooled x kUnits
    std::vector<float> dense_bias;    ///< kUnits
    std::array<Memory, 2> memory;     ///< one above the other
    std::vector<float> outputs;       ///< kUnits x kOutputs
    std::vector<float> outputs_bias;  ///< kOutputs
};

/// Reads and checks the weights (docs/reference/files.md, raks-beatnet). Errors: as
/// models::WeightReader; a filter beyond the spectrum.
[[nodiscard]] Expected<BeatNet> parse_beatnet(std::string_view bytes);

/// Reads the weights from a file of at most 4 MiB. Errors: as read_file and parse_beatnet, with the
/// file's name. Threads: workers. Real-time: no.
[[nodiscard]] Expected<std::shared_ptr<const BeatNet>> load_beatnet(
    const std::filesystem::path& path);

/// What BeatNet says of a moment: probabilities, together at most 1.
struct BeatNetEvidence {
    float beat = 0.0F;      ///< of a beat, downbeats included
    float downbeat = 0.0F;  ///< of the first beat of a bar
};

/// State of BeatNet over a stream of frames, one every 20 ms.
///
/// A frame is 64 ms of sound. BeatNet was trained at 22.05 kHz with 1,411 samples; 2,048 samples at
/// 32 kHz have the same length and the same bins.
/// Cost: 0.4 million multiply-adds a frame and a Fourier transform of 2,048.
/// Threads: one. Real-time: all but the constructor.
class BeatNetStream {
 public:
    static constexpr int kSampleRate = 32'000;    ///< hertz
    static constexpr std::size_t kWindow = 2048;  ///< samples of a frame, 64 ms
    static constexpr std::size_t kHop = 640;      ///< samples from frame to frame, 20 ms

    /// `network`: not null.
    explicit BeatNetStream(std::shared_ptr<const BeatNet> network);

    /// Evidence of the moment in the middle of the next frame. `samples`: in [-1, 1].
    BeatNetEvidence next(std::span<const float, kWindow> samples) noexcept RAKS_NONBLOCKING;
    /// The same from the frame's spectrum: BeatNet::kBands values log10(1 + magnitude).
    BeatNetEvidence next_from_bands(std::span<const float, BeatNet::kBands> bands) noexcept
        RAKS_NONBLOCKING;
    /// Forgets the stream.
    void reset() noexcept RAKS_NONBLOCKING;

 private:
    using Units = std::array<float, BeatNet::kUnits>;

    void pool_filters() noexcept;
    void remember(std::size_t layer, const Units& below) noexcept;

    std::shared_ptr<const BeatNet> network_;
    PowerSpectrum spectrum_;
    std::array<float, BeatNet::kBands> bands_{};
    std::array<float, BeatNet::kInputs> inputs_{};
    bool has_frame_ = false;  // inputs_ holds the frame before
    std::array<float, BeatNet::kFilters * BeatNet::kPooled> pooled_{};
    std::array<Units, 2> hidden_{};
    std::array<Units, 2> cell_{};
    std::array<float, 4 * BeatNet::kUnits> gates_{};
};

}  // namespace raks::audio
