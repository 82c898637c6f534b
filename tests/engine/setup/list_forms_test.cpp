// What playlists say: every form and encoding that programs write, and what is no playlist.
#include "engine/setup/list_forms.hpp"

#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "tests/support/mangled.hpp"

namespace raks::engine {
namespace {

using Names = std::vector<std::string>;

/// The likeliest name of each entry, or the error.
Names names_of(std::string_view text, ListForm form) {
    const auto list = parse_list(text, form);
    if (!list) {
        return {"error: " + list.error().message};
    }
    Names names;
    for (const ListEntry& entry : list->entries) {
        EXPECT_FALSE(entry.empty());
        names.push_back(entry.front());
    }
    return names;
}

constexpr std::string_view kPls =
    "[playlist]\nNumberOfEntries=2\nFile2=b.mp3\nTitle2=B\nLength2=-1\nfile1 = a "
    "b.mp3\nVersion=2\n";
constexpr std::string_view kXspf =
    R"(<?xml version="1.0" encoding="UTF-8"?>
<playlist version="1" xmlns="http://xspf.org/ns/0/">
  <title>Mine &amp; yours</title>
  <trackList>
    <track><title>A</title><location>disc%201/a%26b.ogg</location></track>
    <track><location>file:///music/b.ogg</location><location>b.mp3</location></track>
    <track><title>no place</title></track>
    <track><location><![CDATA[ https://x.org/c.ogg ]]></location></track>
  </trackList>
</playlist>
)";

TEST(ListForms, are_told_by_the_ending_in_any_case) {
    EXPECT_EQ(list_form_of("a/B.M3U"), ListForm::m3u);
    EXPECT_EQ(list_form_of("b.m3u8"), ListForm::m3u);
    EXPECT_EQ(list_form_of("b.Pls"), ListForm::pls);
    EXPECT_EQ(list_form_of("b.xspf"), ListForm::xspf);
    EXPECT_EQ(list_form_of("b.mp3"), std::nullopt);
    EXPECT_EQ(list_form_of("m3u"), std::nullopt);
}

TEST(ListForms, lines_of_an_m3u_are_entries_but_for_comments_and_blanks) {
    const Names wanted = {"a.mp3", "sub/b c.mp3", "/abs/d.flac"};
    for (const char* const end : {"\n", "\r\n", "\r"}) {
        std::string text;
        for (const char* const line : {"#EXTM3U",
                                       "#EXTINF:123,Artist - Title",
                                       "a.mp3",
                                       "",
                                       "  sub/b c.mp3\t",
                                       "# a word",
                                       "/abs/d.flac"}) {
            text += std::string(line) + end;
        }
        EXPECT_EQ(names_of(text, ListForm::m3u), wanted);
        EXPECT_EQ(names_of("\xef\xbb\xbf" + text, ListForm::m3u), wanted) << "with a mark";
    }
    EXPECT_EQ(names_of("a.mp3", ListForm::m3u), Names{"a.mp3"}) << "no line end";
    EXPECT_EQ(names_of("", ListForm::m3u), Names{});
}

TEST(ListForms, old_encodings_are_read_as_they_are_and_as_windows_1252) {
    const auto list = parse_list("caf\xe9 \x96 1.mp3\n", ListForm::m3u);
    ASSERT_TRUE(list);
    EXPECT_EQ(list->entries.at(0),
              (ListEntry{"caf\xe9 \x96 1.mp3", "caf\xc3\xa9 \xe2\x80\x93 1.mp3"}));
    EXPECT_EQ(parse_list("caf\xc3\xa9.mp3\n", ListForm::m3u)->entries.at(0),
              (ListEntry{"caf\xc3\xa9.mp3"}));
}

TEST(ListForms, utf_16_with_its_mark_is_read) {
    const std::string little(
        "\xff\xfe"
        "a\0\xe9\0.\0o\0g\0g\0\n\0\x3d\xd8\xb5\xdc\n\0",
        20);
    EXPECT_EQ(names_of(little, ListForm::m3u), (Names{"a\xc3\xa9.ogg", "\xf0\x9f\x92\xb5"}));
    const std::string big("\xfe\xff\0a\0.\0o\0g\0g", 12);
    EXPECT_EQ(names_of(big, ListForm::m3u), (Names{"a.ogg"}));
    const std::string half(
        "\xff\xfe\x3d\xd8"
        "a\0",
        6);
    EXPECT_EQ(names_of(half, ListForm::m3u),
              (Names{"\xef\xbf\xbd"
                     "a"}));
}

TEST(ListForms, files_of_a_pls_come_by_their_numbers) {
    EXPECT_EQ(names_of(kPls, ListForm::pls), (Names{"a b.mp3", "b.mp3"}));
    EXPECT_EQ(names_of("; by hand\n\n[PLAYLIST]\nFile10=j\nFile9=i\nFile=x\nFilex=y\nFile1=\n",
                       ListForm::pls),
              (Names{"i", "j"}));
}

TEST(ListForms, places_of_an_xspf_are_decoded) {
    const auto list = parse_list(kXspf, ListForm::xspf);
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_EQ(list->entries.size(), 3U);
    EXPECT_EQ(list->entries[0].front(), "disc 1/a&b.ogg");
    EXPECT_EQ(list->entries[1], (ListEntry{"file:///music/b.ogg", "b.mp3"}));
    EXPECT_EQ(list->entries[2], (ListEntry{"https://x.org/c.ogg"}));
    const std::string with_prefix =
        "<x:playlist xmlns:x='u'><x:trackList><x:track><x:location>a.ogg</x:location></x:track>"
        "</x:trackList></x:playlist>";
    EXPECT_EQ(names_of(with_prefix, ListForm::xspf), Names{"a.ogg"});
}

TEST(ListForms, what_is_no_playlist_says_where_it_shows) {
    const struct {
        std::string text;
        ListForm form;
        std::string error;
    } rows[] = {
        {std::string("a\nb\0c\n", 6),
         ListForm::m3u,
         "line 2: holds a zero byte: it is damaged, or not a playlist"},
        {"#EXTM3U\n#EXT-X-TARGETDURATION:10\n1.ts\n",
         ListForm::m3u,
         "lists the pieces of a stream (HLS), not songs; save the stream as a file"},
        {"\n\nFile1=a\n",
         ListForm::pls,
         "line 3: does not say [playlist]: it is not a .pls playlist"},
        {"", ListForm::pls, "line 1: does not say [playlist]: it is not a .pls playlist"},
        {"<a>\n<b>\n</a>",
         ListForm::xspf,
         "line 3: is not the XML of a playlist: start-end tags mismatch"},
        {"<playlist/>",
         ListForm::xspf,
         "has no <trackList> in a <playlist>: it is not an .xspf playlist"},
        {"", ListForm::xspf, "line 1: is not the XML of a playlist: no document element found"},
    };
    for (const auto& row : rows) {
        EXPECT_EQ(names_of(row.text, row.form), Names{"error: " + row.error});
    }
}

TEST(ListForms, entities_of_a_documents_own_are_not_expanded) {
    const std::string bomb =
        "<!DOCTYPE p [<!ENTITY a \"aaaaaaaaaa\"><!ENTITY b \"&a;&a;&a;&a;\">"
        "<!ENTITY f SYSTEM \"file:///etc/passwd\">]>"
        "<playlist><trackList><track><location>&b;&f;.ogg</location></track></trackList></"
        "playlist>";
    EXPECT_EQ(names_of(bomb, ListForm::xspf), Names{"&b;&f;.ogg"});
}

TEST(ListForms, only_the_first_million_entries_are_taken) {
    std::string text;
    for (std::size_t i = 0; i < kMostListEntries + 5; ++i) {
        text += "a\n";
    }
    const auto list = parse_list(text, ListForm::m3u);
    ASSERT_TRUE(list);
    EXPECT_EQ(list->entries.size(), kMostListEntries);
    EXPECT_TRUE(list->is_cut);
}

TEST(ListForms, addresses_are_told_from_names) {
    EXPECT_EQ(scheme_of("https://x/y"), "https");
    EXPECT_EQ(scheme_of("svn+ssh://x"), "svn+ssh");
    for (const char* const name :
         {"file:///a", "FILE://a", "C://a", "a/b://c", "://x", "1x://y", "song: the.mp3", ""}) {
        EXPECT_EQ(scheme_of(name), "") << name;
    }
    EXPECT_EQ(file_of_address("file:///a%20b/%c3%a9"), "/a b/\xc3\xa9");
    EXPECT_EQ(file_of_address("file://localhost/a"), "/a");
    EXPECT_EQ(file_of_address("file:a"), "a");
    EXPECT_EQ(file_of_address("file:///a%00b"), "file:///a%00b");
    EXPECT_EQ(file_of_address("file://"), "file://");
    EXPECT_EQ(file_of_address("a%20b"), "a%20b");
    EXPECT_EQ(percent_decoded("100%"), "100%");
    EXPECT_EQ(percent_decoded("%4"), "%4");
    EXPECT_EQ(percent_decoded("%zz%41"), "%zzA");
}

/// Any bytes are read or refused in one line, and no entry is empty.
void expect_sound(const std::string& text, ListForm form) {
    const auto list = parse_list(text, form);
    if (!list) {
        EXPECT_EQ(list.error().message.find('\n'), std::string::npos);
        return;
    }
    for (const ListEntry& entry : list->entries) {
        ASSERT_FALSE(entry.empty());
        for (const std::string& name : entry) {
            EXPECT_FALSE(name.empty());
            EXPECT_EQ(name.find('\0'), std::string::npos);
        }
    }
}

TEST(ListForms, damaged_and_cut_lists_are_read_or_refused) {
    const std::pair<std::string, ListForm> files[] = {
        {"#EXTM3U\r\ncaf\xe9.mp3\r\n\xc3\xa9.mp3\r\n", ListForm::m3u},
        {std::string("\xff\xfe"
                     "a\0\n\0b\0",
                     8),
         ListForm::m3u},
        {std::string(kPls), ListForm::pls},
        {std::string(kXspf), ListForm::xspf}};
    for (const auto& [file, form] : files) {
        for (std::size_t length = 0; length <= file.size(); ++length) {
            expect_sound(file.substr(0, length), form);
        }
        for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
            expect_sound(test::mangled(file, {.seed = seed, .bytes = 1 + seed % 6}), form);
        }
    }
}

}  // namespace
}  // namespace raks::engine
