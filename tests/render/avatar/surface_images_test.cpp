#include "render/avatar/surface_images.hpp"

#include <gtest/gtest.h>

namespace raks::render {
namespace {

const Image kRed{1, 1, {255, 0, 0, 255}};

TEST(SurfaceImages, that_are_let_go_are_freed_and_unpacked_again_when_they_are_wanted) {
    int unpacked = 0;
    SurfaceImages images({kRed}, [&unpacked] {
        ++unpacked;
        return std::vector<Image>{kRed};
    });
    const std::weak_ptr<const std::vector<Image>> first = images.get();
    EXPECT_FALSE(first.expired());
    images.let_go();
    EXPECT_TRUE(first.expired());
    EXPECT_EQ(unpacked, 0);
    EXPECT_EQ(images.get()->at(0).pixels, kRed.pixels);
    EXPECT_EQ(images.get()->size(), 1U);
    EXPECT_EQ(unpacked, 1);
}

TEST(SurfaceImages, that_somebody_holds_are_not_unpacked_again) {
    int unpacked = 0;
    SurfaceImages images({kRed}, [&unpacked] {
        ++unpacked;
        return std::vector<Image>{kRed};
    });
    const SurfaceImages::Images held = images.get();
    images.let_go();
    EXPECT_EQ(images.get(), held);
    EXPECT_EQ(unpacked, 0);
}

TEST(SurfaceImages, that_cannot_be_had_again_stay) {
    SurfaceImages images({kRed});
    images.let_go();
    EXPECT_EQ(images.get()->at(0).pixels, kRed.pixels);
}

}  // namespace
}  // namespace raks::render
