#include "apps/xbody/file_arrival.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <future>
#include <string>
#include <thread>

namespace raks::apps {
namespace {

const std::filesystem::path kMotions =
    std::filesystem::path(RAKS_SOURCE_DIR) / "tests" / "data" / "bvh";
const std::string kDance = (kMotions / "dance" / "own_dance.bvh").string();
const std::string kOther = (kMotions / "odd" / "blank_lines.bvh").string();

MotionWearer figure(const std::string& missing = {}) {
    return {.plan = {}, .labels = {}, .missing = missing, .hips = {0.0F, 0.9F, 0.0F}};
}

DroppedFiles wait(FileArrival& arrival) {
    auto taken = arrival.take();
    while (!taken) {
        std::this_thread::yield();
        taken = arrival.take();
    }
    return std::move(*taken);
}

TEST(FileArrival, gives_what_was_asked_for_once) {
    FileArrival arrival([](DroppedFiles&) {});
    EXPECT_FALSE(arrival.is_awaited() || arrival.is_due());
    arrival.ask({dropped_file(kDance)}, figure());
    EXPECT_TRUE(arrival.is_awaited() && arrival.is_due());
    EXPECT_EQ(wait(arrival).motion, kDance);
    EXPECT_FALSE(arrival.is_awaited());
    EXPECT_FALSE(arrival.take());
}

TEST(FileArrival, is_read_beside_the_thread_that_asks_and_given_up_for_what_is_asked_later) {
    std::promise<void> may_go_on;
    FileArrival arrival(
        [wait_for = may_go_on.get_future().share()](DroppedFiles&) { wait_for.wait(); });
    arrival.ask({dropped_file(kOther)}, figure());
    EXPECT_FALSE(arrival.take()) << "it begins";
    EXPECT_FALSE(arrival.is_due());
    EXPECT_FALSE(arrival.take());
    arrival.ask({dropped_file(kDance)}, figure());
    EXPECT_TRUE(arrival.is_awaited());
    may_go_on.set_value();
    EXPECT_EQ(wait(arrival).motion, kDance);
}

TEST(FileArrival, is_read_anew_for_a_model_that_stands_otherwise) {
    FileArrival arrival([](DroppedFiles&) {});
    arrival.ask_again(figure());
    EXPECT_FALSE(arrival.is_awaited()) << "nothing was asked for";
    arrival.ask({dropped_file(kDance)}, figure("head"));
    EXPECT_FALSE(arrival.take()) << "it begins";
    arrival.ask_again(figure());
    EXPECT_TRUE(wait(arrival).clip);
}

}  // namespace
}  // namespace raks::apps
