#include "audio/beat/network/beatnet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "audio/beat/network/beatnet_hops.hpp"
#include "audio/features/rhythm_frames.hpp"
#include "base/file.hpp"
#include "base/hash.hpp"
#include "tests/audio/listen.hpp"
#include "tests/support/realtime_guard.hpp"

namespace raks::audio {
namespace {

constexpr const char* kShippedBeatNet = RAKS_SOURCE_DIR "/models/pretrained/beatnet.weights";

std::shared_ptr<const BeatNet> shipped_beatnet() {
    static const auto network = load_beatnet(kShippedBeatNet);
    EXPECT_TRUE(network) << network.error().message;
    return *network;
}

/// As tests/data/beatnet/expected.py makes them: whole numbers, so that both have the same.
std::array<float, BeatNet::kBands> bands_of_frame(int t) {
    const int since = t % 25;
    const int hit = since < 12 ? std::max(0, 40 - 12 * since) : std::max(0, 24 - 12 * (since - 12));
    std::array<float, BeatNet::kBands> bands{};
    for (int b = 0; b < static_cast<int>(BeatNet::kBands); ++b) {
        const int value = (t * 7 + b * 13) % 29 + hit * (1 + (b + t / 25) % 3);
        bands[static_cast<std::size_t>(b)] = static_cast<float>(value) / 64.0F;
    }
    return bands;
}

TEST(BeatNet, says_what_the_reference_says) {
    BeatNetStream stream(shipped_beatnet());
    std::ifstream file(RAKS_SOURCE_DIR "/tests/data/beatnet/expected.tsv");
    double beat = 0.0;
    double downbeat = 0.0;
    int frames = 0;
    for (; file >> beat >> downbeat; ++frames) {
        const BeatNetEvidence evidence = stream.next_from_bands(bands_of_frame(frames));
        EXPECT_NEAR(static_cast<double>(evidence.beat), beat, 2e-4) << frames;
        EXPECT_NEAR(static_cast<double>(evidence.downbeat), downbeat, 2e-4) << frames;
    }
    EXPECT_EQ(frames, 200);
}

TEST(BeatNet, a_reset_forgets_the_stream) {
    BeatNetStream stream(shipped_beatnet());
    const auto first = [&] {
        std::vector<float> said(30);
        for (int t = 0; t < 30; ++t) {
            said[static_cast<std::size_t>(t)] = stream.next_from_bands(bands_of_frame(t)).beat;
        }
        return said;
    };
    const auto before = first();
    stream.reset();
    EXPECT_EQ(first(), before);
}

// Clicks at 120 BPM: what is told of a hop is told kLag hops later, and is greatest at the click.
TEST(BeatNet, evidence_of_clicks_lies_at_the_clicks) {
    const GeneratedMusic clicks = test::music(Style::clicks, {{0.0, 120.0}}, 20.0, 32'000);
    BeatNetHops hops(shipped_beatnet());
    RhythmFrames frames;
    ASSERT_TRUE(frames.prepare(clicks.rate));
    std::vector<float> beats;
    frames.process(clicks.mono(), [&](std::span<const float> window) {
        raks::test::RealtimeScope scope;
        const BeatNetEvidence evidence = hops.next(window.first<OnsetDetector::kWindow>());
        EXPECT_TRUE(scope.stop().is_clean()) << scope.stop().describe();
        beats.push_back(evidence.beat);
    });
    int found = 0;
    for (const ReferenceBeat& beat : clicks.beats) {
        const double seconds = to_seconds(beat.time);
        const auto hop = static_cast<std::size_t>(std::lround(100.0 * seconds)) + BeatNetHops::kLag;
        if (seconds < 10.0 || hop + 20 >= beats.size()) {
            continue;
        }
        const float at = std::max({beats[hop - 1], beats[hop], beats[hop + 1]});
        EXPECT_GT(at, 2.0F * beats[hop + 12]) << seconds;
        EXPECT_GT(at, 2.0F * beats[hop - 12]) << seconds;
        ++found;
    }
    EXPECT_GE(found, 15);
}

std::string beatnet_error(std::string bytes) {
    // With the hash of what it holds now, so that the fault inside is found and not the hash.
    if (bytes.size() > sizeof(std::uint64_t)) {
        bytes.resize(bytes.size() - sizeof(std::uint64_t));
        const std::uint64_t hash = hash_of(bytes);
        bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
    }
    const auto network = parse_beatnet(bytes);
    return network ? "" : network.error().message;
}

TEST(BeatNetFile, faults_are_said_in_one_line) {
    const std::string good = read_file(kShippedBeatNet).value();
    EXPECT_LE(good.size(), 900'000U);
    EXPECT_EQ(beatnet_error(good), "");
    EXPECT_EQ(beatnet_error("what"), "is not BeatNet's weights; install Raks again");
    std::string other = good;
    other.replace(good.find("lstm1.input"), 5, "gru_1");
    EXPECT_EQ(beatnet_error(other),
              "has an array 'gru_1.input' where lstm1.input must be; install Raks again");
    // The filters' counts: more weights than there are.
    std::string wide = good;
    const std::size_t counts = good.find("bank.count") + std::string("bank.count").size() + 6;
    const float many = 63.0F;
    for (std::size_t i = 0; i < 40; ++i) {
        wide.replace(counts + 4 * i, 4, reinterpret_cast<const char*>(&many), 4);
    }
    EXPECT_EQ(beatnet_error(wide), "bank.count[19] is 63: too many; install Raks again");
    for (std::size_t size = 0; size < good.size(); size += size < 600 ? 1 : 17'713) {
        const std::string error = beatnet_error(good.substr(0, size));
        EXPECT_NE(error.find("install Raks again"), std::string::npos) << size << ": " << error;
        EXPECT_EQ(error.find('\n'), std::string::npos) << size;
    }
    EXPECT_EQ(load_beatnet("none.weights").error().message.substr(0, 12), "none.weights");
}

}  // namespace
}  // namespace raks::audio
