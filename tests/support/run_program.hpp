#pragma once

#include <string>
#include <vector>

namespace raks::test {

/// Runs a program found on PATH without a shell, waits for it and returns what it wrote on stdout.
/// Throws std::runtime_error, with what it wrote on stderr, when it cannot be started or its exit
/// code is not 0.
std::string run_program(const std::vector<std::string>& command);

}  // namespace raks::test
