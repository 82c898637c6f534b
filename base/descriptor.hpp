#pragma once

#include <unistd.h>

#include <utility>

namespace raks {

/// A descriptor that is closed at the end of its scope.
struct Descriptor {
    int number = -1;  ///< < 0: none
    Descriptor() = default;
    /// Takes it over.
    explicit Descriptor(int taken) noexcept : number(taken) {}
    Descriptor(const Descriptor&) = delete;             ///< one owner
    Descriptor& operator=(const Descriptor&) = delete;  ///< likewise
    /// Takes over what the other owned; its own is closed.
    Descriptor& operator=(Descriptor&& other) noexcept {
        if (this != &other) {
            close();
            number = other.release();
        }
        return *this;
    }
    ~Descriptor() { close(); }
    /// Gives it away.
    [[nodiscard]] int release() noexcept { return std::exchange(number, -1); }
    /// Closes it now.
    void close() noexcept {
        if (number >= 0) {
            ::close(std::exchange(number, -1));
        }
    }
};

}  // namespace raks
