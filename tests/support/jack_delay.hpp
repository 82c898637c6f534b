#pragma once

#include <memory>
#include <string>

namespace raks::test {

/// A JACK client of this process whose one output repeats its one input so many frames later, and
/// does not tell JACK so: a way of known length that no latency reports. Inputs and outputs of it
/// are devices like those of any client.
class JackDelay {
 public:
    /// On the server that JACK_DEFAULT_SERVER names.
    JackDelay(const std::string& name, std::size_t frames);
    ~JackDelay();
    JackDelay(const JackDelay&) = delete;
    JackDelay& operator=(const JackDelay&) = delete;

    /// From now on every sound behind a tenth of a second of silence is also tapped to: a byte is
    /// written to this file when it comes in.
    void tap_into(int descriptor) noexcept;

    /// False when the server refused.
    [[nodiscard]] bool is_running() const noexcept { return line_ != nullptr; }

    struct Line;  ///< what its callback works on

 private:
    std::unique_ptr<Line> line_;
};

}  // namespace raks::test
