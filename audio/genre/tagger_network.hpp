#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "base/realtime.hpp"

/// The music tagger: a network that has heard a million songs and says what a few seconds sound
/// like (J. Pons, X. Serra, "musicnn", ISMIR 2019; without the filters that its training left
/// dead).
namespace raks::audio {

inline constexpr std::size_t kTags = 50;          ///< words that the tagger knows
inline constexpr std::size_t kTagFeatures = 200;  ///< numbers of an embedding
inline constexpr std::size_t kTagBands = 96;      ///< mel bands of a frame
inline constexpr std::size_t kTagFrames = 187;    ///< frames of a patch: 2.99 s

/// The words, in the order of the logits.
inline constexpr std::array<std::string_view, kTags> kTagNames = {"rock",
                                                                  "pop",
                                                                  "alternative",
                                                                  "indie",
                                                                  "electronic",
                                                                  "female vocalists",
                                                                  "dance",
                                                                  "00s",
                                                                  "alternative rock",
                                                                  "jazz",
                                                                  "beautiful",
                                                                  "metal",
                                                                  "chillout",
                                                                  "male vocalists",
                                                                  "classic rock",
                                                                  "soul",
                                                                  "indie rock",
                                                                  "Mellow",
                                                                  "electronica",
                                                                  "80s",
                                                                  "folk",
                                                                  "90s",
                                                                  "chill",
                                                                  "instrumental",
                                                                  "punk",
                                                                  "oldies",
                                                                  "blues",
                                                                  "hard rock",
                                                                  "ambient",
                                                                  "acoustic",
                                                                  "experimental",
                                                                  "female vocalist",
                                                                  "guitar",
                                                                  "Hip-Hop",
                                                                  "70s",
                                                                  "party",
                                                                  "country",
                                                                  "easy listening",
                                                                  "sexy",
                                                                  "catchy",
                                                                  "funk",
                                                                  "electro",
                                                                  "heavy metal",
                                                                  "Progressive rock",
                                                                  "60s",
                                                                  "rnb",
                                                                  "indie pop",
                                                                  "sad",
                                                                  "House",
                                                                  "happy"};

/// Weights of the tagger. Its shape is fixed; a file gives the numbers (tagger_file.hpp).
/// Threads: any may read.
struct TaggerNetwork {
    static constexpr std::size_t kFront = 64;      ///< live filters over the mel bands
    static constexpr std::size_t kMiddle = 64;     ///< filters of each of the three layers in time
    static constexpr std::size_t kFirstLive = 20;  ///< of the first of them that are not constants
    static constexpr std::size_t kPooled = 2 * (kFront + kFirstLive + 2 * kMiddle);  ///< 424

    /// A convolution over time and bands: rectified, then scaled and shifted. Filter f sums
    /// `weights[(f rows + r) taps + t]` times the input's row r, t - before frames later.
    struct Convolution {
        std::size_t filters = 0;  ///< of the output
        std::size_t rows = 0;     ///< bands or channels that a filter covers
        std::size_t taps = 0;     ///< frames that it covers
        std::vector<float> weights = {};
        std::vector<float> bias = {};
        std::vector<float> scale = {};
        std::vector<float> shift = {};
        /// Taps x filters, or empty: what the filters that were left out add to each sum, but not
        /// beyond the ends of a patch.
        std::vector<float> dead = {};
    };
    /// What is added to a row of the middle for each live filter of a layer, and the row's place.
    using Places = std::vector<std::size_t>;

    float input_scale = 1.0F;                ///< of a mel band
    float input_shift = 0.0F;                ///< likewise
    std::array<Convolution, 2> timbre = {};  ///< 7 frames of 38 and 67 bands
    std::array<Convolution, 3> times = {};   ///< 128, 64 and 32 frames of one band
    std::array<Convolution, 3> middle = {};  ///< 7 frames of all channels
    std::array<Places, 3> places = {};       ///< of the middle's live filters among kMiddle
    std::array<std::vector<float>, 3> constants = {};  ///< of all kMiddle, live or not
    std::vector<float> dense = {};                     ///< kPooled x kTagFeatures
    std::vector<float> dense_bias = {};                ///< kTagFeatures
    std::vector<float> embedding_scale = {};           ///< likewise
    std::vector<float> embedding_shift = {};           ///< likewise
    std::vector<float> tags = {};                      ///< kTagFeatures x kTags
    std::vector<float> tags_bias = {};                 ///< kTags
};

/// Runs the network over a patch; holds what is computed on the way.
/// Cost: 138 million multiply-adds a patch, for 2.99 s of sound: 12 ms.
/// Threads: one. Real-time: yes (no allocation), but a whole patch at once.
class TaggerRun {
 public:
    TaggerRun();  ///< allocates

    /// `mel`: kTagFrames x kTagBands, log10(1 + 10000 power). Writes the results, which stay until
    /// the next call. The same bits on every machine.
    void compute(const TaggerNetwork& network,
                 std::span<const float, kTagFrames * kTagBands> mel) noexcept RAKS_NONBLOCKING;

    /// Of the last patch, before the sigmoid.
    [[nodiscard]] const std::array<float, kTags>& logits() const noexcept { return logits_; }
    /// Of the last patch.
    [[nodiscard]] const std::array<float, kTagFeatures>& embedding() const noexcept {
        return embedding_;
    }

 private:
    void add_places(const TaggerNetwork& network, std::size_t layer) noexcept;

    std::vector<float> bands_;     // rows of time, one a mel band
    std::vector<float> features_;  // rows of time: front, first, b, c
    std::vector<float> live_;      // rows of time: output of a layer of the middle
    std::array<float, kTags> logits_{};
    std::array<float, kTagFeatures> embedding_{};
};

/// log10(1 + 10000 x) of each value, >= 0, with an error below 1e-6. The same bits on every
/// machine. Real-time: yes.
void compress_mel(std::span<float> values) noexcept RAKS_NONBLOCKING;

}  // namespace raks::audio
