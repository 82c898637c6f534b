#pragma once

namespace raks::engine {

/// What raks-decode does first: it waits, with its libraries loaded, and copies itself for each
/// decoder that raks asks for. The copies are raks' own children, which it can end and wait for.
/// Returns true in a copy, whose descriptors (decode_protocol.hpp) are in place; false where raks
/// has ended, or speaks otherwise. Threads: the only one. Real-time: no.
[[nodiscard]] bool become_decoder();

}  // namespace raks::engine
