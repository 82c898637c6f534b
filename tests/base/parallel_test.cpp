#include "base/parallel.hpp"

#include <gtest/gtest.h>

namespace raks {
namespace {

TEST(RunParallel, does_every_piece_once_whatever_the_threads) {
    for (const int threads : {-1, 1, 2, 5, 1000}) {
        for (const std::size_t count : {0U, 1U, 3U, 100U}) {
            std::vector<int> done(count, 0);
            run_parallel(count, threads, [&](std::size_t i) { done[i] += 1; });
            EXPECT_EQ(done, std::vector<int>(count, 1)) << threads << " threads";
        }
    }
}

}  // namespace
}  // namespace raks
