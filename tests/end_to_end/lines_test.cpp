// What `raks play --lines` tells other programs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"
#include "tests/support/peers.hpp"

namespace raks::test {
namespace {

class Lines : public ProgramTest {
 protected:
    [[nodiscard]] std::vector<std::string> play(const std::string& target) const {
        return {
            "play", "--no-sound", "--headless", "--quit", path("clicks.wav"), "--lines", target};
    }
    /// The beats among the lines, each a whole document.
    static std::vector<nlohmann::json> beats_of(const std::string& text) {
        std::vector<nlohmann::json> beats;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            auto json = nlohmann::json::parse(line, nullptr, false);
            EXPECT_FALSE(json.is_discarded()) << line;
            if (json["do"] == "beat") {
                beats.push_back(std::move(json));
            }
        }
        return beats;
    }
};

TEST_F(Lines, tell_the_beats_in_their_order_to_each_target) {
    write_clicks("clicks.wav", 8.0);
    auto arguments = play("-");
    arguments.insert(arguments.end(), {"--lines", path("beats.jsonl")});
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const auto beats = beats_of(result.out);
    ASSERT_GE(beats.size(), 4U) << result.out;
    EXPECT_EQ(beats[0]["change"], true);
    for (std::size_t i = 1; i < beats.size(); ++i) {
        EXPECT_GE(beats[i]["bar"], beats[i - 1]["bar"]);
    }
    EXPECT_EQ(beats_of(*read_file(path("beats.jsonl"), 100'000)).size(), beats.size());
}

TEST_F(Lines, osc_and_os2l_are_told_every_beat_that_the_lines_have_and_none_twice) {
    write_clicks("clicks.wav", 12.0);
    UdpReceiver osc;
    TcpListener desk;
    auto arguments = play("-");
    arguments.insert(arguments.end(), {"--osc", osc.place(), "--os2l", desk.place()});
    CapturedProcess player(plan(arguments));
    ASSERT_TRUE(desk.accept());
    std::vector<std::int64_t> positions;
    std::size_t triggers = 0;
    std::string last;
    // Often: the system keeps some hundred datagrams.
    const auto hear_osc = [&] {
        for (const std::string& packet : osc.take_all()) {
            triggers += packet.starts_with("/raks/trigger/beat") ? 1U : 0U;
            last = packet;
        }
    };
    for (std::string object = desk.read(); !object.empty(); object = desk.read()) {
        hear_osc();
        const auto json = nlohmann::json::parse(object, nullptr, false);
        ASSERT_FALSE(json.is_discarded()) << "one object a read: " << object;
        if (json["evt"] == "beat") {
            positions.push_back(json["pos"]);
        }
    }
    const ProcessResult result = player.wait();
    EXPECT_EQ(result.exit_code, 0) << result.err;
    const std::size_t beats = beats_of(result.out).size();
    EXPECT_GE(beats, 10U);
    EXPECT_EQ(positions.size(), beats);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        EXPECT_EQ(positions[i], static_cast<std::int64_t>(i));
    }
    hear_osc();
    EXPECT_EQ(triggers, beats);
    EXPECT_TRUE(last.starts_with("/raks/goodbye"));
}

TEST_F(Lines, a_file_may_stand_behind_a_target) {
    write_clicks("clicks.wav", 2.0);
    const ProcessResult result = run({"play",
                                      "--no-sound",
                                      "--headless",
                                      "--quit",
                                      "--avatar",
                                      "mannequin",
                                      "--lines",
                                      path("beats"),
                                      path("clicks.wav")});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find("clicks.wav"), std::string::npos) << result.err;
}

TEST_F(Lines, a_target_that_is_none_is_wrong_usage) {
    for (const auto& [option, target] : {std::pair("--osc", "desk"),
                                         std::pair("--osc", "desk:0"),
                                         std::pair("--os2l", "desk:99999"),
                                         std::pair("--wled", "light,led=3"),
                                         std::pair("--vmc", "pc,travel=feet"),
                                         std::pair("--midi-clock", ",lead=3"),
                                         std::pair("--midi-clock", "box,led=3"),
                                         std::pair("--midi-in", "")}) {
        expect_one_line({"play", "--headless", option, target}, 2, option);
    }
}

TEST_F(Lines, poses_of_nobody_are_wrong_usage) {
    expect_one_line({"live", "--no-avatar", "--vmc", "127.0.0.1"}, 2, "nobody dances");
}

TEST_F(Lines, are_never_written_over_a_file_that_is_there) {
    write_clicks("clicks.wav", 1.0);
    expect_one_line(play(path("clicks.wav")), 1, "clicks.wav: the file is there already");
}

}  // namespace
}  // namespace raks::test
