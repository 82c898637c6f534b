#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/features/network_input.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// Augmentation of a stretch of music for network training: time stretch, rooms, loudspeakers,
/// noise. Works on the front end's mel magnitudes (hops x NetworkInput::kBands), so that each piece
/// is rendered and analysed once and can be augmented many times.
struct MelAugmentation {
    double first_hop = 0.0;  ///< hop of the piece at which the stretch begins; may lie between hops
    double stretch = 1.0;    ///< hops of the piece for each hop of output; > 1 is faster
    std::array<float, NetworkInput::kBands> gain{};  ///< factor on the magnitudes of each band
    float noise = 0.0F;  ///< noise magnitude on every band, relative to the piece's mean magnitude
    float reverberation = 0.0F;  ///< energy of the echo relative to the direct sound; 0: no room
    float decay = 0.0F;          ///< share of the echo's energy that is left a hop later

    /// No augmentation, from the begin of the piece.
    [[nodiscard]] static MelAugmentation plain();
    /// Draws an augmentation. Starts so that `hops` hops of output fit in a piece of `piece_hops`,
    /// if it is long enough. Time stretch within exp(+-most_stretch), a smooth gain curve over the
    /// bands, sometimes a damped range of bands, dropped bands and noise.
    [[nodiscard]] static MelAugmentation draw(std::size_t piece_hops,
                                              std::size_t hops,
                                              double most_stretch,
                                              Dice& dice);
    /// Draws a room: reverberation time 0.15 to 1 s (to -60 dB), echo of 0.05 to 5 times the direct
    /// energy.
    void enter_room(Dice& dice);
    /// Draws treble damping: gains fall off exponentially above a drawn band (1.9 to 13 kHz).
    void muffle(Dice& dice);
};

/// Adds a room's late reverberation hop by hop: in each band an energy that decays exponentially
/// (Polack 1988), in the mean. Narrow-band fluctuation is left out, because training with it made
/// results on clean music worse (docs/decisions/0010-genre-training-tried.md).
class RoomEcho {
 public:
    using Bands = std::array<float, NetworkInput::kBands>;

    /// Replaces a hop's magnitudes by those of direct sound and echo together.
    void add(const MelAugmentation& augmentation, Bands& bands);

 private:
    Bands energy_{};
};

/// Calls put(t, bands) for `hops` hops with augmented magnitudes. `dice`: draws the noise; null: no
/// noise. After the end of the piece its last hop is repeated.
template <class Put>
void augment_bands(std::span<const float> mel,
                   const MelAugmentation& augmentation,
                   std::size_t hops,
                   Dice* dice,
                   const Put& put);

/// As augment_bands, but calls put(t, frame) with network inputs. `input` keeps its state from
/// earlier calls.
template <class Put>
void augment_mel(std::span<const float> mel,
                 const MelAugmentation& augmentation,
                 std::size_t hops,
                 NetworkInput& input,
                 Dice* dice,
                 const Put& put) {
    augment_bands(mel, augmentation, hops, dice, [&](std::size_t t, const auto& bands) {
        put(t, input.next(bands));
    });
}

/// Mel magnitudes at `hop`, linear between two hops; clamped to the piece. `mel`: at least one hop.
[[nodiscard]] std::array<float, NetworkInput::kBands> magnitudes_at(std::span<const float> mel,
                                                                    double hop);
/// Mean over all hops and bands; 0 for no hops.
[[nodiscard]] float mean_magnitude(std::span<const float> mel);

// Defined after magnitudes_at and mean_magnitude, which it calls.
template <class Put>
void augment_bands(std::span<const float> mel,
                   const MelAugmentation& augmentation,
                   std::size_t hops,
                   Dice* dice,
                   const Put& put) {
    const float floor = augmentation.noise > 0.0F ? augmentation.noise * mean_magnitude(mel) : 0.0F;
    RoomEcho echo;
    for (std::size_t t = 0; t < hops; ++t) {
        auto bands = magnitudes_at(
            mel, augmentation.first_hop + static_cast<double>(t) * augmentation.stretch);
        if (augmentation.reverberation > 0.0F) {
            echo.add(augmentation, bands);
        }
        for (std::size_t band = 0; band < bands.size(); ++band) {
            const float hiss = floor > 0.0F && dice != nullptr
                                   ? floor * static_cast<float>(dice->uniform(0.5, 1.5))
                                   : 0.0F;
            bands[band] = bands[band] * augmentation.gain[band] + hiss;
        }
        put(t, bands);
    }
}

}  // namespace raks::audio
