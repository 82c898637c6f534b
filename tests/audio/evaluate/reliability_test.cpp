#include "audio/evaluate/reliability.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace raks::audio {
namespace {

TEST(Reliability, claims_are_sorted_by_confidence) {
    const std::vector<Claim> claims = {{0.0F, false}, {0.05F, true}, {0.95F, true}, {1.0F, false}};
    const ReliabilityCurve curve = reliability_of(claims);
    ASSERT_EQ(curve.size(), kReliabilityBins);
    EXPECT_EQ(curve[0].claims, 2U);
    EXPECT_EQ(curve[0].right, 1U);
    EXPECT_EQ(curve[9].claims, 2U);
    EXPECT_EQ(curve[9].right, 1U);
    EXPECT_EQ(curve[5].claims, 0U);
}

TEST(Reliability, a_bin_begins_at_its_tenth_and_one_is_in_the_last) {
    EXPECT_EQ(reliability_bin(0.0F), 0U);
    EXPECT_EQ(reliability_bin(0.0999F), 0U);
    EXPECT_EQ(reliability_bin(0.1F), 1U);
    EXPECT_EQ(reliability_bin(0.7F), 7U);
    EXPECT_EQ(reliability_bin(0.8999F), 8U);
    EXPECT_EQ(reliability_bin(0.9F), 9U);
    EXPECT_EQ(reliability_bin(1.0F), 9U);
}

}  // namespace
}  // namespace raks::audio
