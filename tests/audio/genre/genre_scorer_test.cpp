#include "audio/genre/genre_scorer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace raks::audio {
namespace {

constexpr std::size_t kClasses = 4;
using Mel = std::array<float, BarPatterns::kMelBands>;

std::vector<models::RecurrentNetwork> random_networks(std::size_t count) {
    const CounterRandom random(5);
    std::vector<models::RecurrentNetwork> networks;
    std::uint64_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        networks.emplace_back(models::RecurrentNetwork::Shape{NetworkInput::kSize, 8, 2, kClasses});
        for (float& parameter : networks.back().parameters()) {
            parameter = static_cast<float>(0.4 * random.normal(next++));
        }
    }
    return networks;
}

std::vector<Mel> random_music(std::size_t hops) {
    const CounterRandom random(6);
    std::vector<Mel> music(hops);
    for (std::size_t i = 0; i < hops * music[0].size(); ++i) {
        music[i / music[0].size()][i % music[0].size()] =
            static_cast<float>(5.0 * random.uniform(i));
    }
    return music;
}

std::array<float, kClasses> chances(const GenreScorer& listener, int blocks) {
    std::array<float, kClasses> out{};
    listener.log_chances(blocks, out);
    return out;
}

TEST(GenreScorer, a_window_is_the_mean_of_its_hops_and_networks) {
    const std::vector<models::RecurrentNetwork> networks = random_networks(3);
    const std::vector<Mel> music = random_music(2'345);  // longer than the ring
    GenreScorer listener;
    NetworkInput input;
    std::array<models::RecurrentStream, 3> streams;
    std::vector<std::array<double, kClasses>> hops;
    for (const Mel& mel : music) {
        listener.next(networks, mel);
        const NetworkInput::Frame frame = input.next(mel);
        auto& hop = hops.emplace_back();
        for (std::size_t i = 0; i < networks.size(); ++i) {
            auto logits = streams.at(i).next(networks[i], frame);
            const std::span<float> logs = std::span(logits).first(kClasses);
            normalize_logs(logs);
            for (std::size_t c = 0; c < kClasses; ++c) {
                hop[c] += static_cast<double>(std::max(logs[c], GenreScorer::kLeastLog)) / 3.0;
            }
        }
    }
    ASSERT_EQ(listener.blocks(), GenreScorer::kBlocks);
    const std::size_t end = hops.size() / 10 * 10;  // whole blocks
    for (const int blocks : {1, 5, 50, GenreScorer::kBlocks}) {
        const auto heard = chances(listener, blocks);
        const auto count = static_cast<std::size_t>(10 * blocks);
        for (std::size_t c = 0; c < kClasses; ++c) {
            double sum = 0.0;
            for (std::size_t hop = end - count; hop < end; ++hop) {
                sum += hops[hop][c];
            }
            EXPECT_NEAR(static_cast<double>(heard[c]), sum / static_cast<double>(count), 1e-4);
        }
    }
}

TEST(GenreScorer, reset_forgets) {
    const std::vector<models::RecurrentNetwork> networks = random_networks(2);
    const std::vector<Mel> music = random_music(100);
    GenreScorer once;
    GenreScorer twice;
    for (const Mel& mel : random_music(300)) {
        twice.next(networks, mel);
    }
    twice.reset();
    EXPECT_EQ(twice.blocks(), 0);
    for (const Mel& mel : music) {
        once.next(networks, mel);
        twice.next(networks, mel);
    }
    EXPECT_EQ(chances(once, 10), chances(twice, 10));
}

}  // namespace
}  // namespace raks::audio
