// In place of link_session.cpp where the program is built without it.
#include "engine/remote/link_session.hpp"

namespace raks::engine {

Expected<std::unique_ptr<LinkSession>> LinkSession::open() {
    return fail("--link: this raks was built without Ableton Link (RAKS_LINK)");
}

}  // namespace raks::engine
