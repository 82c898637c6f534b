#include "audio/music/instruments/soundfont_band.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "audio/music/instruments/soundfont_protocol.hpp"
#include "base/talk_answer.hpp"

namespace raks::audio {
namespace {

constexpr TalkingPart kProgram{.name = "raks-soundfont", .variable = "RAKS_SOUNDFONT"};
constexpr std::chrono::seconds kLongestPiece(300);  // of a piece, on a machine that has much to do

/// A player tuned up to `most_semitones` up or down.
BandPlayer draw_player(std::size_t soundfonts, double most_semitones, Dice& dice) {
    BandPlayer player;
    player.soundfont = static_cast<std::size_t>(dice.whole(0, static_cast<int>(soundfonts) - 1));
    player.semitones = dice.uniform(-most_semitones, most_semitones);
    // Most soundfonts leave the low-pass open, so moving its corner up would change nothing.
    player.brightness = dice.chance(0.5) ? -dice.uniform(0.0, 2.5) : 0.0;
    player.decay = dice.uniform(-1.0, 1.0);
    player.level = dice.uniform(-8.0, 4.0);
    return player;
}

/// "a.sf2, b.sf2"
std::string names_of(std::span<const std::filesystem::path> soundfonts) {
    std::string names;
    for (const auto& soundfont : soundfonts) {
        names += (names.empty() ? "" : ", ") + soundfont.string();
    }
    return names;
}

std::size_t sample_count(const Performance& performance) {
    return static_cast<std::size_t>(performance.seconds * kPerformanceRate);
}

bool are_finite(std::span<const float> samples) {
    return std::all_of(
        samples.begin(), samples.end(), [](float sample) { return std::isfinite(sample); });
}

/// What raks-soundfont is told.
Talk send_piece(int socket,
                const SoundfontPiece& piece,
                std::span<const PlayedNote> notes,
                TalkDeadline deadline) {
    const Talk sent = send_all(socket, std::as_bytes(std::span(&piece, 1)), deadline);
    return sent == Talk::good ? send_all(socket, std::as_bytes(notes), deadline) : sent;
}

/// Plays in another process. No `band`: the first soundfont plays everything.
Expected<std::vector<float>> play_apart(std::span<const std::filesystem::path> soundfonts,
                                        const Performance& performance,
                                        const SoundfontPiece& piece) {
    std::vector<std::string> arguments;
    for (const auto& soundfont : soundfonts) {
        arguments.push_back(soundfont.string());
    }
    auto child = TalkingChild::start(kProgram, {.arguments = std::move(arguments)});
    if (!child) {
        return fail(child.error());
    }
    Expected<std::vector<float>> samples(sample_count(performance));
    const TalkDeadline deadline = std::chrono::steady_clock::now() + kLongestPiece;
    Talk talk = send_piece(child->socket(), piece, performance.notes, deadline);
    talk = talk == Talk::good ? receive_played(child->socket(), deadline, samples) : talk;
    if (talk != Talk::good) {
        return fail(names_of(soundfonts) + ": " + child->end(talk, kLongestPiece));
    }
    return samples;
}

}  // namespace

PlayerBand draw_band(std::size_t soundfonts, Dice& dice) {
    constexpr double kConcertPitch = 0.3;  // semitones that a band may be off it
    constexpr double kDrumTuning = 4.0;    // semitones
    PlayerBand band;
    const double pitch = dice.uniform(-kConcertPitch, kConcertPitch);
    // Instruments of a band are in tune with one another; drums need not be.
    for (BandPlayer& player : band.channels) {
        player = draw_player(soundfonts, 0.0, dice);
        player.semitones = pitch;
    }
    for (BandPlayer& drummer : band.drummers) {
        drummer = draw_player(soundfonts, kDrumTuning, dice);
        if (dice.chance(0.25)) {
            drummer.kit = dice.pick({0, 8, 16, 24, 25, 32, 40});  // of General MIDI
        }
    }
    // Each drum is dealt on its own, so that a kit mixes several soundfonts.
    for (std::size_t& drummer : band.drummer_of_key) {
        drummer =
            static_cast<std::size_t>(dice.whole(0, static_cast<int>(PlayerBand::kDrummers) - 1));
    }
    return band;
}

std::vector<std::filesystem::path> draw_soundfonts(
    std::span<const std::filesystem::path> soundfonts, Dice& dice) {
    constexpr double kBand = 0.75;  // of the pieces
    if (soundfonts.size() > 1 && dice.chance(kBand)) {
        return {soundfonts.begin(), soundfonts.end()};
    }
    return {dice.pick<std::filesystem::path>(soundfonts)};
}

Talk receive_played(int socket, TalkDeadline deadline, Expected<std::vector<float>>& samples) {
    TalkAnswer answer;
    const Talk talk =
        receive_answer(socket, std::as_writable_bytes(std::span(*samples)), deadline, answer);
    if (talk != Talk::good) {
        return talk;
    }
    if (!answer.done) {
        samples = fail(std::move(answer.done.error()));
    }
    return !samples || are_finite(*samples) ? Talk::good : Talk::nonsense;
}

Expected<std::vector<float>> play_with(std::span<const std::filesystem::path> soundfonts,
                                       const Performance& performance,
                                       const PlayerRoom& room,
                                       Dice& dice) {
    SoundfontPiece piece;
    piece.room = room;
    piece.seconds = performance.seconds;
    piece.notes = performance.notes.size();
    if (soundfonts.size() > 1) {
        piece.has_band = 1;
        piece.band = draw_band(soundfonts.size(), dice);
    }
    return play_apart(soundfonts, performance, piece);
}

}  // namespace raks::audio
