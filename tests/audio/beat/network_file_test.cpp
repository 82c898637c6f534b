// The network's file: what was saved is read back, and nothing else is believed.
#include "audio/beat/network/network_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "audio/beat/network/bar_network.hpp"
#include "base/file.hpp"
#include "base/pending_file.hpp"
#include "base/random.hpp"
#include "tests/support/mangled.hpp"
#include "tests/support/temporary_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace raks::audio {
namespace {

class NetworkFile : public ::testing::Test {
 protected:
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
    /// Beside it one of another shape.
    static BeatNetwork two() {
        BeatNetwork network = small();
        auto other = std::make_shared<BeatNetwork>(3, 2, 2);
        const CounterRandom random(6);
        for (std::size_t i = 0; i < other->parameters().size(); ++i) {
            other->parameters()[i] = static_cast<float>(random.normal(i));
        }
        network.set_others({std::move(other)});
        return network;
    }
    std::string saved_text() {
        EXPECT_TRUE(save_network(two(), {"a \"command\"", "people"}, path_));
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
    raks::test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "beats.json";
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

TEST_F(NetworkFile, gives_back_those_that_are_heard_beside) {
    saved_text();
    const auto network = load_network(path_);
    ASSERT_TRUE(network) << network.error().message;
    const BeatNetwork original = two();
    const BeatNetwork& other = *original.others()[0];
    ASSERT_EQ((*network)->others().size(), 1U);
    const auto& read = *(*network)->others()[0];
    EXPECT_EQ(read.shape(), other.shape());
    EXPECT_EQ(read.lookahead(), 2);
    for (std::size_t i = 0; i < other.parameters().size(); ++i) {
        EXPECT_NEAR(
            read.parameters()[i], other.parameters()[i], 1e-5F * std::abs(other.parameters()[i]));
    }
}

TEST_F(NetworkFile, gives_back_how_sure_beats_are) {
    BeatNetwork network = small();
    ConfidenceModel model;
    model.weights[3] = -12.5F;
    network.set_confidence(model);
    ASSERT_TRUE(save_network(network, {"command", "people"}, path_));
    const auto read = load_network(path_);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ((*read)->confidence().weights, model.weights);
    const std::string text = *read_file(path_);
    const std::size_t list = text.find(",\n\"confidence\"");
    EXPECT_EQ(error_of(text.substr(0, list) + "}\n"), "");
    EXPECT_EQ((*load_network(path_))->confidence().weights, ConfidenceModel().weights)
        << "a file without any has the usual ones";
}

TEST_F(NetworkFile, of_an_older_version_hears_no_thirds_and_without_bars_and_others_none) {
    // A network of versions 1 to 3: three outputs, whose biases say what it hears.
    const models::RecurrentNetwork old({NetworkInput::kSize, 1, 1, 3});
    std::vector<std::string> numbers(old.parameters().size(), "0");
    std::copy_n(std::array{"1", "2", "3"}.begin(), 3, numbers.end() - 3);
    for (const int version : {1, 2, 3}) {
        const std::string text = fmt::format(
            R"({{"format": "raks-beat-network", "version": {}, "units": 1, "layers": 1,
                "lookahead": 2, "parameters": [{}]}})",
            version,
            fmt::join(numbers, ","));
        ASSERT_EQ(error_of(text), "") << version;
        const auto network = *load_network(path_);
        EXPECT_FALSE(network->bars());
        EXPECT_TRUE(network->others().empty());
        const BeatEvidence heard = BeatNetworkStream(network).next({});
        EXPECT_NEAR(heard.beat, 0.7311F, 1e-3F);
        EXPECT_NEAR(heard.downbeat, 0.8808F, 1e-3F);
        EXPECT_NEAR(heard.half, 0.9526F, 1e-3F);
        EXPECT_LT(heard.third, 1e-4F);
    }
}

TEST_F(NetworkFile, says_in_one_line_what_is_wrong) {
    const std::string good = saved_text();
    const struct {
        std::string text;
        std::string expected;
    } cases[] = {
        {replaced(good, "raks-beat-network", "raks-figure"), "format"},
        {replaced(good, "\"version\": 4", "\"version\": 5"), "version"},
        {replaced(good, "\"units\": 4", "\"units\": 8"), "parameters"},
        {replaced(good, "\"units\": 4", "\"units\": 100000"), "units"},
        {replaced(good, "\"layers\": 1", "\"layers\": 0"), "layers"},
        {replaced(good, "\"parameters\": [\n", "\"parameters\": [1e30,"), "parameters"},
        {replaced(good, "\"parameters\": [\n", "\"parameters\": [null,"), "parameters"},
        {replaced(good, "\"lookahead\": 2,", ""), "lookahead"},
        {replaced(good, "\"units\": 2", "\"units\": 3"), "bars.parameters has"},
        {replaced(good, "\"bars\": {\n\"units\": 2,", "\"bars\": {\n"), "bars.units"},
        {replaced(good, "\"units\": 3", "\"units\": 4"), "others[0].parameters has"},
        {replaced(good, "\"others\": [", "\"others\": [1,2,3,4,5,6,7,"), "others are 8"},
        {replaced(good, "\"version\": 4", "\"version\": 3"), "parameters has"},
        {replaced(good, "\"confidence\": [", "\"confidence\": [1,"), "confidence has 16 numbers"},
        {replaced(good, "\"confidence\": [", "\"confidence\": [1e9],\"x\": ["), "confidence has 1"},
        {replaced(good, "\"confidence\": [-0.3,", "\"confidence\": [-1e9,"), "confidence[0]"},
        {replaced(good, "\"confidence\": [-0.3,", "\"confidence\": [null,"), "confidence[0]"},
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
    BeatNetwork beside = small();
    beside.set_others({std::make_shared<BeatNetwork>(network)});
    EXPECT_FALSE(save_network(beside, {"command", "people"}, path_));
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

/// A network whose outputs say these numbers, whatever it hears.
std::shared_ptr<BeatNetwork> saying(std::array<float, BeatNetwork::kOutputs> logits,
                                    int lookahead = 2) {
    auto network = std::make_shared<BeatNetwork>(4, 1, lookahead);
    const auto biases = network->parameters().subspan(network->output_biases());
    std::copy(logits.begin(), logits.end(), biases.begin());
    return network;
}

TEST(NetworksTogether, say_the_mean_of_what_each_says_times_the_trust) {
    const std::vector<std::shared_ptr<const BeatNetwork>> networks{
        saying({1.0F, -2.0F, 0.0F}), saying({3.0F, -4.0F, 1.0F}), saying({5.0F, 0.0F, -4.0F})};
    const auto both = together(networks, 0.5F);
    ASSERT_TRUE(both) << both.error().message;
    const auto alone = saying({1.5F, -1.0F, -0.5F});
    BeatNetworkStream listener(std::make_shared<const BeatNetwork>(*both));
    BeatNetworkStream expected(alone);
    const BeatEvidence heard = listener.next({});
    const BeatEvidence mean = expected.next({});
    EXPECT_FLOAT_EQ(heard.beat, mean.beat);
    EXPECT_FLOAT_EQ(heard.downbeat, mean.downbeat);
    EXPECT_FLOAT_EQ(heard.half, mean.half);
}

TEST(NetworksTogether, of_one_kind_are_that_one) {
    const CounterRandom random(5);
    auto network = std::make_shared<BeatNetwork>(4, 2, 2);
    for (std::size_t i = 0; i < network->parameters().size(); ++i) {
        network->parameters()[i] = static_cast<float>(random.normal(i));
    }
    const std::vector<std::shared_ptr<const BeatNetwork>> twice{network, network};
    BeatNetworkStream listener(std::make_shared<const BeatNetwork>(together(twice, 1.0F).value()));
    BeatNetworkStream alone(network);
    for (int round = 0; round < 2; ++round) {
        for (std::uint64_t hop = 0; hop < 50; ++hop) {
            NetworkInput::Frame frame{};
            frame.fill(static_cast<float>(random.normal(1'000 + hop)));
            EXPECT_EQ(listener.next(frame).beat, alone.next(frame).beat) << hop;
        }
        listener.reset();
        alone.reset();
    }
}

TEST(NetworksTogether, refuses_none_too_many_and_other_lookaheads) {
    EXPECT_FALSE(together({}, 1.0F));
    const std::vector<std::shared_ptr<const BeatNetwork>> apart{saying({}, 2), saying({}, 4)};
    EXPECT_EQ(together(apart, 1.0F).error().message, "2: has another look-ahead than the first");
    std::vector<std::shared_ptr<const BeatNetwork>> many(kMostTogether, saying({}));
    const auto most = std::make_shared<const BeatNetwork>(together(many, 1.0F).value());
    EXPECT_EQ(most->others().size(), kMostTogether - 1);
    EXPECT_EQ(together(std::vector{most, many[0]}, 1.0F).error().message, "9: at most 8 together");
    EXPECT_EQ(average(std::vector{many[0], most}).error().message, "2: holds several networks");
}

}  // namespace
}  // namespace raks::audio
