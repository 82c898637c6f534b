#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Threads: any. Real-time: no.
namespace raks::audio {

/// What a file says of its music, as people and programs wrote it: often missing, at times wrong.
/// Each text is one printable line of at most 200 bytes; empty: the file does not say.
struct AudioTags {
    std::string title{};
    std::string artist{};
    std::string album{};
    std::string genre{};          ///< any words: "Salsa", "Electronic; House"
    std::optional<double> bpm{};  ///< tempo, 20 to 400 beats a minute

    friend bool operator==(const AudioTags&, const AudioTags&) = default;
};

/// Sets the tag of a name ("title", "artist", "album", "genre", "bpm") from a text of unknown
/// origin, unless it is set already. An unknown name, an empty text and a tempo out of range change
/// nothing.
void set_tag(AudioTags& tags, std::string_view name, std::string_view value);

/// All tags as text, a line "name=value" for each that is set; tags_of_text() reads it again.
[[nodiscard]] std::string text_of_tags(const AudioTags& tags);
/// The tags of such a text; lines that are not understood are left out.
[[nodiscard]] AudioTags tags_of_text(std::string_view text);

/// How a listener calls the music: "Title (Artist)", or "Title"; without a title `otherwise`, such
/// as the name of the file.
[[nodiscard]] std::string title_line(const AudioTags& tags, std::string otherwise);

}  // namespace raks::audio
