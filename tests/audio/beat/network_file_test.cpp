// The network's file: what was saved is read back, and nothing else is believed.
#include "audio/beat/network/network_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "audio/beat/network/bar_network.hpp"
#include "base/file.hpp"
#include "base/random.hpp"
#include "tests/support/mangled.hpp"

namespace raks::audio {
namespace {

class NetworkFile : public ::testing::Test {
 protected:
    void SetUp() override {
        const char* const test = ::testing::UnitTest::GetInstance()->current_test_info()->name();
        path_ = std::filesystem::path(::testing::TempDir()) / (std::string(test) + ".json");
    }
    void TearDown() override { std::filesystem::remove(path_); }

    static BeatNetwork small() {
        BeatNetwork network(4, 1, 2);
        const CounterRandom random(5);
        for (std::size_t i = 0; i < network.parameters().size(); ++i) {
            network.parameters()[i] = static_cast<float>(random.normal(i));
        }
        auto bars = std::make_shared<BarNetwork>(2, 1);
        for (std::size_t i = 0; i < bars->parameters().size(); ++i) {
            bars->parameters()[i] = static_cast<float>(random.normal(10'000 + i));
        }
        network.set_bars(std::move(bars));
        return network;
    }
    std::string saved_text() {
        EXPECT_TRUE(save_network(small(), {"a \"command\"", "people"}, path_));
        return *read_file(path_);
    }
    /// The error for this text; empty when it is read.
    std::string error_of(const std::string& text) {
        EXPECT_TRUE(write_file(path_, text));
        const auto network = load_network(path_);
        return network ? "" : network.error().message;
    }
    static std::string replaced(std::string text, std::string_view what, std::string_view with) {
        const std::size_t at = text.find(what);
        EXPECT_NE(at, std::string::npos) << what;
        return text.replace(at, what.size(), with);
    }
    std::filesystem::path path_;
};

TEST_F(NetworkFile, gives_back_what_was_saved) {
    saved_text();
    const auto network = load_network(path_);
    ASSERT_TRUE(network) << network.error().message;
    const BeatNetwork original = small();
    EXPECT_EQ((*network)->lookahead(), 2);
    ASSERT_EQ((*network)->parameters().size(), original.parameters().size());
    for (std::size_t i = 0; i < original.parameters().size(); ++i) {
        EXPECT_NEAR((*network)->parameters()[i],
                    original.parameters()[i],
                    1e-5F * std::abs(original.parameters()[i]));
    }
}

TEST_F(NetworkFile, gives_back_what_hears_bars) {
    saved_text();
    const auto network = load_network(path_);
    ASSERT_TRUE(network) << network.error().message;
    const auto original = small().bars();
    ASSERT_TRUE((*network)->bars());
    EXPECT_EQ((*network)->bars()->shape(), original->shape());
    for (std::size_t i = 0; i < original->parameters().size(); ++i) {
        EXPECT_NEAR((*network)->bars()->parameters()[i],
                    original->parameters()[i],
                    1e-5F * std::abs(original->parameters()[i]));
    }
}

TEST_F(NetworkFile, of_version_1_hears_no_bars) {
    std::string text = saved_text();
    text = text.substr(0, text.find(",\n\"bars\"")) + "}\n";
    EXPECT_EQ(error_of(replaced(text, "\"version\": 2", "\"version\": 1")), "");
    EXPECT_FALSE((*load_network(path_))->bars());
}

TEST_F(NetworkFile, says_in_one_line_what_is_wrong) {
    const std::string good = saved_text();
    const struct {
        std::string text;
        std::string expected;
    } cases[] = {
        {replaced(good, "raks-beat-network", "raks-figure"), "format"},
        {replaced(good, "\"version\": 2", "\"version\": 3"), "version"},
        {replaced(good, "\"units\": 4", "\"units\": 8"), "parameters"},
        {replaced(good, "\"units\": 4", "\"units\": 100000"), "units"},
        {replaced(good, "\"layers\": 1", "\"layers\": 0"), "layers"},
        {replaced(good, "\"parameters\": [\n", "\"parameters\": [1e30,"), "parameters"},
        {replaced(good, "\"parameters\": [\n", "\"parameters\": [null,"), "parameters"},
        {replaced(good, "\"lookahead\": 2,", ""), "lookahead"},
        {replaced(good, "\"units\": 2", "\"units\": 3"), "bars.parameters has"},
        {replaced(good, "\"bars\": {\n\"units\": 2,", "\"bars\": {\n"), "bars.units"},
        {"", "JSON"},
        {"[1, 2]", ""},
    };
    for (const auto& c : cases) {
        const std::string error = error_of(c.text);
        EXPECT_NE(error.find(path_.string()), std::string::npos) << error;
        EXPECT_NE(error.find(c.expected), std::string::npos) << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
}

TEST_F(NetworkFile, survives_every_cut_and_flipped_bytes) {
    const std::string good = saved_text();
    for (std::size_t length = 0; length + 3 < good.size(); length += 37) {
        EXPECT_NE(error_of(good.substr(0, length)), "") << length;
    }
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        EXPECT_EQ(error_of(raks::test::mangled(good, {.seed = seed})).find('\n'),
                  std::string::npos);
    }
}

TEST_F(NetworkFile, is_not_written_when_training_went_astray) {
    BeatNetwork network = small();
    network.parameters()[3] = std::nanf("");
    EXPECT_FALSE(save_network(network, {"command", "people"}, path_));
    EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(NetworkFile, a_missing_file_is_named) {
    const auto network = load_network(path_);
    ASSERT_FALSE(network);
    EXPECT_NE(network.error().message.find(path_.string()), std::string::npos);
}

TEST(NetworkAverage, is_the_mean_of_every_weight) {
    std::vector<std::shared_ptr<const BeatNetwork>> networks;
    for (const float value : {1.0F, 2.0F, 6.0F}) {
        auto network = std::make_shared<BeatNetwork>(4, 1, 2);
        std::fill(network->parameters().begin(), network->parameters().end(), value);
        network->parameters()[7] = -value;
        networks.push_back(network);
    }
    const auto mean = average(networks);
    ASSERT_TRUE(mean) << mean.error().message;
    EXPECT_EQ(mean->lookahead(), 2);
    for (std::size_t i = 0; i < mean->parameters().size(); ++i) {
        EXPECT_FLOAT_EQ(mean->parameters()[i], i == 7 ? -3.0F : 3.0F) << i;
    }
}

TEST(NetworkAverage, refuses_none_and_other_shapes) {
    EXPECT_FALSE(average({}));
    const std::vector<std::shared_ptr<const BeatNetwork>> networks{
        std::make_shared<BeatNetwork>(4, 1, 2), std::make_shared<BeatNetwork>(8, 1, 2)};
    const auto mean = average(networks);
    ASSERT_FALSE(mean);
    EXPECT_EQ(mean.error().message, "2: has another shape than the first");
}

}  // namespace
}  // namespace raks::audio
