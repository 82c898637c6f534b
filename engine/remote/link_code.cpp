#include "engine/remote/link_code.hpp"

#include <qrencode.h>

#include <memory>

namespace raks::engine {

LinkCode link_code(const std::string& link) {
    // Of four levels the second: a screen is clean, and the modules stay large.
    const std::unique_ptr<QRcode, decltype(&QRcode_free)> made(
        QRcode_encodeString(link.c_str(), 0, QR_ECLEVEL_M, QR_MODE_8, 1), &QRcode_free);
    LinkCode code;
    if (made == nullptr) {
        return code;
    }
    code.side = static_cast<std::size_t>(made->width);
    code.modules.resize(code.side * code.side);
    // The lowest bit of each byte is the module, the others say what it is for.
    for (std::size_t i = 0; i < code.modules.size(); ++i) {
        code.modules[i] = made->data[i] & 1U;
    }
    return code;
}

}  // namespace raks::engine
