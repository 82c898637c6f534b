#pragma once

#include <string_view>

namespace raks::engine {

/// The page for phones, remote_page.html: one document that needs nothing else. Threads: any.
[[nodiscard]] std::string_view remote_page() noexcept;

}  // namespace raks::engine
