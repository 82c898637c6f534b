#include "base/statistics.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace raks {
namespace {

using Values = std::vector<double>;

TEST(Percentile, interpolates_between_neighbours) {
    EXPECT_EQ(percentile({}, 0.5), 0.0);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
    EXPECT_EQ(percentile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
}

TEST(LowerPercentile, is_one_of_the_values) {
    EXPECT_EQ(lower_percentile({}, 0.5), 0.0);
    EXPECT_EQ(lower_percentile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
    EXPECT_EQ(lower_percentile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.0);
    EXPECT_EQ(lower_percentile({4.0, 1.0, 3.0, 2.0}, 0.99), 3.0);
    EXPECT_EQ(lower_percentile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
}

TEST(Median, is_the_middle_or_the_mean_of_the_two) {
    EXPECT_EQ(median(Values{}), std::nullopt);
    EXPECT_EQ(median(Values{3.0}), 3.0);
    EXPECT_EQ(median(Values{3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median(Values{4.0, 1.0, 2.0, 3.0}), 2.5);
}

TEST(UpperMedian, is_the_middle_or_the_upper_of_the_two) {
    EXPECT_EQ(upper_median(Values{3.0}), 3.0);
    EXPECT_EQ(upper_median(Values{3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(upper_median(Values{4.0, 1.0, 2.0, 3.0}), 3.0);
}

TEST(NthValue, counts_from_the_least) {
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(nth_value(std::vector<int>{3, 0, 4, 1, 2}, i), static_cast<int>(i));
    }
}

}  // namespace
}  // namespace raks
