// Long runs; label soak: `ctest -L soak`.
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>

#include "tests/end_to_end/program.hpp"

namespace raks::test {
namespace {

class Soak : public ProgramTest {};

/// A 16-bit mono WAV at 8 kHz of ten hours of silence: a sparse file.
void write_ten_hours(const std::filesystem::path& path) {
    constexpr std::uint32_t kBytes = 36'000U * 8'000U * 2U;
    std::string head(
        "RIFF\0\0\0\0WAVEfmt "
        "\x10\0\0\0\x01\0\x01\0\x40\x1f\0\0\x80\x3e\0\0\x02\0\x10\0data\0\0\0\0",
        44);
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) {
            head[at + i] = static_cast<char>((value >> (8 * i)) & 0xFFU);
        }
    };
    put(4, kBytes + 36);
    put(40, kBytes);
    std::ofstream(path, std::ios::binary).write(head.data(), 44);
    std::filesystem::resize_file(path, kBytes + 44ULL);
}

TEST_F(Soak, ten_hours_are_analyzed_in_bounded_memory) {
    write_ten_hours(folder_ / "long.wav");
    ProcessPlan plan = this->plan({"analyze", path("long.wav")});
    plan.address_space_limit = 600L << 20U;
    plan.timeout = std::chrono::seconds(1500);
    const ProcessResult result = run_process(plan);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("36000.0 s"), std::string::npos) << result.out;
}

}  // namespace
}  // namespace raks::test
