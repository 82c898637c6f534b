// Which files a person means by a folder, a playlist or a name, and what is left out and why.
#include "engine/setup/play_list.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class PlayLists : public ::testing::Test {
 protected:
    /// A file of that name, with the folders above it.
    fs::path make(const std::string& name, const std::string& bytes = "x") const {
        const fs::path path = folder_ / name;
        fs::create_directories(path.parent_path());
        EXPECT_TRUE(write_file(path, bytes));
        return path;
    }
    /// A path as this test writes it, or as it is where it lies elsewhere.
    [[nodiscard]] std::string short_name(std::string text) const {
        const std::string folder = folder_.path().string() + "/";
        for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) {
            text.erase(at, folder.size());
        }
        return text;
    }
    /// What is played; where that is nothing, the error.
    [[nodiscard]] Names played(const std::vector<fs::path>& names) {
        const auto list = read_play_list(names);
        skipped_.clear();
        if (!list) {
            return {"error: " + short_name(list.error().message)};
        }
        for (const std::string& line : list->skipped.lines()) {
            skipped_.push_back(short_name(line));
        }
        count_ = list->skipped.count();
        Names files;
        for (const fs::path& file : list->files) {
            files.push_back(short_name(file.lexically_normal().string()));
        }
        return files;
    }

    test::TemporaryFolder folder_;
    Names skipped_;
    std::size_t count_ = 0;
};

TEST_F(PlayLists, a_folder_stands_for_its_music_in_natural_order_and_that_of_its_sub_folders) {
    for (const char* const name : {"m/10.mp3",
                                   "m/2.mp3",
                                   "m/Bonus.OGG",
                                   "m/disc 10/1.flac",
                                   "m/disc 2/1.flac",
                                   "m/disc 2/b/deep.wav",
                                   "m/cover.jpg",
                                   "m/list.m3u",
                                   "m/.hidden.mp3",
                                   "m/._2.mp3",
                                   "m/.Trash/3.mp3"}) {
        make(name);
    }
    EXPECT_EQ(played({folder_ / "m"}),
              (Names{"m/2.mp3",
                     "m/10.mp3",
                     "m/Bonus.OGG",
                     "m/disc 2/1.flac",
                     "m/disc 2/b/deep.wav",
                     "m/disc 10/1.flac"}));
    EXPECT_EQ(skipped_, Names{});
}

TEST_F(PlayLists, links_that_lead_back_end_and_are_named) {
    make("m/1.mp3");
    make("m/sub/2.mp3");
    fs::create_directory_symlink("..", folder_ / "m/sub/up");
    fs::create_directory_symlink("self", folder_ / "m/self");  // to nothing but itself
    make("other/3.mp3");
    fs::create_directory_symlink("../other", folder_ / "m/other");
    EXPECT_EQ(played({folder_ / "m"}), (Names{"m/1.mp3", "m/other/3.mp3", "m/sub/2.mp3"}));
    EXPECT_EQ(skipped_, (Names{"m/sub/up: leads back to a folder that is listed already"}));
}

TEST_F(PlayLists, names_stand_for_themselves_and_are_not_looked_at) {
    EXPECT_EQ(played({"-", folder_ / "no.mp3", folder_ / "any"}), (Names{"-", "no.mp3", "any"}));
    make("m/1.mp3");
    EXPECT_EQ(played({folder_ / "m", folder_ / "m"}), (Names{"m/1.mp3", "m/1.mp3"}));
    EXPECT_EQ(skipped_, Names{}) << "who names a folder twice hears it twice";
}

TEST_F(PlayLists, nothing_to_play_says_why) {
    fs::create_directory(folder_ / "empty");
    make("text/a.txt");
    EXPECT_EQ(played({folder_ / "empty"}), Names{"error: empty: no music in this folder"});
    EXPECT_EQ(played({folder_ / "text"}), Names{"error: text: no music in this folder"});
    EXPECT_EQ(played({folder_ / "empty", folder_ / "text"}),
              (Names{"error: empty: no music in this folder (and 1 more; nothing is left to "
                     "play)"}));
    EXPECT_EQ(played({}), Names{"error: no file is named"});
    EXPECT_EQ(played({folder_ / "no.m3u"}),
              Names{"error: no.m3u: cannot be opened: No such file or directory"});
}

TEST_F(PlayLists, an_address_in_the_network_is_refused_by_name) {
    const std::string why =
        ": is an address in the network, from where Raks loads nothing; save it as a file";
    EXPECT_EQ(played({"https://x.org/a.mp3"}), Names{"error: https://x.org/a.mp3" + why});
    make("1.mp3");
    make("l.m3u", "http://x.org:80/s\n1.mp3\n");
    EXPECT_EQ(played({folder_ / "l.m3u"}), Names{"1.mp3"});
    EXPECT_EQ(skipped_, Names{"http://x.org:80/s" + why});
}

TEST_F(PlayLists, entries_count_from_where_the_list_lies) {
    make("m/a.mp3");
    make("m/b c.mp3");
    make("n/d.mp3");
    make("m/caf\xc3\xa9.mp3");
    make("l/list.m3u8",
         "#EXTM3U\n../m/a.mp3\n..\\m\\b c.mp3\n" + (folder_ / "n/d.mp3").string() + "\nfile://" +
             folder_.path().string() + "/m/b%20c.mp3\n../n\n../m/caf\xe9.mp3\n");
    EXPECT_EQ(
        played({folder_ / "l/list.m3u8"}),
        (Names{"m/a.mp3", "m/b c.mp3", "n/d.mp3", "m/b c.mp3", "n/d.mp3", "m/caf\xc3\xa9.mp3"}));
    EXPECT_EQ(skipped_, Names{});
}

TEST_F(PlayLists, what_an_entry_names_and_is_not_there_is_skipped_by_name) {
    make("a.mp3");
    ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    make("l.pls", "[playlist]\nFile1=gone.mp3\nFile2=a.mp3\nFile3=pipe\nFile4=\xe9\n");
    EXPECT_EQ(played({folder_ / "l.pls"}), Names{"a.mp3"});
    EXPECT_EQ(skipped_,
              (Names{"gone.mp3: is not there (named by l.pls)",
                     "pipe: is not a plain file",
                     "\xc3\xa9: is not there (named by l.pls)"}));
}

TEST_F(PlayLists, lists_may_name_lists_but_each_is_read_once) {
    make("a.mp3");
    make("one.m3u", "a.mp3\none.m3u\ntwo.m3u\n");
    make("two.m3u", "one.m3u\ntwo.m3u\na.mp3\n");
    EXPECT_EQ(played({folder_ / "one.m3u"}), (Names{"a.mp3", "a.mp3"}));
    const std::string twice = ": is named by a playlist that it names itself, or twice";
    EXPECT_EQ(skipped_, (Names{"one.m3u" + twice, "one.m3u" + twice, "two.m3u" + twice}));
}

TEST_F(PlayLists, damaged_and_empty_lists_are_skipped_with_the_reason) {
    make("a.mp3");
    make("empty.m3u", "#EXTM3U\n");
    make("bad.pls", "<html>\n");
    make("bad.xspf", "<html>\n");
    EXPECT_EQ(played({folder_ / "empty.m3u", folder_ / "bad.pls", folder_ / "a.mp3"}),
              Names{"a.mp3"});
    EXPECT_EQ(skipped_,
              (Names{"empty.m3u: this playlist is empty",
                     "bad.pls: line 1: does not say [playlist]: it is not a .pls playlist"}));
    EXPECT_EQ(played({folder_ / "bad.xspf"}).at(0).rfind("error: bad.xspf: line ", 0), 0U);
}

TEST_F(PlayLists, a_hundred_thousand_entries_are_counted_and_few_are_named) {
    make("a.mp3");
    std::string text = "a.mp3\n";
    for (int i = 0; i < 100'000; ++i) {
        text += "missing/" + std::to_string(i) + ".mp3\n";
    }
    make("long.m3u", text);
    EXPECT_EQ(played({folder_ / "long.m3u"}), Names{"a.mp3"});
    EXPECT_EQ(count_, 100'000U);
    EXPECT_EQ(skipped_.size(), SkippedFiles::kMostLines);
}

TEST(SkippedFiles, report_says_how_many_and_why) {
    SkippedFiles skipped;
    EXPECT_EQ(skipped.report(), Names{});
    skipped.add("a: is bad");
    EXPECT_EQ(skipped.report(), (Names{"1 skipped:", "  a: is bad"}));
    for (int i = 0; i < 30; ++i) {
        skipped.add("b: is bad");
    }
    EXPECT_EQ(skipped.report().front(), "31 skipped:");
    EXPECT_EQ(skipped.report().back(), "  and 11 more");
    EXPECT_EQ(skipped.report().size(), 22U);
}

TEST(NaturalOrder, counts_numbers_by_their_value_and_is_an_order) {
    const Names sorted = {"",
                          "01",
                          "1",
                          "1a",
                          "2",
                          "10",
                          "A1",
                          "a2",
                          "a10",
                          "a10b",
                          "B",
                          "b ",
                          "b1",
                          "disc 2",
                          "disc 10",
                          "\xc3\xa9"};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        for (std::size_t j = 0; j < sorted.size(); ++j) {
            EXPECT_EQ(comes_before(sorted[i], sorted[j]), i < j) << sorted[i] << ", " << sorted[j];
        }
    }
    EXPECT_TRUE(comes_before("99999999999999999999998", "99999999999999999999999"));
}

TEST(Pipes, are_told_from_files) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
    ASSERT_TRUE(write_file(folder / "file", "x"));
    EXPECT_TRUE(is_pipe("-"));
    EXPECT_TRUE(is_pipe(folder / "pipe"));
    EXPECT_FALSE(is_pipe(folder / "file"));
    EXPECT_FALSE(is_pipe(folder / "none"));
}

}  // namespace
}  // namespace raks::engine
