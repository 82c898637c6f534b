#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/descriptor.hpp"

/// Programs that are told something, as tests play them. Everything on 127.0.0.1.
namespace raks::test {

/// Takes datagrams.
class UdpReceiver {
 public:
    /// `port`: 0: a free one.
    explicit UdpReceiver(std::uint16_t port = 0);
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    /// "127.0.0.1:PORT"
    [[nodiscard]] std::string place() const;
    /// All that has come, without waiting. What was sent on this machine has come at once. The
    /// system keeps about 2,000 small datagrams; more are lost.
    [[nodiscard]] std::vector<std::string> take_all();

 private:
    Descriptor socket_;
    std::uint16_t port_ = 0;
};

/// Takes one connection at a time.
class TcpListener {
 public:
    explicit TcpListener(std::uint16_t port = 0);
    [[nodiscard]] std::uint16_t port() const noexcept { return port_; }
    [[nodiscard]] std::string place() const;
    /// Waits for a connection, 10 s at most. False: there was none.
    [[nodiscard]] bool accept();
    /// What one read gives; waits for it, 10 s at most. Empty: the connection has ended.
    [[nodiscard]] std::string read();
    /// Says something.
    void write(const std::string& text);
    /// Ends the connection; the next one can be accepted.
    void hang_up() { connection_.close(); }

 private:
    Descriptor socket_;
    Descriptor connection_;
    std::uint16_t port_ = 0;
};

}  // namespace raks::test
