#include "apps/reports/svg_path.hpp"

#include <gtest/gtest.h>

namespace raks::apps {
namespace {

TEST(SvgPath, is_lines_that_begin_closed_and_lifted) {
    SvgPath path;
    path.close();
    EXPECT_EQ(path.data(), "");
    path.to(1, 2);
    path.to(3.25, -0.5);
    path.close();
    path.to(4, 5);
    path.lift();
    path.lift();
    path.to(6, 7);
    EXPECT_EQ(path.data(), "M1.0 2.0L3.2 -0.5ZM4.0 5.0M6.0 7.0");
}

}  // namespace
}  // namespace raks::apps
