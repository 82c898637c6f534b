// In place of remote_server.cpp and link_code.cpp where the program is built without them.
#include "engine/remote/link_code.hpp"
#include "engine/remote/remote_server.hpp"

namespace raks::engine {

LinkCode link_code(const std::string& /*link*/) { return {}; }

bool RemoteServer::is_built() noexcept { return false; }

Expected<std::unique_ptr<RemoteServer>> RemoteServer::open(const ListenPlace& /*place*/,
                                                           const std::string& /*token*/,
                                                           RequestInbox& /*inbox*/) {
    return fail("--remote: this raks was built without it (RAKS_REMOTE); --osc-in is there");
}

}  // namespace raks::engine
