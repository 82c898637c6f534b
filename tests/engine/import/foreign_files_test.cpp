// What is done to foreign files before assimp sees them.
#include "engine/import/foreign_text.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>

#include "base/file.hpp"

namespace raks::engine {
namespace {

std::string fault(ForeignFormat format, const std::string& bytes) {
    std::vector<std::string> notes;
    const auto text = mended_text(format, bytes, notes);
    return text ? "" : text.error().message;
}

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(ForeignObj, corners_that_are_there_are_taken) {
    for (const char* face : {"f 1 2 3",
                             "f -3 -2 -1\n",
                             "f 1 2 \\\n3\r\n",
                             "f 1/ 2/ 3/  # a comment",
                             "o a\ng b\ns off\nusemtl c\nf 1 2 3"}) {
        EXPECT_EQ(fault(ForeignFormat::obj, std::string(kTriangle) + face), "") << face;
    }
    EXPECT_EQ(fault(ForeignFormat::obj,
                    std::string(kTriangle) + "vt 0 0\nvn 0 0 1\nf 1/1/1 2//1 3/-1/-1\n"),
              "");
}

TEST(ForeignObj, what_is_not_there_is_told_with_its_line) {
    const struct {
        const char* line;
        const char* message;
    } rows[] = {
        {"f 0 1 2", "line 4: \"0\" names a corner that does not exist"},
        {"f 1 2 4", "line 4: \"4\" names a corner that does not exist"},
        {"f 1 2 -4", "line 4: \"-4\" names a corner that does not exist"},
        {"f 1/1 2/1 3/1", "line 4: \"1/1\" names a corner that does not exist"},
        {"f 1 2 3x", "line 4: \"3x\" names a corner that does not exist"},
        {"f 1 2 99999999999999999999", "names a corner that does not exist"},
        {"v 0 nan 0", "line 4: is a vertex without three numbers"},
        {"v 0 0", "line 4: is a vertex without three numbers"},
    };
    for (const auto& row : rows) {
        EXPECT_NE(fault(ForeignFormat::obj, std::string(kTriangle) + row.line).find(row.message),
                  std::string::npos)
            << row.line;
    }
    EXPECT_EQ(fault(ForeignFormat::obj, "f 1 2 3"),
              "line 1: \"1\" names a corner that does not exist");
    EXPECT_EQ(fault(ForeignFormat::obj, "hello"), "is not OBJ: there are no vertices in it");
    EXPECT_EQ(fault(ForeignFormat::obj, ""), "empty");
}

TEST(ForeignFbx, that_is_none_or_cut_is_told) {
    const std::string head("Kaydara FBX Binary  \0\x1a\0", 23);
    const std::string version("\xE8\x1C\0\0", 4);  // 7400
    const std::string end(13, '\0');
    EXPECT_EQ(fault(ForeignFormat::fbx, head + version + end), "");
    EXPECT_EQ(fault(ForeignFormat::fbx, head), "is cut off within its header; copy it again");
    EXPECT_EQ(fault(ForeignFormat::fbx, head + version),
              "is damaged: the record at byte 27 is cut off");
    EXPECT_EQ(fault(ForeignFormat::fbx, head + std::string("\x0F\x27\0\0", 4)),
              "FBX version 9999: 7100 to 7900 are read; save it as GLB, in Blender for example");
    // A record "a" that would end at its own start.
    const std::string own_start(
        "\x1B\0\0\0\0\0\0\0\0\0\0\0\x01"
        "a",
        14);
    EXPECT_NE(fault(ForeignFormat::fbx, head + version + own_start + end).find("within the one"),
              std::string::npos);
    EXPECT_EQ(fault(ForeignFormat::fbx, "hello"), "is not FBX");
    EXPECT_EQ(fault(ForeignFormat::fbx, "; FBX 7.4\nFBXHeaderExtension: {\n"),
              "is cut off: a brace or a text is not closed");
    EXPECT_EQ(fault(ForeignFormat::fbx, "; a } in words\nFBXHeaderExtension: \"{\" {\n}\n"), "");
}

/// Puts a number of 64 bits in the place of another in a connection from object to object.
std::string reconnected(std::string bytes, std::int64_t child, std::int64_t old, std::int64_t now) {
    const auto number = [](std::int64_t value) {
        std::string text = "L";
        text.resize(1 + sizeof(value));
        std::memcpy(text.data() + 1, &value, sizeof(value));
        return text;
    };
    const std::size_t at = bytes.find("OO" + number(child) + number(old));
    EXPECT_NE(at, std::string::npos);
    return at == std::string::npos ? bytes : bytes.replace(at + 2 + 9, 9, number(now));
}

TEST(ForeignFbx, a_mesh_of_a_model_that_is_not_there_goes_to_the_one_without_a_mesh) {
    const std::string good =
        read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/bent_bar.fbx").value();
    std::vector<std::string> notes;
    EXPECT_EQ(mended_text(ForeignFormat::fbx, good, notes), good);
    EXPECT_TRUE(notes.empty());
    const std::string astray = reconnected(good, 100, 200, 987'654);
    EXPECT_EQ(mended_text(ForeignFormat::fbx, astray, notes), good);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0], "a mesh is connected to a model that is not there: put on \"bar\"");
    // Where no mesh goes astray, a bone's lost connection is none of this.
    const std::string loose = reconnected(good, 312, 311, 987'654);
    notes.clear();
    EXPECT_EQ(mended_text(ForeignFormat::fbx, loose, notes), loose);
    EXPECT_TRUE(notes.empty());
}

std::string bar(const char* name) {
    return read_file(std::string(RAKS_SOURCE_DIR) + "/tests/data/avatars/" + name).value();
}

/// A number and a text as properties of a binary FBX.
std::string number_property(std::int64_t value) {
    std::string bytes(1 + sizeof(value), 'L');
    std::memcpy(bytes.data() + 1, &value, sizeof(value));
    return bytes;
}
std::string text_property(const std::string& text) {
    std::string bytes("S\0\0\0\0", 5);
    bytes[1] = static_cast<char>(text.size());
    return bytes + text;
}

/// What stands once in it, replaced.
std::string replaced(std::string bytes, const std::string& old, const std::string& now) {
    const std::size_t at = bytes.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    EXPECT_EQ(bytes.find(old, at + 1), std::string::npos) << old;
    return at == std::string::npos ? bytes : bytes.replace(at, old.size(), now);
}

TEST(ForeignFbx, a_connection_from_a_property_becomes_one_to_a_property) {
    const std::string turn = text_property("Lcl Rotation");
    const std::string child = number_property(620);
    const std::string parent = number_property(312);
    const std::string good = bar("bent_bar.fbx");
    std::vector<std::string> notes;
    for (const std::string& from_property : {text_property("PO") + child + turn + parent,
                                             text_property("PO") + child + parent + turn}) {
        EXPECT_EQ(
            mended_text(ForeignFormat::fbx,
                        replaced(good, text_property("OP") + child + parent + turn, from_property),
                        notes),
            good);
    }
    const std::string text = bar("bent_bar_text.fbx");
    EXPECT_EQ(mended_text(ForeignFormat::fbx,
                          replaced(text,
                                   "\"OP\", 620, 312, \"Lcl Rotation\"",
                                   "\"PO\", 620, \"Lcl Rotation\", 312"),
                          notes),
              text);
    EXPECT_TRUE(notes.empty());
    // Nothing to mend at the end of a text, and in words.
    for (const char* const end :
         {"C: \"PO\"", "C: \"PO\", 6", "C: \"PO\", 6, \"a", "\"PO\",1,\"a\",2"}) {
        const std::string cut = text + "; " + end;
        EXPECT_EQ(mended_text(ForeignFormat::fbx, cut, notes), cut) << end;
    }
}

TEST(ForeignFbx, a_connection_that_assimp_cannot_read_is_left_out_with_a_note) {
    const std::string good = bar("bent_bar.fbx");
    const std::string number = number_property(620);
    // As wide as the number that stood there.
    const std::string word = text_property("1234");
    const std::string at = text_property("OP") + number + number_property(312);
    std::vector<std::string> notes;
    const auto mended =
        mended_text(ForeignFormat::fbx,
                    replaced(good, at, text_property("OP") + word + number_property(312)),
                    notes);
    ASSERT_TRUE(mended);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_EQ(notes[0], "1 of its connections are of no kind that is read: left out");
    EXPECT_EQ(*mended,
              replaced(good, "C" + at, "c" + text_property("OP") + word + number_property(312)));
}

TEST(ForeignFbx, no_colour_has_a_factor) {
    std::vector<std::string> notes;
    EXPECT_EQ(
        mended_text(ForeignFormat::fbx,
                    "FBXHeaderExtension: {\n}\nP: \"DiffuseFactor\", \"Number\", \"\", \"A\",0.8\n",
                    notes),
        "FBXHeaderExtension: {\n}\nP: \"DiffuseFacto_\", \"Number\", \"\", \"A\",0.8\n");
}

TEST(ForeignCollada, utf_16_becomes_utf_8) {
    const std::string text =
        "<?xml version=\"1.0\" encoding=\"utf-16\"?><COLLADA>\xC3\xA9</COLLADA>";
    std::string wide = "\xFF\xFE";
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool is_accented = text[i] == '\xC3';
        wide += is_accented ? '\xE9' : text[i];
        wide += '\0';
        i += is_accented ? 1 : 0;
    }
    std::vector<std::string> notes;
    const auto mended = mended_text(ForeignFormat::collada, wide, notes);
    ASSERT_TRUE(mended) << mended.error().message;
    EXPECT_EQ(*mended, "<?xml version=\"1.0\" encoding=\"utf-8\"?><COLLADA>\xC3\xA9</COLLADA>");
    EXPECT_EQ(fault(ForeignFormat::collada, wide.substr(0, wide.size() - 1)),
              "is UTF-16 that is cut off");
}

TEST(ForeignCollada, blanks_before_the_numbers_of_a_list_are_taken_out) {
    std::vector<std::string> notes;
    EXPECT_EQ(
        mended_text(ForeignFormat::collada, "<COLLADA><p> \n 1 2 </p> <q> a</q></COLLADA>", notes),
        "<COLLADA><p>1 2 </p> <q> a</q></COLLADA>");
}

TEST(ForeignCollada, what_assimp_would_break_at_is_refused) {
    EXPECT_EQ(fault(ForeignFormat::collada, "<xml/>"), "is not Collada");
    EXPECT_EQ(fault(ForeignFormat::collada, "<!DOCTYPE x [<!ENTITY a \"b\">]><COLLADA/>"),
              "it defines entities of its own, which are not read");
    std::string deep = "<COLLADA>";
    for (int i = 0; i < 300; ++i) {
        deep += "<node>";
    }
    EXPECT_EQ(fault(ForeignFormat::collada, deep), "has more than 256 elements inside one another");
    EXPECT_EQ(fault(ForeignFormat::collada, "<COLLADA><p>0 -5</p></COLLADA>"),
              "has a corner with a negative number");
    EXPECT_EQ(fault(ForeignFormat::collada, "<COLLADA><accessor stride=\"0\"/></COLLADA>"),
              "has a source with stride 0");
}

}  // namespace
}  // namespace raks::engine
