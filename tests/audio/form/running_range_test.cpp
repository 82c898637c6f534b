#include "audio/form/running_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "base/random.hpp"
#include "base/statistics.hpp"

namespace raks::audio {
namespace {

TEST(RunningRange, has_the_order_statistics_of_the_last_values) {
    const CounterRandom random(7);
    RunningRange<25> range;
    std::vector<double> all;
    for (std::uint64_t i = 0; i < 200; ++i) {
        // Few different values: equal ones must be told apart when they leave.
        const auto value = static_cast<double>(random.below(i, 12));
        range.add(static_cast<float>(value));
        all.push_back(value);
        const std::size_t first = all.size() - std::min<std::size_t>(all.size(), 25);
        const std::vector<double> last(all.begin() + static_cast<std::ptrdiff_t>(first), all.end());
        ASSERT_EQ(range.size(), last.size());
        for (const double share : {0.0, 0.05, 0.5, 0.95, 1.0}) {
            ASSERT_NEAR(static_cast<double>(range.at(share)), percentile(last, share), 1e-5);
        }
    }
    range.reset();
    EXPECT_EQ(range.size(), 0U);
}

}  // namespace
}  // namespace raks::audio
