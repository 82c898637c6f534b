#include "engine/outputs/line_output.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/descriptor.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "tests/support/temporary_folder.hpp"

namespace raks::engine {
namespace {

class LineOutput : public ::testing::Test {
 protected:
    [[nodiscard]] std::string path(const std::string& name) const {
        return (folder_ / name).string();
    }
    static OutputMoment beat(int count) {
        OutputMoment moment;
        moment.notice.count = count;
        moment.notice.bar = 17;
        moment.notice.paced_tempo = Bpm(119.98);
        moment.notice.confidence = 0.97F;
        moment.heard_at = HostClock::now();
        return moment;
    }

    test::TemporaryFolder folder_;
};

TEST_F(LineOutput, writes_beats_and_events_one_a_line) {
    auto output = open_lines(path("beats"));
    ASSERT_TRUE(output) << output.error().message;
    (*output)->tell(beat(1));
    OutputMoment drop;
    drop.notice.kind = Notice::Kind::event;
    drop.notice.event = MusicEvent::Kind::drop;
    (*output)->tell(drop);
    EXPECT_EQ((*output)->sent(), 2U);
    std::istringstream lines(*read_file(path("beats"), 10'000));
    std::string line;
    ASSERT_TRUE(std::getline(lines, line));
    auto json = nlohmann::json::parse(line);
    EXPECT_LE(std::abs(json["in_ms"].get<int>()), 60'000);
    json.erase("in_ms");
    EXPECT_EQ(json.dump(),
              R"({"bar":17,"bpm":119.98,"change":false,"confidence":0.97,"count":1,"do":"beat"})");
    ASSERT_TRUE(std::getline(lines, line));
    EXPECT_EQ(nlohmann::json::parse(line)["do"], "drop");
}

TEST_F(LineOutput, refuses_a_file_that_is_there) {
    ASSERT_TRUE(write_file(path("song.wav"), "precious"));
    const auto output = open_lines(path("song.wav"));
    ASSERT_FALSE(output);
    EXPECT_NE(output.error().message.find("song.wav: the file is there already"),
              std::string::npos);
    EXPECT_EQ(*read_file(path("song.wav"), 100), "precious");
    EXPECT_FALSE(open_lines(path("no/such/folder/x")));
}

TEST_F(LineOutput, says_once_that_the_disk_is_full) {
    auto output = open_lines("/dev/full");
    ASSERT_TRUE(output) << output.error().message;
    (*output)->tell(beat(1));
    EXPECT_EQ((*output)->take_trouble(),
              "/dev/full: No space left on device; no more lines go there");
    (*output)->tell(beat(2));
    EXPECT_FALSE((*output)->take_trouble());
    EXPECT_EQ((*output)->sent(), 0U);
    EXPECT_EQ((*output)->dropped(), 2U);
}

TEST_F(LineOutput, drops_whole_lines_while_nobody_reads_and_goes_on_then) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    auto output = open_lines(path("pipe"));
    ASSERT_TRUE(output) << output.error().message;
    int told = 0;
    while ((*output)->dropped() < 5 && told < 100'000) {
        (*output)->tell(beat(1 + told++ % 4));
    }
    ASSERT_EQ((*output)->dropped(), 5U);
    const Descriptor reader(open(path("pipe").c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC));
    std::string got;
    std::array<char, 4096> part{};
    const auto read_all = [&] {
        for (ssize_t n = 0; (n = read(reader.number, part.data(), part.size())) > 0;) {
            got.append(part.data(), static_cast<std::size_t>(n));
        }
    };
    read_all();
    (*output)->tell(beat(3));
    read_all();
    std::istringstream lines(got);
    std::string line;
    std::uint64_t count = 0;
    for (; std::getline(lines, line); ++count) {
        EXPECT_TRUE(nlohmann::json::accept(line)) << line;
    }
    EXPECT_EQ(count, (*output)->sent());
    EXPECT_EQ(nlohmann::json::parse(got.substr(got.rfind('{')))["count"], 3);
}

TEST_F(LineOutput, writes_what_a_player_plays) {
    auto output = open_lines(path("songs"));
    ASSERT_TRUE(output) << output.error().message;
    (*output)->name_song({"\"So\"", "Ñ"});
    EXPECT_EQ(nlohmann::json::parse(*read_file(path("songs"), 10'000)),
              nlohmann::json({{"do", "now"}, {"title", "\"So\""}, {"artist", "Ñ"}}));
}

}  // namespace
}  // namespace raks::engine
