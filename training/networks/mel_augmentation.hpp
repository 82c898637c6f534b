#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "audio/features/network_input.hpp"
#include "base/dice.hpp"

namespace raks::audio {

/// How a stretch of music is heard while a network learns: slower or faster, through other rooms
/// and loudspeakers, in noise. Works on the mel magnitudes that the front end gives (hops x
/// NetworkInput::kBands), so that each piece is played once and heard many times.
struct MelHearing {
    double first_hop = 0.0;  ///< in the piece
    double stretch = 1.0;    ///< hops of the piece a hop that is heard
    std::array<float, NetworkInput::kBands> gain{};
    float noise = 0.0F;          ///< share of the piece's mean magnitude, on every band
    float reverberation = 0.0F;  ///< energy that a room gives back, of the direct sound's
    float decay = 0.0F;          ///< of the echo's energy, what is left a hop later

    /// From the piece's begin, unchanged.
    [[nodiscard]] static MelHearing plain();
    /// Drawn so that `hops` hops fit if the piece is long enough: time stretched by up to
    /// exp(+-most_stretch), a smooth curve over the bands, some of them damped, noise.
    [[nodiscard]] static MelHearing draw(std::size_t piece_hops,
                                         std::size_t hops,
                                         double most_stretch,
                                         Dice& dice);
    /// A drawn room: 0.15 to 1 s to -60 dB, with a twentieth to five times the direct energy.
    void enter_room(Dice& dice);
    /// Treble that falls off from a drawn band (1.9 to 13 kHz) on.
    void muffle(Dice& dice);
};

/// What a room adds to music, hop by hop: per band, energy that dies away exponentially (Polack
/// 1988: late reverberation is decaying noise), in the mean. That narrow bands fluctuate as the
/// reflections meet is left out: learnt with it, clean music was known less well
/// (docs/decisions/0010).
class RoomEcho {
 public:
    using Bands = std::array<float, NetworkInput::kBands>;

    /// Turns a hop's magnitudes into what is heard of it in the hearing's room.
    void add(const MelHearing& hearing, Bands& bands);

 private:
    Bands energy_{};
};

/// Calls put(t, bands) for `hops` hops: magnitudes as they are heard. `dice`: draws the noise;
/// null: none. Behind the piece's end its last hop is held.
template <class Put>
void hear_bands(std::span<const float> mel,
                const MelHearing& hearing,
                std::size_t hops,
                Dice* dice,
                const Put& put);

/// Calls put(t, frame) for `hops` hops as hear_bands does, `input` going on from what it has heard.
template <class Put>
void hear_mel(std::span<const float> mel,
              const MelHearing& hearing,
              std::size_t hops,
              NetworkInput& input,
              Dice* dice,
              const Put& put) {
    hear_bands(mel, hearing, hops, dice, [&](std::size_t t, const auto& bands) {
        put(t, input.next(bands));
    });
}

/// Mel magnitudes at a place between hops. `mel`: at least one hop.
[[nodiscard]] std::array<float, NetworkInput::kBands> magnitudes_at(std::span<const float> mel,
                                                                    double hop);
[[nodiscard]] float mean_magnitude(std::span<const float> mel);

template <class Put>
void hear_bands(std::span<const float> mel,
                const MelHearing& hearing,
                std::size_t hops,
                Dice* dice,
                const Put& put) {
    const float floor = hearing.noise > 0.0F ? hearing.noise * mean_magnitude(mel) : 0.0F;
    RoomEcho echo;
    for (std::size_t t = 0; t < hops; ++t) {
        auto bands =
            magnitudes_at(mel, hearing.first_hop + static_cast<double>(t) * hearing.stretch);
        if (hearing.reverberation > 0.0F) {
            echo.add(hearing, bands);
        }
        for (std::size_t band = 0; band < bands.size(); ++band) {
            const float hiss = floor > 0.0F && dice != nullptr
                                   ? floor * static_cast<float>(dice->uniform(0.5, 1.5))
                                   : 0.0F;
            bands[band] = bands[band] * hearing.gain[band] + hiss;
        }
        put(t, bands);
    }
}

}  // namespace raks::audio
