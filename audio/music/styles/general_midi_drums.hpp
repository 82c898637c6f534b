#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace raks::audio {

/// A drum of General MIDI's percussion map.
struct DrumName {
    int key;                ///< MIDI key, 35 to 87
    std::string_view name;  ///< as in files of styles
};

/// General MIDI's percussion map (RP-003: 35 to 81; 82 to 87: General MIDI 2), as styles name it.
inline constexpr std::array<DrumName, 53> kDrumNames = {{
    {35, "acoustic_kick"},  {36, "kick"},          {37, "side_stick"},
    {38, "snare"},          {39, "clap"},          {40, "electric_snare"},
    {41, "low_floor_tom"},  {42, "closed_hat"},    {43, "high_floor_tom"},
    {44, "pedal_hat"},      {45, "low_tom"},       {46, "open_hat"},
    {47, "low_mid_tom"},    {48, "high_mid_tom"},  {49, "crash"},
    {50, "high_tom"},       {51, "ride"},          {52, "china"},
    {53, "ride_bell"},      {54, "tambourine"},    {55, "splash"},
    {56, "cowbell"},        {57, "crash_2"},       {58, "vibraslap"},
    {59, "ride_2"},         {60, "high_bongo"},    {61, "low_bongo"},
    {62, "mute_conga"},     {63, "open_conga"},    {64, "low_conga"},
    {65, "high_timbale"},   {66, "low_timbale"},   {67, "high_agogo"},
    {68, "low_agogo"},      {69, "cabasa"},        {70, "maracas"},
    {71, "short_whistle"},  {72, "long_whistle"},  {73, "short_guiro"},
    {74, "long_guiro"},     {75, "claves"},        {76, "high_wood_block"},
    {77, "low_wood_block"}, {78, "mute_cuica"},    {79, "open_cuica"},
    {80, "mute_triangle"},  {81, "open_triangle"}, {82, "shaker"},
    {83, "jingle_bell"},    {84, "bell_tree"},     {85, "castanets"},
    {86, "mute_surdo"},     {87, "open_surdo"},
}};

/// The key of a drum of that table by its name; nothing for an unknown name.
[[nodiscard]] constexpr std::optional<int> drum_key(std::string_view name) noexcept {
    for (const DrumName& drum : kDrumNames) {
        if (drum.name == name) {
            return drum.key;
        }
    }
    return std::nullopt;
}

/// The same for code: a name that is not in the table does not compile.
[[nodiscard]] consteval int drum_named(std::string_view name) { return drum_key(name).value(); }

}  // namespace raks::audio
