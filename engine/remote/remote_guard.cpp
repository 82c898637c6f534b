#include "engine/remote/remote_guard.hpp"

#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <system_error>
#include <utility>

#include "base/descriptor.hpp"

#include <fmt/format.h>

namespace raks::engine {
namespace {

constexpr std::size_t kTokenBytes = 16;

bool is_token(std::string_view text) {
    return text.size() == 2 * kTokenBytes && std::all_of(text.begin(), text.end(), [](char c) {
               return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
           });
}

// Takes as long for every text of the token's length: how far it is right cannot be measured.
bool is_same(std::string_view token, std::string_view given) {
    if (token.size() != given.size() || token.empty()) {
        return false;
    }
    unsigned difference = 0;
    for (std::size_t i = 0; i < token.size(); ++i) {
        difference |= static_cast<unsigned>(static_cast<unsigned char>(token[i])) ^
                      static_cast<unsigned>(static_cast<unsigned char>(given[i]));
    }
    return difference == 0;
}

bool is_this_machine(std::string_view address) {
    return address == "::1" || address.starts_with("127.") || address.starts_with("::ffff:127.");
}

Expected<std::string> token_in(int file, const std::string& name) {
    struct stat state {};
    if (fstat(file, &state) != 0 || !S_ISREG(state.st_mode) || state.st_uid != geteuid() ||
        (state.st_mode & 077U) != 0) {
        return fail(name + ": others may read it; remove it, and a new token is made");
    }
    std::array<char, 2 * kTokenBytes + 2> text{};
    const ssize_t size = read(file, text.data(), text.size());
    std::string_view token(text.data(), static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    token = token.substr(0, token.find('\n'));
    return is_token(token) ? Expected<std::string>(std::string(token))
                           : fail(name + ": no token is in it; remove it, and a new one is made");
}

}  // namespace

Expected<std::string> new_remote_token() {
    std::array<unsigned char, kTokenBytes> bytes{};
    if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        return fail("no random numbers: " + std::generic_category().message(errno));
    }
    std::string token;
    for (const unsigned char byte : bytes) {
        token += fmt::format("{:02x}", byte);
    }
    return token;
}

Expected<std::string> kept_remote_token(const std::filesystem::path& folder) {
    if (folder.empty()) {
        return fail("there is no folder for a token that stays: set XDG_STATE_HOME");
    }
    const std::string name = (folder / "remote-token").string();
    const Descriptor kept(open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK));
    if (kept.number >= 0) {
        return token_in(kept.number, name);
    }
    if (errno != ENOENT) {
        return fail(name + ": " + std::generic_category().message(errno));
    }
    auto token = new_remote_token();
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    const Descriptor made(open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600));
    const std::string line = token ? *token + "\n" : "";
    if (token && (made.number < 0 || write(made.number, line.data(), line.size()) !=
                                         static_cast<ssize_t>(line.size()))) {
        return fail(name + ": " + std::generic_category().message(errno));
    }
    return token;
}

RemoteGuard::RemoteGuard(std::string token, std::string address, std::uint16_t port)
    : token_(std::move(token)), address_(std::move(address)), port_(std::to_string(port)) {}

// With the port, as browsers send it where it is not 80.
bool RemoteGuard::is_own_name(std::string_view host) const {
    const std::string bracketed = "[" + address_ + "]";
    for (const std::string_view name : {std::string_view("localhost"),
                                        std::string_view("127.0.0.1"),
                                        std::string_view("[::1]"),
                                        std::string_view(address_),
                                        std::string_view(bracketed)}) {
        if (host.starts_with(name) && host.substr(name.size()) == ":" + port_) {
            return true;
        }
    }
    return false;
}

std::string_view RemoteGuard::refusal(const RemoteCaller& caller) const {
    if (is_same(token_, caller.token)) {
        return {};
    }
    if (!is_this_machine(caller.address)) {
        return "from another machine the token is needed: it is in the link that Raks shows";
    }
    if (!is_own_name(caller.host)) {
        return "this is not the host's name: give localhost, or the token";
    }
    if (caller.origin && *caller.origin != "http://" + caller.host) {
        return "a page of somebody else needs the token: it is in the link that Raks shows";
    }
    return {};
}

}  // namespace raks::engine
