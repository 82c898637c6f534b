#pragma once

#include <memory>
#include <string>

#include "tests/support/process.hpp"

namespace raks::test {

/// A display of one's own for as long as this lives: starts Xvfb on a free number and sets DISPLAY
/// and LIBGL_ALWAYS_SOFTWARE in this process. Throws std::runtime_error with what is missing when
/// Xvfb does not start: a test then fails, it does not skip.
class Xvfb {
 public:
    explicit Xvfb(int width = 1280, int height = 720);
    ~Xvfb();
    Xvfb(const Xvfb&) = delete;
    Xvfb& operator=(const Xvfb&) = delete;

    /// ":7"
    [[nodiscard]] const std::string& display() const noexcept { return display_; }

 private:
    std::unique_ptr<CapturedProcess> server_;
    std::string display_;
};

}  // namespace raks::test
