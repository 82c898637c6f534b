#include "engine/remote/remote_guard.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace raks::engine {
namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";

class Guard : public ::testing::Test {
 protected:
    [[nodiscard]] bool lets(const RemoteCaller& caller) const {
        return guard_.refusal(caller).empty();
    }
    RemoteGuard guard_{kToken, "0.0.0.0", 7880};
};

TEST_F(Guard, this_machine_may_without_a_token) {
    for (const char* address : {"127.0.0.1", "::1", "::ffff:127.0.0.1"}) {
        for (const char* host : {"localhost:7880", "127.0.0.1:7880", "[::1]:7880"}) {
            EXPECT_TRUE(lets({address, host, {}, ""})) << address << " " << host;
        }
    }
}

TEST_F(Guard, another_machine_needs_the_token) {
    EXPECT_FALSE(lets({"192.168.1.20", "192.168.1.5:7880", {}, ""}));
    EXPECT_FALSE(lets({"192.168.1.20", "localhost:7880", {}, ""}));
    EXPECT_TRUE(lets({"192.168.1.20", "192.168.1.5:7880", {}, kToken}));
    EXPECT_TRUE(lets({"192.168.1.20", "192.168.1.5:7880", "http://192.168.1.5:7880", kToken}));
}

TEST_F(Guard, a_name_that_was_resolved_to_here_needs_the_token) {
    for (const char* host : {"evil.example:7880",
                             "evil.example",
                             "localhost",
                             "localhost:80",
                             "localhost:7880.evil.example",
                             "127.0.0.1:78801",
                             ""}) {
        EXPECT_FALSE(lets({"127.0.0.1", host, {}, ""})) << host;
        EXPECT_TRUE(lets({"127.0.0.1", host, {}, kToken})) << host;
    }
}

TEST_F(Guard, pages_of_others_need_the_token) {
    EXPECT_TRUE(lets({"127.0.0.1", "localhost:7880", "http://localhost:7880", ""}));
    for (const char* origin : {"http://evil.example",
                               "null",
                               "",
                               "http://localhost:7881",
                               "https://localhost:7880",
                               "http://127.0.0.1:7880",
                               "file://"}) {
        EXPECT_FALSE(lets({"127.0.0.1", "localhost:7880", origin, ""})) << origin;
        EXPECT_TRUE(lets({"127.0.0.1", "localhost:7880", origin, kToken})) << origin;
    }
}

TEST_F(Guard, a_token_that_is_not_the_whole_token_is_none) {
    std::string last_digit = kToken;
    last_digit.back() = '0';
    for (const std::string& token :
         {kToken.substr(1), kToken + "0", last_digit, std::string(32, '0'), std::string()}) {
        EXPECT_FALSE(lets({"192.168.1.20", "x", {}, token})) << token;
    }
    EXPECT_FALSE(RemoteGuard("", "0.0.0.0", 1).refusal({"192.168.1.20", "x", {}, ""}).empty());
}

TEST(RemoteToken, is_32_hexadecimal_digits_and_new_each_time) {
    std::set<std::string> tokens;
    for (int i = 0; i < 50; ++i) {
        const auto token = new_remote_token();
        ASSERT_TRUE(token) << token.error().message;
        EXPECT_EQ(token->size(), 32U);
        EXPECT_EQ(token->find_first_not_of("0123456789abcdef"), std::string::npos);
        EXPECT_TRUE(tokens.insert(*token).second);
    }
}

TEST(RemoteToken, that_is_kept_stays_and_is_read_by_nobody_else) {
    const std::filesystem::path folder =
        std::filesystem::path(::testing::TempDir()) / "raks_kept_token" / "raks";
    std::filesystem::remove_all(folder);
    const auto first = kept_remote_token(folder);
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(kept_remote_token(folder).value(), *first);
    const std::string file = (folder / "remote-token").string();
    struct stat state {};
    ASSERT_EQ(stat(file.c_str(), &state), 0);
    EXPECT_EQ(state.st_mode & 0777U, 0600U);
    chmod(file.c_str(), 0644);
    EXPECT_EQ(kept_remote_token(folder).error().message,
              file + ": others may read it; remove it, and a new token is made");
    chmod(file.c_str(), 0600);
    std::ofstream(file) << "secret\n";
    EXPECT_EQ(kept_remote_token(folder).error().message,
              file + ": no token is in it; remove it, and a new one is made");
    std::filesystem::remove(file);
    std::filesystem::create_symlink("/dev/null", file);
    EXPECT_FALSE(kept_remote_token(folder));
    EXPECT_FALSE(kept_remote_token({}));
}

}  // namespace
}  // namespace raks::engine
