#pragma once

#include <span>
#include <string_view>
#include <utility>

namespace raks::apps {

/// The scripts of packaging/completion, by shell: "bash" and its text. Threads: any.
[[nodiscard]] std::span<const std::pair<std::string_view, std::string_view>>
completion_scripts() noexcept;

}  // namespace raks::apps
