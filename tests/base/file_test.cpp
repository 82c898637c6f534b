#include "base/file.hpp"
#include "base/file_set.hpp"
#include "base/pending_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "tests/support/temporary_folder.hpp"

namespace raks {
namespace {

namespace fs = std::filesystem;

class FileTest : public ::testing::Test {
 protected:
    /// How many files and folders lie in the folder itself.
    [[nodiscard]] std::ptrdiff_t count() const {
        return std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator());
    }

    test::TemporaryFolder folder_;
};

TEST_F(FileTest, what_was_written_is_read) {
    const std::string bytes("a\0b\n", 4);
    ASSERT_TRUE(write_file(folder_ / "x", bytes));
    EXPECT_EQ(read_file(folder_ / "x").value(), bytes);
    EXPECT_EQ(count(), 1) << "no part is left";
}

TEST_F(FileTest, an_uncommitted_file_leaves_what_was_there) {
    ASSERT_TRUE(write_file(folder_ / "x", "old"));
    {
        auto pending = PendingFile::create(folder_ / "x");
        ASSERT_TRUE(pending);
        ASSERT_TRUE(fs::exists(pending->part()));
    }
    EXPECT_EQ(read_file(folder_ / "x").value(), "old");
    EXPECT_EQ(count(), 1) << "no part is left";
}

TEST_F(FileTest, a_new_folder_appears_whole_or_not_at_all) {
    const fs::path folder = folder_ / "new";
    {
        const auto given_up = PendingFile::create_folder(folder);
        ASSERT_TRUE(given_up) << given_up.error().message;
        ASSERT_TRUE(write_file(given_up->part() / "x", "lost"));
    }
    EXPECT_TRUE(folder_.is_empty());
    // What has such a name is somebody else's.
    fs::create_directories(folder_ / "new.part" / "of a person");
    auto pending = PendingFile::create_folder(folder / "");  // as a shell completes it
    ASSERT_TRUE(pending) << pending.error().message;
    EXPECT_TRUE(fs::is_empty(pending->part()));
    ASSERT_TRUE(write_file(pending->part() / "x", "kept"));
    ASSERT_TRUE(pending->commit());
    EXPECT_EQ(read_file(folder / "x").value(), "kept");
    EXPECT_TRUE(fs::exists(folder_ / "new.part" / "of a person"));
    const auto refused = PendingFile::create_folder(folder);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              folder.string() + ": exists already and is not an empty folder; name another");
    EXPECT_EQ(PendingFile::create_folder("").error().message,
              "a folder name is empty; name a folder to write");
}

TEST_F(FileTest, errors_name_the_file_and_the_reason) {
    EXPECT_EQ(read_file(folder_ / "none").error().message,
              (folder_ / "none").string() + ": cannot be opened: No such file or directory");
    EXPECT_EQ(read_file(folder_.path()).error().message,
              folder_.path().string() + ": is a folder, not a file");
    EXPECT_EQ(write_file(folder_ / "a" / "b", "").error().message,
              (folder_ / "a" / "b").string() + ": cannot be written: No such file or directory");
    ASSERT_TRUE(write_file(folder_ / "big", std::string(100, 'x')));
    EXPECT_NE(read_file(folder_ / "big", 99).error().message.find("larger than"),
              std::string::npos);
}

TEST_F(FileTest, the_start_of_a_file_is_read_alone) {
    ASSERT_TRUE(write_file(folder_ / "x", "abcdef"));
    EXPECT_EQ(read_file_start(folder_ / "x", 3).value(), "abc");
    EXPECT_EQ(read_file_start(folder_ / "x", 100).value(), "abcdef");
    EXPECT_EQ(read_file_start(folder_ / "none", 3).error().message,
              (folder_ / "none").string() + ": cannot be opened: No such file or directory");
}

TEST_F(FileTest, what_is_no_plain_file_is_refused_without_waiting) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    fs::create_symlink(pipe, folder_ / "link");
    fs::create_symlink("b", folder_ / "a");
    fs::create_symlink("a", folder_ / "b");
    const std::pair<fs::path, const char*> cases[] = {{pipe, "not a plain file"},
                                                      {folder_ / "link", "not a plain file"},
                                                      {"/dev/zero", "not a plain file"},
                                                      {folder_ / "a", "symbolic links"},
                                                      {"", "empty"}};
    for (const auto& [path, part] : cases) {
        const auto whole = read_file(path);
        const auto start = read_file_start(path, 4);
        ASSERT_FALSE(whole) << path;
        EXPECT_NE(whole.error().message.find(part), std::string::npos) << whole.error().message;
        ASSERT_FALSE(start) << path;
        EXPECT_EQ(start.error().message, whole.error().message);
    }
}

TEST_F(FileTest, only_plain_files_are_replaced) {
    const fs::path pipe = folder_ / "pipe";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    for (const fs::path& path : {pipe, fs::path("/dev/full"), folder_.path(), fs::path()}) {
        EXPECT_FALSE(write_file(path, "text")) << path;
    }
    EXPECT_TRUE(fs::is_fifo(pipe));
    EXPECT_EQ(count(), 1);
}

TEST_F(FileTest, a_full_disk_leaves_the_old_file_and_no_part) {
    ASSERT_TRUE(write_file(folder_ / "x", "old"));
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit saved{};
    getrlimit(RLIMIT_FSIZE, &saved);
    rlimit small = saved;
    small.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &small);
    const auto result = write_file(folder_ / "x", std::string(1U << 20U, 'x'));
    setrlimit(RLIMIT_FSIZE, &saved);
    ASSERT_FALSE(result);
    EXPECT_NE(result.error().message.find("File too large"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "x").value(), "old");
    EXPECT_EQ(count(), 1) << "no part is left";
}

TEST_F(FileTest, of_files_that_belong_together_all_appear_or_none) {
    ASSERT_TRUE(write_files({{folder_ / "x.mtl", "old"}, {folder_ / "x.obj", "old"}}));
    // The second one cannot be made, so the first one stays as it was.
    const auto half =
        write_files({{folder_ / "x.mtl", "new"}, {folder_ / "none" / "x.obj", "new"}});
    ASSERT_FALSE(half);
    EXPECT_NE(half.error().message.find("x.obj"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "x.mtl").value(), "old");
    EXPECT_EQ(count(), 2) << "no part is left";
    ASSERT_TRUE(write_files({{folder_ / "x.mtl", "new"}, {folder_ / "x.obj", "new"}}));
    EXPECT_EQ(read_file(folder_ / "x.mtl").value(), "new");
    EXPECT_EQ(read_file(folder_ / "x.obj").value(), "new");
    EXPECT_EQ(count(), 2);
}

TEST(NamedAs, what_is_said_of_a_part_is_said_of_the_file_that_was_asked_for) {
    EXPECT_EQ(named_as("a/pics", "a/pics.x1y2z3.part", Error{"a/pics.x1y2z3.part/1.png: no room"})
                  .message,
              "a/pics/1.png: no room");
    EXPECT_EQ(named_as("a/pics", "a/pics.x1y2z3.part", Error{"b: no room"}).message, "b: no room");
}

TEST_F(FileTest, what_others_have_beside_it_is_not_touched) {
    ASSERT_TRUE(write_file(folder_ / "victim", "precious"));
    fs::create_symlink(folder_ / "victim", folder_ / "x.part");
    ASSERT_TRUE(write_file(folder_ / "y.part", "of a person"));
    ASSERT_TRUE(write_file(folder_ / "x", "text"));
    ASSERT_TRUE(write_file(folder_ / "y", "text"));
    EXPECT_EQ(read_file(folder_ / "victim").value(), "precious");
    EXPECT_EQ(read_file(folder_ / "y.part").value(), "of a person");
    EXPECT_TRUE(fs::is_symlink(folder_ / "x.part"));
}

TEST_F(FileTest, a_link_stays_and_what_it_leads_to_is_replaced) {
    fs::create_directory(folder_ / "far");
    ASSERT_TRUE(write_file(folder_ / "far" / "x", "old"));
    fs::permissions(folder_ / "far" / "x", fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink("far/x", folder_ / "link");
    fs::create_symlink("far/none", folder_ / "dangling");
    ASSERT_TRUE(write_file(folder_ / "link", "new"));
    ASSERT_TRUE(write_file(folder_ / "dangling", "new"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
    EXPECT_EQ(read_file(folder_ / "far" / "x").value(), "new");
    EXPECT_EQ(fs::status(folder_ / "far" / "x").permissions(),
              fs::perms::owner_read | fs::perms::owner_write)
        << "it has the rights of what it replaces";
    EXPECT_EQ(read_file(folder_ / "far" / "none").value(), "new");
}

TEST_F(FileTest, two_that_write_one_name_do_not_meet) {
    auto first = PendingFile::create(folder_ / "x");
    auto second = PendingFile::create(folder_ / "x");
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->part(), second->part());
    std::ofstream(first->part()) << "first";
    std::ofstream(second->part()) << "second";
    ASSERT_TRUE(second->commit());
    ASSERT_TRUE(first->commit());
    EXPECT_EQ(read_file(folder_ / "x").value(), "first") << "the last one that was finished";
    EXPECT_EQ(count(), 1);
}

/// A file that bears the mark of a part; false where the file system has no such marks.
bool write_marked(const fs::path& path) {
    return write_file(path, "left") && setxattr(path.c_str(), "user.raks.part", "", 0, 0) == 0;
}

TEST_F(FileTest, what_a_killed_process_left_is_removed_by_the_next_that_replaces_the_file) {
    ASSERT_TRUE(write_file(folder_ / "x", "old"));
    if (!write_marked(folder_ / "x.raks.part")) {
        GTEST_SKIP() << "this file system has no extended attributes";
    }
    ASSERT_TRUE(write_file(folder_ / "x", "new"));
    EXPECT_EQ(read_file(folder_ / "x").value(), "new");
    EXPECT_EQ(count(), 1) << "no part is left";
    EXPECT_LT(getxattr((folder_ / "x").c_str(), "user.raks.part", nullptr, 0), 0);
}

TEST_F(FileTest, a_part_without_our_mark_or_in_use_stays) {
    ASSERT_TRUE(write_file(folder_ / "x", "old"));
    ASSERT_TRUE(write_file(folder_ / "x.raks.part", "of a person"));
    ASSERT_TRUE(write_file(folder_ / "x", "new"));
    EXPECT_EQ(read_file(folder_ / "x.raks.part").value(), "of a person");
    ASSERT_TRUE(write_file(folder_ / "y", "old"));
    if (!write_marked(folder_ / "y.raks.part")) {
        GTEST_SKIP() << "this file system has no extended attributes";
    }
    const int writer = open((folder_ / "y.raks.part").c_str(), O_RDONLY | O_CLOEXEC);
    ASSERT_EQ(flock(writer, LOCK_EX | LOCK_NB), 0);
    ASSERT_TRUE(write_file(folder_ / "y", "new"));
    EXPECT_EQ(read_file(folder_ / "y").value(), "new");
    EXPECT_TRUE(fs::exists(folder_ / "y.raks.part"));
    close(writer);
}

TEST_F(FileTest, a_folder_is_changed_as_a_whole_or_not_at_all) {
    const fs::path folder = folder_ / "dances";
    fs::create_directories(folder / "inner");
    ASSERT_TRUE(write_file(folder / "changed", "old"));
    ASSERT_TRUE(write_file(folder / "inner" / "other", "stays"));
    for (const bool is_committed : {false, true}) {
        auto copy = PendingFile::create_changed_folder(folder);
        ASSERT_TRUE(copy) << copy.error().message;
        ASSERT_TRUE(write_file(copy->part() / "changed", "new"));
        ASSERT_TRUE(write_file(copy->part() / "added", "new"));
        EXPECT_EQ(read_file(folder / "changed").value(), "old") << "until it is committed";
        EXPECT_FALSE(fs::exists(folder / "added"));
        if (is_committed) {
            ASSERT_TRUE(copy->commit());
        }
    }
    EXPECT_EQ(read_file(folder / "changed").value(), "new");
    EXPECT_EQ(read_file(folder / "added").value(), "new");
    EXPECT_EQ(read_file(folder / "inner" / "other").value(), "stays");
    EXPECT_EQ(count(), 1) << "no part is left";
}

TEST_F(FileTest, a_folder_that_is_not_there_is_made_and_what_a_killed_process_left_goes) {
    fs::create_directory(folder_ / "new.raks.part");
    if (setxattr((folder_ / "new.raks.part").c_str(), "user.raks.part", "", 0, 0) != 0) {
        GTEST_SKIP() << "this file system has no extended attributes";
    }
    ASSERT_TRUE(write_file(folder_ / "new.raks.part" / "x", "half"));
    auto made = PendingFile::create_changed_folder(folder_ / "new");
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_TRUE(write_file(made->part() / "y", "whole"));
    ASSERT_TRUE(made->commit());
    EXPECT_EQ(read_file(folder_ / "new" / "y").value(), "whole");
    EXPECT_FALSE(fs::exists(folder_ / "new" / "x"));
    EXPECT_EQ(count(), 1);
    EXPECT_LT(getxattr((folder_ / "new").c_str(), "user.raks.part", nullptr, 0), 0);
}

TEST_F(FileTest, a_process_that_must_end_removes_what_is_not_complete) {
    auto lost = PendingFile::create(folder_ / "lost");
    auto begun = PendingFile::create(folder_ / "begun.mp4", PendingFile::AtEnd::kept);
    auto folder = PendingFile::create_folder(folder_ / "folder");
    auto pictures = PendingFile::create_folder(folder_ / "pictures");
    auto film = PendingFile::create(folder_ / "film.mp4", PendingFile::AtEnd::kept);
    ASSERT_TRUE(lost && begun && folder && pictures && film);
    std::ofstream(folder->part() / "inside") << "x";
    film->keep_from_here();
    pictures->keep_from_here();
    {
        const EndOfWriting end = remove_pending_files();
        EXPECT_EQ(count(), 2) << "what is of use by itself";
        EXPECT_EQ(end.kept,
                  (std::vector{folder_ / "film.stopped.mp4", folder_ / "pictures.stopped"}));
    }
    EXPECT_FALSE(folder->commit());
}

TEST_F(FileTest, what_is_stopped_lies_beside_and_replaces_nothing) {
    const fs::path name = folder_ / "x.bvh";
    ASSERT_TRUE(write_file(name, "old"));
    for (const char* const expected : {"x.stopped.bvh", "x.stopped-2.bvh"}) {
        for (const PendingFile::AtEnd at_end :
             {PendingFile::AtEnd::removed, PendingFile::AtEnd::kept}) {
            auto part = PendingFile::create(name, at_end);
            ASSERT_TRUE(part);
            ASSERT_TRUE(part->write(expected));
            EXPECT_EQ(part->commit_stopped().value(), folder_ / expected);
            EXPECT_EQ(read_file(folder_ / expected).value(), expected);
            if (at_end == PendingFile::AtEnd::removed) {
                fs::remove(folder_ / expected);
            }
        }
    }
    EXPECT_EQ(read_file(name).value(), "old");
    EXPECT_EQ(count(), 3) << "no part is left";
}

TEST_F(FileTest, a_name_as_long_as_a_system_allows_has_a_stopped_one) {
    EXPECT_TRUE(write_file(stopped_name(folder_ / (std::string(251, 'x') + ".mp4")), "text"));
}

TEST_F(FileTest, names_as_long_as_a_system_allows_are_written) {
    const std::string longest(255, 'x');
    ASSERT_TRUE(write_file(folder_ / longest, "text"));
    EXPECT_EQ(read_file(folder_ / longest).value(), "text");
}

class TextFile : public ::testing::Test {
 protected:
    Expected<std::string> read(std::string_view bytes) const {
        EXPECT_TRUE(write_file(path_, bytes));
        return read_text_file(path_, 1000);
    }
    void expect_refused(std::string_view bytes, const char* part) const {
        const auto text = read(bytes);
        ASSERT_FALSE(text) << *text;
        EXPECT_TRUE(text.error().message.starts_with(path_.string() + ": "));
        EXPECT_NE(text.error().message.find(part), std::string::npos) << text.error().message;
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "text";
};

TEST_F(TextFile, lines_end_alike_whoever_wrote_them) {
    EXPECT_EQ(read("a\nb\n").value(), "a\nb\n");
    EXPECT_EQ(read("a\r\nb\r\n").value(), "a\nb\n");
    EXPECT_EQ(read("a\rb\r").value(), "a\nb\n");
    EXPECT_EQ(read("a\r\n\rb\n\r").value(), "a\n\nb\n\n");
    EXPECT_EQ(read("").value(), "");
}

TEST_F(TextFile, the_mark_of_utf8_is_taken_off) {
    EXPECT_EQ(read("\xef\xbb\xbftake\t\u00fc").value(), "take\t\u00fc");
}

TEST_F(TextFile, what_is_no_utf8_text_is_refused) {
    using namespace std::string_view_literals;
    expect_refused(
        "\xff\xfe"
        "a\0b\0"sv,
        "UTF-16");
    expect_refused("\xfe\xff\0a\0b"sv, "UTF-16");
    expect_refused("a\nb\0c"sv, "line 2: holds a zero byte");
    expect_refused(std::string(1001, 'x'), "larger than");
}

}  // namespace

}  // namespace raks
