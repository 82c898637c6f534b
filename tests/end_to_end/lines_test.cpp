// What `raks play --lines` tells other programs.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "base/file.hpp"
#include "tests/end_to_end/program_fixture.hpp"

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

TEST_F(Lines, are_never_written_over_a_file_that_is_there) {
    write_clicks("clicks.wav", 1.0);
    expect_one_line(play(path("clicks.wav")), 1, "clicks.wav: the file is there already");
}

}  // namespace
}  // namespace raks::test
