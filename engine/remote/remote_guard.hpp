#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/expected.hpp"

/// Who may ask for something over HTTP.
namespace raks::engine {

/// 128 random bits as 32 hexadecimal digits. Errors: the system has none. Threads: any.
[[nodiscard]] Expected<std::string> new_remote_token();
/// The one that is kept in `folder`, for this user alone; the first time a new one. Errors: the
/// system's; the file does not hold a token, or others may read it. Threads: main.
[[nodiscard]] Expected<std::string> kept_remote_token(const std::filesystem::path& folder);

/// What a request says of who sends it.
struct RemoteCaller {
    std::string address;                ///< from where: "127.0.0.1", "::1", "192.168.1.20"
    std::string host;                   ///< header Host; empty: none
    std::optional<std::string> origin;  ///< header Origin: a page sends it
    std::string token;                  ///< `?token=`, or behind `Authorization: Bearer`
};

/// A request may pass
/// - with the token, from wherever it comes;
/// - without it, from this machine alone, where its Host is this machine's name for itself (a page
///   of another name may have been resolved to this address) and its Origin, if any, our own page.
///
/// Threads: any; it does not change. Real-time: no.
class RemoteGuard {
 public:
    /// `port`: at which the requests come; `address`: what is listened to, as the person gave it.
    RemoteGuard(std::string token, std::string address, std::uint16_t port);

    /// Why it may not, in one line; empty: it may.
    [[nodiscard]] std::string_view refusal(const RemoteCaller& caller) const;
    /// The token.
    [[nodiscard]] const std::string& token() const noexcept { return token_; }

 private:
    [[nodiscard]] bool is_own_name(std::string_view host) const;

    std::string token_;
    std::string address_;
    std::string port_;
};

}  // namespace raks::engine
