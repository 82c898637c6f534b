#include "audio/io/audio_tags.hpp"

#include <gtest/gtest.h>

#include <string>

#include "audio/io/audio_file.hpp"
#include "audio/io/wav_writer.hpp"
#include "tests/audio/io/sound_files.hpp"

namespace raks::audio {
namespace {

TEST(AudioTags, take_the_first_good_value_of_known_names) {
    AudioTags tags;
    set_tag(tags, "title", " \t");
    set_tag(tags, "title", "  Aguanile\n");
    set_tag(tags, "title", "another one");
    set_tag(tags, "comment", "nobody asks for it");
    set_tag(tags, "genre", "a\tb\x01 \xFF");
    set_tag(tags, "artist", std::string(1000, 'x'));
    EXPECT_EQ(tags.title, "Aguanile");
    EXPECT_EQ(tags.genre, "a?b? ?");
    EXPECT_LE(tags.artist.size(), 200U);
    EXPECT_EQ(tags_of_text(text_of_tags(tags)), tags);
    EXPECT_EQ(tags.album, "");
}

TEST(AudioTags, take_a_tempo_that_music_can_have) {
    for (const char* text : {"", "fast", "0", "19.9", "401", "nan", "inf", "120 BPM", "-120"}) {
        AudioTags tags;
        set_tag(tags, "bpm", text);
        EXPECT_EQ(tags.bpm, std::nullopt) << text;
    }
    for (const auto& [text, bpm] : {std::pair{"20", 20.0}, {" 128 ", 128.0}, {"97.46", 97.46}}) {
        AudioTags tags;
        set_tag(tags, "bpm", text);
        EXPECT_EQ(tags.bpm, bpm) << text;
    }
}

TEST(AudioTags, come_back_from_their_text) {
    const AudioTags all{"A=B", "Héctor", "El \"Malo\"", "Salsa; Boogaloo", 97.46};
    EXPECT_EQ(tags_of_text(text_of_tags(all)), all);
    EXPECT_EQ(text_of_tags({}), "");
    EXPECT_EQ(tags_of_text(""), AudioTags());
    EXPECT_EQ(tags_of_text("\n=\nno tag\ntitle\ntitle=\nbpm=1e9\n=x"), AudioTags());
}

TEST(AudioTags, name_the_music_for_a_listener) {
    EXPECT_EQ(title_line({}, "a.mp3"), "a.mp3");
    EXPECT_EQ(title_line({.artist = "Willie Colon"}, "a.mp3"), "a.mp3");
    EXPECT_EQ(title_line({.title = "Aguanile"}, "a.mp3"), "Aguanile");
    EXPECT_EQ(title_line({.title = "Aguanile", .artist = "Willie Colon"}, "a.mp3"),
              "Aguanile (Willie Colon)");
}

using TaggedFiles = test::SoundFilesTest;

struct TaggedFormat {
    const char* name;
    const char* options;
    const char* bpm;  ///< what the format calls a tempo; null: it has no place for one
};

// Through the program that decodes, as `play` reads them.
TEST_F(TaggedFiles, say_their_tags_in_every_format) {
    const auto music = test::drums(1.0, 48'000, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    constexpr TaggedFormat kTagged[] = {{"a.wav", "", nullptr},
                                        {"a.flac", "", "BPM"},
                                        {"a.ogg", "-c:a libvorbis", "BPM"},
                                        {"a.opus", "-c:a libopus", "BPM"},
                                        {"a.aiff", "-write_id3v2 1", "TBPM"},
                                        {"a.mp3", "", "TBPM"},
                                        {"a.m4a", "", "tmpo"},
                                        {"a.mkv", "-c:a aac", "BPM"},
                                        {"a.webm", "-c:a libopus", "BPM"},
                                        {"a.wma", "", "WM/BeatsPerMinute"}};
    for (const TaggedFormat& format : kTagged) {
        SCOPED_TRACE(format.name);
        std::string options = std::string(format.options) +
                              " -metadata title='Mi Gente' -metadata artist='Héctor Lavoe'"
                              " -metadata album=Reventó -metadata genre=Salsa";
        if (format.bpm != nullptr) {
            options += std::string(" -metadata ") + format.bpm + "=97";
        }
        const auto file = encode(folder_ / "in.wav", format.name, options.c_str());
        const auto reader = open_audio_file(file);
        ASSERT_TRUE(reader) << reader.error().message;
        const AudioTags& tags = (*reader)->info().tags;
        EXPECT_EQ(tags.title, "Mi Gente");
        EXPECT_EQ(tags.artist, "Héctor Lavoe");
        EXPECT_EQ(tags.album, "Reventó");
        EXPECT_EQ(tags.genre, "Salsa");
        EXPECT_EQ(tags.bpm, format.bpm != nullptr ? std::optional(97.0) : std::nullopt);
        EXPECT_EQ((*reader)->warning(), "");
    }
}

TEST_F(TaggedFiles, without_tags_say_none) {
    const auto music = test::drums(1.0, 48'000, 2);
    ASSERT_TRUE(write_wav(folder_ / "in.wav", music.samples, 2, music.rate));
    const auto reader = open_audio_file(folder_ / "in.wav");
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ((*reader)->info().tags, AudioTags());
}

}  // namespace
}  // namespace raks::audio
