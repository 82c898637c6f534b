// What `cmake --install` puts somewhere works there by itself.
#include <gtest/gtest.h>

#include <string>

#include "tests/end_to_end/program.hpp"
#include "tests/support/program.hpp"

#include <nlohmann/json.hpp>

namespace raks::test {
namespace {

class Install : public ProgramTest {};

TEST_F(Install, both_programs_and_what_they_read_are_put_in_place) {
    const std::string root = path("root");
    run_program({"cmake", "--install", RAKS_BINARY_DIR, "--prefix", root});
    ProcessPlan installed = plan({"dances", "--json"});
    installed.command.front() = root + "/bin/raks";
    const ProcessResult dances = run_process(installed);
    ASSERT_EQ(dances.exit_code, 0) << dances.err;
    const auto document = nlohmann::json::parse(dances.out);
    ASSERT_GE(document["dances"].size(), 6U);
    for (const auto& dance : document["dances"]) {
        EXPECT_EQ(dance["folder"], root + "/share/raks/models/trained");
        EXPECT_EQ(dance["fault"], "");
    }
    installed.command = {root + "/bin/raks", "train", "genre", "--help"};
    const ProcessResult help = run_process(installed);
    EXPECT_EQ(help.exit_code, 0) << help.err;
    EXPECT_NE(help.out.find("raks train genre"), std::string::npos) << help.out;
}

}  // namespace
}  // namespace raks::test
