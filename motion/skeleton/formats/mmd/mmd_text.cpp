#include "motion/skeleton/formats/mmd/mmd_text.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace raks::motion {
namespace {

/// A character of the standard names.
struct MmdCharacter {
    std::string_view utf8;
    std::string_view windows_932;
    std::string_view gbk;  // empty: it lacks it
};

// Made by Python: c, c.encode("cp932"), c.encode("gbk").
constexpr std::array<MmdCharacter, 108> kMmdCharacters = {{
    {"あ", "\x82\xA0", "\xA4\xA2"},
    {"い", "\x82\xA2", "\xA4\xA4"},
    {"う", "\x82\xA4", "\xA4\xA6"},
    {"え", "\x82\xA6", "\xA4\xA8"},
    {"お", "\x82\xA8", "\xA4\xAA"},
    {"き", "\x82\xAB", "\xA4\xAD"},
    {"く", "\x82\xAD", "\xA4\xAF"},
    {"げ", "\x82\xB0", "\xA4\xB2"},
    {"こ", "\x82\xB1", "\xA4\xB3"},
    {"ご", "\x82\xB2", "\xA4\xB4"},
    {"ざ", "\x82\xB4", "\xA4\xB6"},
    {"し", "\x82\xB5", "\xA4\xB7"},
    {"じ", "\x82\xB6", "\xA4\xB8"},
    {"た", "\x82\xBD", "\xA4\xBF"},
    {"っ", "\x82\xC1", "\xA4\xC3"},
    {"つ", "\x82\xC2", "\xA4\xC4"},
    {"て", "\x82\xC4", "\xA4\xC6"},
    {"と", "\x82\xC6", "\xA4\xC8"},
    {"な", "\x82\xC8", "\xA4\xCA"},
    {"に", "\x82\xC9", "\xA4\xCB"},
    {"の", "\x82\xCC", "\xA4\xCE"},
    {"ば", "\x82\xCE", "\xA4\xD0"},
    {"ひ", "\x82\xD0", "\xA4\xD2"},
    {"び", "\x82\xD1", "\xA4\xD3"},
    {"ま", "\x82\xDC", "\xA4\xDE"},
    {"み", "\x82\xDD", "\xA4\xDF"},
    {"む", "\x82\xDE", "\xA4\xE0"},
    {"や", "\x82\xE2", "\xA4\xE4"},
    {"り", "\x82\xE8", "\xA4\xEA"},
    {"る", "\x82\xE9", "\xA4\xEB"},
    {"れ", "\x82\xEA", "\xA4\xEC"},
    {"ん", "\x82\xF1", "\xA4\xF3"},
    {"ィ", "\x83\x42", "\xA5\xA3"},
    {"イ", "\x83\x43", "\xA5\xA4"},
    {"ウ", "\x83\x45", "\xA5\xA6"},
    {"カ", "\x83\x4A", "\xA5\xAB"},
    {"キ", "\x83\x4C", "\xA5\xAD"},
    {"ク", "\x83\x4E", "\xA5\xAF"},
    {"グ", "\x83\x4F", "\xA5\xB0"},
    {"セ", "\x83\x5A", "\xA5\xBB"},
    {"タ", "\x83\x5E", "\xA5\xBF"},
    {"ブ", "\x83\x75", "\xA5\xD6"},
    {"メ", "\x83\x81", "\xA5\xE1"},
    {"ャ", "\x83\x83", "\xA5\xE3"},
    {"ラ", "\x83\x89", "\xA5\xE9"},
    {"ル", "\x83\x8B", "\xA5\xEB"},
    {"ン", "\x83\x93", "\xA5\xF3"},
    {"ヒ", "\x83\x71", "\xA5\xD2"},
    {"ジ", "\x83\x57", "\xA5\xB8"},
    {"ザ", "\x83\x55", "\xA5\xB6"},
    {"・", "\x81\x45", ""},
    {"ー", "\x81\x5B", "\xA9\x60"},
    {"上", "\x8F\xE3", "\xC9\xCF"},
    {"下", "\x89\xBA", "\xCF\xC2"},
    {"両", "\x97\xBC", "\x81\x49"},
    {"中", "\x92\x86", "\xD6\xD0"},
    {"人", "\x90\x6C", "\xC8\xCB"},
    {"先", "\x90\xE6", "\xCF\xC8"},
    {"全", "\x91\x53", "\xC8\xAB"},
    {"半", "\x94\xBC", "\xB0\xEB"},
    {"口", "\x8C\xFB", "\xBF\xDA"},
    {"右", "\x89\x45", "\xD3\xD2"},
    {"困", "\x8D\xA2", "\xC0\xA7"},
    {"小", "\x8F\xAC", "\xD0\xA1"},
    {"左", "\x8D\xB6", "\xD7\xF3"},
    {"差", "\x8D\xB7", "\xB2\xEE"},
    {"怒", "\x93\x7B", "\xC5\xAD"},
    {"悲", "\x94\xDF", "\xB1\xAF"},
    {"手", "\x8E\xE8", "\xCA\xD6"},
    {"指", "\x8E\x77", "\xD6\xB8"},
    {"捩", "\x9D\x80", "\xDE\xE6"},
    {"明", "\x96\xBE", "\xC3\xF7"},
    {"照", "\x8F\xC6", "\xD5\xD5"},
    {"目", "\x96\xDA", "\xC4\xBF"},
    {"真", "\x90\x5E", "\xD5\xE6"},
    {"笑", "\x8F\xCE", "\xD0\xA6"},
    {"肩", "\x8C\xA8", "\xBC\xE7"},
    {"腕", "\x98\x72", "\xCD\xF3"},
    {"腰", "\x8D\x98", "\xD1\xFC"},
    {"薬", "\x96\xF2", "\xCB\x61"},
    {"親", "\x90\x65", "\xD3\x48"},
    {"角", "\x8A\x70", "\xBD\xC7"},
    {"足", "\x91\xAB", "\xD7\xE3"},
    {"身", "\x90\x67", "\xC9\xED"},
    {"面", "\x96\xCA", "\xC3\xE6"},
    {"頭", "\x93\xAA", "\xEE\x5E"},
    {"首", "\x8E\xF1", "\xCA\xD7"},
    {"０", "\x82\x4F", "\xA3\xB0"},
    {"１", "\x82\x50", "\xA3\xB1"},
    {"２", "\x82\x51", "\xA3\xB2"},
    {"３", "\x82\x52", "\xA3\xB3"},
    {"４", "\x82\x53", "\xA3\xB4"},
    {"５", "\x82\x54", "\xA3\xB5"},
    {"６", "\x82\x55", "\xA3\xB6"},
    {"７", "\x82\x56", "\xA3\xB7"},
    {"８", "\x82\x57", "\xA3\xB8"},
    {"９", "\x82\x58", "\xA3\xB9"},
    {"Ｃ", "\x82\x62", "\xA3\xC3"},
    {"Ｄ", "\x82\x63", "\xA3\xC4"},
    {"Ｅ", "\x82\x64", "\xA3\xC5"},
    {"Ｉ", "\x82\x68", "\xA3\xC9"},
    {"Ｋ", "\x82\x6A", "\xA3\xCB"},
    {"Ｐ", "\x82\x6F", "\xA3\xD0"},
    {"Ｘ", "\x82\x77", "\xA3\xD8"},
    {"ｨ", "\xA8", ""},
    {"ｳ", "\xB3", ""},
    {"ｸ", "\xB8", ""},
    {"ﾝ", "\xDD", ""},
}};

constexpr std::string_view kNarrow = "0123456789IKPCDEX";
constexpr std::array<std::string_view, 17> kWide = {"０",
                                                    "１",
                                                    "２",
                                                    "３",
                                                    "４",
                                                    "５",
                                                    "６",
                                                    "７",
                                                    "８",
                                                    "９",
                                                    "Ｉ",
                                                    "Ｋ",
                                                    "Ｐ",
                                                    "Ｃ",
                                                    "Ｄ",
                                                    "Ｅ",
                                                    "Ｘ"};

// The bytes of the first character of UTF-8 text.
std::string_view first_character(std::string_view text) {
    std::size_t size = 1;
    while (size < text.size() && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U) {
        ++size;
    }
    return text.substr(0, size);
}

}  // namespace

std::optional<std::string> mmd_bytes(std::string_view utf8, MmdCode code) {
    if (code == MmdCode::utf8) {
        return std::string(utf8);
    }
    std::string bytes;
    while (!utf8.empty()) {
        const std::string_view character = first_character(utf8);
        utf8.remove_prefix(character.size());
        if (character.size() == 1) {
            bytes += character;
            continue;
        }
        const auto* const found =
            std::find_if(kMmdCharacters.begin(), kMmdCharacters.end(), [&](const auto& each) {
                return each.utf8 == character;
            });
        if (found == kMmdCharacters.end()) {
            return std::nullopt;
        }
        const std::string_view coded = code == MmdCode::gbk ? found->gbk : found->windows_932;
        if (coded.empty()) {
            return std::nullopt;
        }
        bytes += coded;
    }
    return bytes;
}

std::string narrow(std::string_view utf8) {
    std::string text;
    while (!utf8.empty()) {
        const std::string_view character = first_character(utf8);
        utf8.remove_prefix(character.size());
        const auto* const found = std::find(kWide.begin(), kWide.end(), character);
        text += found == kWide.end()
                    ? character
                    : kNarrow.substr(static_cast<std::size_t>(found - kWide.begin()), 1);
    }
    return text;
}

std::string wide(std::string_view utf8) {
    std::string text;
    while (!utf8.empty()) {
        const std::string_view character = first_character(utf8);
        utf8.remove_prefix(character.size());
        const std::size_t found =
            character.size() == 1 ? kNarrow.find(character) : std::string_view::npos;
        text += found == std::string_view::npos ? character : kWide[found];
    }
    return text;
}

}  // namespace raks::motion
