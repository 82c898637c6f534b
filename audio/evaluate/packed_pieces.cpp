#include "audio/evaluate/packed_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace raks::audio {

namespace {

constexpr float kMost = 1e9F;  // larger ones would overflow sums of squares in float

// Whether all are finite and not huge; a NaN fails the comparison.
template <class Numbers>
bool are_sound(const Numbers& numbers) {
    return std::all_of(
        numbers.begin(), numbers.end(), [](float number) { return std::abs(number) < kMost; });
}

// Whether all numbers can come from feature computation: not huge, magnitudes not negative.
bool is_whole(const PieceFeatures& piece) {
    return std::all_of(piece.frames.begin(), piece.frames.end(), are_sound<MfccVector>) &&
           are_sound(piece.mel) &&
           std::all_of(piece.mel.begin(), piece.mel.end(), [](float mel) { return mel >= 0.0F; }) &&
           std::all_of(piece.windows.begin(),
                       piece.windows.end(),
                       [](const WindowFeatures& window) { return are_sound(window.features); });
}

}  // namespace

// The order is the file format: unpack_piece reads the same.
void pack_piece(const PieceFeatures& piece, Packer& packer) {
    packer.put_list(piece.name);
    packer.put_list(piece.group);
    packer.put_list(piece.genre);
    packer.put(piece.kind);
    packer.put_list(piece.frames);
    packer.put_list(piece.mel);
    packer.put_list(piece.windows);
}

Expected<PieceFeatures> unpack_piece(Unpacker& unpacker) {
    PieceFeatures piece;
    piece.name = unpacker.take_list<std::string>();
    piece.group = unpacker.take_list<std::string>();
    piece.genre = unpacker.take_list<std::string>();
    piece.kind = unpacker.take<PieceFeatures::Kind>();
    piece.frames = unpacker.take_list<std::vector<MfccVector>>();
    piece.mel = unpacker.take_list<std::vector<float>>();
    piece.windows = unpacker.take_list<std::vector<WindowFeatures>>();
    // The unpacker gives empty values after the end of its data, so one check here is enough.
    if (!unpacker.is_good()) {
        return fail("is cut short");
    }
    if (!is_whole(piece)) {
        return fail("holds numbers that no sound gives");
    }
    // One hop gives one MFCC vector and one row of mel magnitudes.
    if (piece.mel.size() != piece.frames.size() * BarPatterns::kMelBands) {
        return fail("frames of two kinds differ in number");
    }
    // score_piece reads a window's frames by these numbers without further checks.
    const bool fit =
        std::all_of(piece.windows.begin(), piece.windows.end(), [&](const WindowFeatures& window) {
            return window.segments >= 1 && window.segments <= BarPatterns::kSegments &&
                   window.end_frame >= window.segments * BarPatterns::kSegmentHops &&
                   window.end_frame <= static_cast<int>(piece.frames.size());
        });
    if (!fit) {
        return fail("a window lies outside its piece");
    }
    if ((!piece.genre.empty() && !is_dance_name(piece.genre)) ||
        piece.kind > PieceFeatures::Kind::written_held_out) {
        return fail("is damaged");
    }
    return piece;
}

}  // namespace raks::audio
