#include "engine/remote/remote_server.hpp"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "base/descriptor.hpp"
#include "engine/remote/remote_guard.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

const std::string kServerToken = "0123456789abcdef0123456789abcdef";

/// A connection to the server, and what it says.
class Client {
 public:
    explicit Client(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        to.sin_port = htons(port);
        EXPECT_EQ(connect(socket_.number, reinterpret_cast<const sockaddr*>(&to), sizeof(to)), 0);
        const timeval patience{20, 0};
        setsockopt(socket_.number, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof(patience));
    }
    /// False: the other side has ended it.
    bool say(const std::string& text) const {
        return send(socket_.number, text.data(), text.size(), MSG_NOSIGNAL) ==
               static_cast<ssize_t>(text.size());
    }
    /// So many bytes, or fewer at the end of the connection.
    std::string read(std::size_t size) {
        while (heard_.size() < size && more()) {
        }
        std::string text = heard_.substr(0, size);
        heard_.erase(0, text.size());
        return text;
    }
    /// Up to and with `end`.
    std::string read_until(const std::string& end) {
        while (heard_.find(end) == std::string::npos && more()) {
        }
        const std::size_t at = heard_.find(end);
        return read(at == std::string::npos ? heard_.size() : at + end.size());
    }
    /// All up to the end of the connection.
    std::string read_all() {
        while (more()) {
        }
        return std::exchange(heard_, "");
    }

 private:
    bool more() {
        std::array<char, 4096> part{};
        const ssize_t size = recv(socket_.number, part.data(), part.size(), 0);
        heard_.append(part.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
        return size > 0;
    }
    Descriptor socket_;
    std::string heard_;
};

/// A frame as a page sends it: masked, of less than 64 KiB.
std::string frame(int opcode, const std::string& text, bool is_masked = true) {
    const char mask_bit = is_masked ? '\x80' : '\0';
    std::string bytes(1, static_cast<char>(0x80 | opcode));
    if (text.size() < 126) {
        bytes += static_cast<char>(static_cast<char>(text.size()) | mask_bit);
    } else {
        bytes += static_cast<char>('\x7e' | mask_bit);
        bytes += static_cast<char>(text.size() >> 8U);
        bytes += static_cast<char>(text.size() & 0xFFU);
    }
    // The mask is 0: what is masked stays as it is.
    return bytes + (is_masked ? std::string(4, '\0') : "") + text;
}

class Server : public ::testing::Test {
 protected:
    void SetUp() override {
        actions_.on_dated(Action::tap_tempo, [this](double, HostTime) { ++taps_; });
        actions_.on(Action::nudge_beats, [this](double ms) { nudged_ = ms; });
        actions_.on_text(Action::choose_dance, [](const std::string& name) -> Expected<void> {
            return name == "salsa" ? Expected<void>() : fail("there is no " + name);
        });
        if (!RemoteServer::is_built()) {
            GTEST_SKIP() << "built without RAKS_REMOTE";
        }
        auto server = RemoteServer::open({"127.0.0.1", 0}, kServerToken, inbox_);
        ASSERT_TRUE(server) << server.error().message;
        server_ = std::move(*server);
        server_->publish(RemoteChoices{.dances = {"salsa"}});
        server_->publish(RemoteState{.bpm = 96.0});
        // In the place of the program's main thread.
        main_ = std::thread([this] {
            while (!is_over_) {
                static_cast<void>(inbox_.carry_out(actions_));
                std::this_thread::yield();
            }
        });
    }
    void TearDown() override {
        server_.reset();
        is_over_ = true;
        if (main_.joinable()) {
            main_.join();
        }
    }
    [[nodiscard]] std::uint16_t port() const { return server_->place().port; }
    [[nodiscard]] std::string host() const { return fmt::format("127.0.0.1:{}", port()); }
    [[nodiscard]] std::string request(const std::string& line,
                                      const std::string& body = "",
                                      const std::string& more = "") const {
        return fmt::format("{} HTTP/1.1\r\nHost: {}\r\nContent-Length: {}\r\n{}\r\n{}",
                           line,
                           host(),
                           body.size(),
                           more,
                           body);
    }
    std::string answer_to(const std::string& bytes) const {
        Client client(port());
        client.say(bytes);
        return client.read_all();
    }
    static int code_of(const std::string& answer) {
        return answer.size() > 12 ? std::stoi(answer.substr(9, 3)) : 0;
    }
    static nlohmann::json body_of(const std::string& answer) {
        return nlohmann::json::parse(answer.substr(answer.find("\r\n\r\n") + 4));
    }
    [[nodiscard]] std::string handshake(const std::string& more = "",
                                        const std::string& query = "") const {
        return fmt::format(
            "GET /ws{} HTTP/1.1\r\nHost: {}\r\nConnection: Upgrade\r\nUpgrade: websocket\r\n"
            "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: AAAAAAAAAAAAAAAAAAAAAA==\r\n{}\r\n",
            query,
            host(),
            more);
    }
    /// A page that is let in; its first two messages are read.
    std::unique_ptr<Client> page() {
        auto client = std::make_unique<Client>(port());
        client->say(handshake());
        EXPECT_NE(client->read_until("\r\n\r\n").find("101"), std::string::npos);
        EXPECT_EQ(next(*client, "hello")["dances"][0], "salsa");
        EXPECT_EQ(next(*client, "state")["bpm"], 96.0);
        return client;
    }
    /// The next message of a type; null at the end of the connection.
    static nlohmann::json next(Client& client, const std::string& type) {
        for (;;) {
            const std::string head = client.read(2);
            if (head.size() < 2 || (head[0] & 0x0F) == 8) {
                return nullptr;
            }
            std::size_t size = static_cast<unsigned char>(head[1]) & 0x7FU;
            if (size == 126) {
                const std::string more = client.read(2);
                size = static_cast<std::size_t>(static_cast<unsigned char>(more[0])) << 8U |
                       static_cast<unsigned char>(more[1]);
            }
            const std::string text = client.read(size);
            if (text.size() < size) {
                return nullptr;
            }
            if ((head[0] & 0x0F) == 1) {
                auto message = nlohmann::json::parse(text);
                if (message["type"] == type) {
                    return message;
                }
            }
        }
    }

    ActionDispatcher actions_{[](const std::string&) {}};
    std::atomic<int> taps_{0};
    std::atomic<double> nudged_{0.0};
    RequestInbox inbox_;
    std::unique_ptr<RemoteServer> server_;
    std::atomic<bool> is_over_{false};
    std::thread main_;
};

TEST_F(Server, http_asks_for_actions_and_gets_the_answer) {
    EXPECT_EQ(code_of(answer_to(request("POST /do/tap"))), 200);
    EXPECT_EQ(taps_, 1);
    EXPECT_EQ(code_of(answer_to(request("POST /do/nudge", "-10"))), 200);
    EXPECT_EQ(nudged_, -10.0);
    EXPECT_EQ(code_of(answer_to(request("POST /do/dance", "salsa"))), 200);
    const std::string refused = answer_to(request("POST /do/dance", "polka"));
    EXPECT_EQ(code_of(refused), 409);
    EXPECT_EQ(body_of(refused)["error"], "there is no polka");
    EXPECT_EQ(code_of(answer_to(request("POST /do/dance", "\xff"))), 400);
    EXPECT_EQ(code_of(answer_to(request("POST /do/quit"))), 400);
    EXPECT_EQ(code_of(answer_to(request("GET /do/tap"))), 405);
    EXPECT_EQ(code_of(answer_to(request("DELETE /state"))), 405);
    EXPECT_EQ(taps_, 1);
}

TEST_F(Server, http_has_the_state_and_the_page_and_no_files) {
    EXPECT_EQ(body_of(answer_to(request("GET /state")))["bpm"], 96.0);
    const std::string page = answer_to(request("GET /"));
    EXPECT_EQ(code_of(page), 200);
    EXPECT_NE(page.find("</html>"), std::string::npos);
    EXPECT_EQ(page.find("http://"), std::string::npos) << "nothing from outside";
    EXPECT_EQ(page.find("https://"), std::string::npos);
    for (const char* path : {"/etc/passwd", "/../etc/passwd", "/%2e%2e/etc/passwd", "/do", "/x"}) {
        EXPECT_EQ(code_of(answer_to(request(std::string("GET ") + path))), 404) << path;
    }
    EXPECT_EQ(code_of(answer_to(request("GET /ws"))), 426);
}

TEST_F(Server, who_may_not_is_refused_at_the_door) {
    const auto with_host = [](const std::string& host, const std::string& query = "") {
        return "POST /do/tap" + query + " HTTP/1.1\r\nHost: " + host +
               "\r\nContent-Length: 0\r\n\r\n";
    };
    const std::string foreign = "Origin: http://evil.example\r\n";
    EXPECT_EQ(code_of(answer_to(request("POST /do/tap", "", foreign))), 403);
    EXPECT_EQ(code_of(answer_to(with_host("evil.example"))), 403);
    EXPECT_EQ(code_of(answer_to(handshake(foreign))), 403);
    EXPECT_EQ(code_of(answer_to(handshake(foreign, "?token=0"))), 403);
    EXPECT_EQ(taps_, 0);
    EXPECT_EQ(code_of(answer_to(request("POST /do/tap?token=" + kServerToken, "", foreign))), 200);
    EXPECT_EQ(code_of(answer_to(request(
                  "POST /do/tap", "", foreign + "Authorization: Bearer " + kServerToken + "\r\n"))),
              200);
    EXPECT_EQ(code_of(answer_to(with_host("evil.example", "?token=" + kServerToken))), 200);
    EXPECT_EQ(taps_, 3);
    Client own(port());
    own.say(handshake("Origin: http://" + host() + "\r\n"));
    EXPECT_NE(own.read_until("\r\n\r\n").find("101"), std::string::npos);
}

TEST_F(Server, a_request_in_single_bytes_is_whole_and_a_huge_one_is_refused) {
    Client slow(port());
    for (const char c : request("POST /do/nudge", "7")) {
        slow.say(std::string(1, c));
    }
    EXPECT_EQ(code_of(slow.read_all()), 200);
    EXPECT_EQ(nudged_, 7.0);
    EXPECT_EQ(code_of(answer_to(request("POST /do/dance", std::string(70'000, 'x')))), 413);
    const std::string huge = answer_to(request("GET /", "", "X: " + std::string(40'000, 'x')));
    EXPECT_NE(code_of(huge), 200);
    EXPECT_NE(code_of(answer_to("\x16\x03\x01 no HTTP\r\n\r\n")), 200);
    EXPECT_EQ(code_of(answer_to(request("POST /do/tap"))), 200) << "it serves on";
}

TEST_F(Server, a_page_is_told_the_state_and_asks_for_actions) {
    const auto client = page();
    server_->publish(RemoteState{.bpm = 120.0});
    EXPECT_EQ(next(*client, "state")["bpm"], 120.0);
    client->say(frame(1, R"({"clock":5})"));
    EXPECT_EQ(next(*client, "clock")["clock"], 5.0);
    client->say(frame(1, R"({"do":"tap"})"));
    EXPECT_EQ(next(*client, "answer")["ok"], true);
    EXPECT_EQ(taps_, 1);
    client->say(frame(1, R"({"do":"dance","value":"polka"})"));
    EXPECT_EQ(next(*client, "answer")["error"], "there is no polka");
    client->say(frame(1, "{\"do\":\"\xff\"}"));
    EXPECT_EQ(next(*client, "answer")["error"], "a message is one JSON object");
    client->say(frame(1, std::string(200, '[')));
    EXPECT_EQ(next(*client, "answer")["ok"], false);
    EXPECT_EQ(server_->pages(), 1);
}

TEST_F(Server, a_page_that_floods_is_let_go_and_others_are_not) {
    const auto quiet = page();
    for (const int opcode : {1, 9}) {  // texts; pings
        const auto loud = page();
        const HostTime began = HostClock::now();
        for (int i = 0; i < 400 && loud->say(frame(opcode, R"({"do":"tap"})")); ++i) {
        }
        if (opcode == 1) {
            while (next(*loud, "answer") != nullptr) {
            }
            // What a second allows, and what was allowed anew while they came.
            const double seconds = to_seconds(HostClock::now() - began);
            EXPECT_LE(taps_, RemoteServer::kMostMessages * (1.0 + seconds));
        }
    }
    quiet->say(frame(1, R"({"clock":6})"));
    EXPECT_EQ(next(*quiet, "clock")["clock"], 6.0);
}

TEST_F(Server, the_ninth_connection_is_refused) {
    std::vector<std::unique_ptr<Client>> pages;
    pages.reserve(RemoteServer::kMostConnections);
    for (int i = 0; i < RemoteServer::kMostConnections; ++i) {
        pages.push_back(page());
    }
    EXPECT_EQ(code_of(answer_to(request("GET /state"))), 503);
    EXPECT_EQ(code_of(answer_to(handshake())), 503);
    pages.pop_back();
    while (server_->pages() == RemoteServer::kMostConnections) {
        std::this_thread::yield();
    }
    EXPECT_EQ(code_of(answer_to(request("GET /state"))), 200);
}

TEST_F(Server, a_port_that_is_taken_is_one_line) {
    const auto second = RemoteServer::open(server_->place(), kServerToken, inbox_);
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message, "--remote-address " + host() + ": Address already in use");
}

TEST_F(Server, the_link_has_the_token) {
    EXPECT_EQ(remote_link(server_->place(), kServerToken),
              "http://" + host() + "/?token=" + kServerToken);
    EXPECT_EQ(remote_link({"::1", 7880}, kServerToken), "http://[::1]:7880/?token=" + kServerToken);
    EXPECT_EQ(remote_link({"0.0.0.0", 7880}, kServerToken).find("0.0.0.0"), std::string::npos);
}

}  // namespace
}  // namespace raks::engine
