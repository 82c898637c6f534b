// Says of each test that fails whether the machine stood still while it ran: scripts/test.sh runs
// those again, alone. Linked into the programs whose tests run in real time.
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>

#include "tests/support/stall_watch.hpp"

namespace raks::test {
namespace {

class StallReport final : public ::testing::EmptyTestEventListener {
    void OnTestStart(const ::testing::TestInfo& /*test*/) override { watch_.emplace(); }
    void OnTestEnd(const ::testing::TestInfo& test) override {
        if (test.result()->Failed() && watch_->is_machine_slow()) {
            // The words are those that scripts/test.sh looks for.
            std::printf(
                "the machine stood still for %lld ms during this test\n",
                static_cast<long long>(
                    std::chrono::duration_cast<std::chrono::milliseconds>(watch_->lost()).count()));
        }
        watch_.reset();
    }

    std::optional<StallWatch> watch_;
};

// Before main; GoogleTest owns it.
const bool kIsListening = [] {
    ::testing::UnitTest::GetInstance()->listeners().Append(new StallReport);
    return true;
}();

}  // namespace
}  // namespace raks::test
