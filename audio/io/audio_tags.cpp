#include "audio/io/audio_tags.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>

#include "base/printable.hpp"

#include <fmt/format.h>

namespace raks::audio {
namespace {

constexpr std::size_t kMostTagBytes = 200;
constexpr double kSlowestBpm = 20.0;
constexpr double kFastestBpm = 400.0;
constexpr std::string_view kBpm = "bpm";

struct TextTag {
    std::string_view name;
    std::string AudioTags::*text;
};
constexpr std::array<TextTag, 4> kTextTags = {{{"title", &AudioTags::title},
                                               {"artist", &AudioTags::artist},
                                               {"album", &AudioTags::album},
                                               {"genre", &AudioTags::genre}}};

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlanks(" \t\r\n\0", 5);
    const std::size_t first = text.find_first_not_of(kBlanks);
    return first == std::string_view::npos
               ? std::string_view()
               : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::optional<double> bpm_of(std::string_view text) {
    double bpm = 0.0;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, bpm);
    const bool is_number = error == std::errc() && read == end;
    return is_number && bpm >= kSlowestBpm && bpm <= kFastestBpm ? std::optional(bpm)
                                                                 : std::nullopt;
}

}  // namespace

void set_tag(AudioTags& tags, std::string_view name, std::string_view value) {
    const std::string_view words = trimmed(value);
    if (words.empty()) {
        return;
    }
    if (name == kBpm && !tags.bpm) {
        tags.bpm = bpm_of(words);
    }
    for (const TextTag& tag : kTextTags) {
        if (name == tag.name && (tags.*tag.text).empty()) {
            // What is cut gets three dots; a text that was cut is not cut again.
            tags.*tag.text =
                printable(words, words.size() > kMostTagBytes ? kMostTagBytes - 3 : kMostTagBytes);
        }
    }
}

std::string text_of_tags(const AudioTags& tags) {
    std::string text;
    for (const TextTag& tag : kTextTags) {
        if (const std::string& words = tags.*tag.text; !words.empty()) {
            text += fmt::format("{}={}\n", tag.name, words);
        }
    }
    return tags.bpm ? text + fmt::format("{}={}\n", kBpm, *tags.bpm) : text;
}

AudioTags tags_of_text(std::string_view text) {
    AudioTags tags;
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        const std::size_t equals = line.find('=');
        if (equals != std::string_view::npos) {
            set_tag(tags, line.substr(0, equals), line.substr(equals + 1));
        }
        text.remove_prefix(std::min(text.size(), line.size() + 1));
    }
    return tags;
}

std::string title_line(const AudioTags& tags, std::string otherwise) {
    if (tags.title.empty()) {
        return otherwise;
    }
    return tags.artist.empty() ? tags.title : fmt::format("{} ({})", tags.title, tags.artist);
}

}  // namespace raks::audio
