#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/expected.hpp"
#include "base/time.hpp"
#include "engine/outputs/beat_schedule.hpp"

namespace raks::engine {

/// Something that others are told, and when.
struct OutputMoment {
    Notice notice;        ///< what
    HostTime heard_at{};  ///< when it is heard
};

/// One target outside of the program that is told what the music does. It owns one descriptor or
/// port, which never blocks, and its counters; it sees nothing else.
///
/// Threads: the constructor on main, counters from any, all else on the outputs' thread alone.
class Output {
 public:
    Output() = default;
    virtual ~Output() = default;                ///< says goodbye where its protocol has one
    Output(const Output&) = delete;             ///< owns a descriptor
    Output& operator=(const Output&) = delete;  ///< likewise

    /// Tells of a moment that is heard now. What cannot be sent at once is dropped and counted.
    virtual void tell(const OutputMoment& moment) = 0;
    /// A line for the person where it has failed since the last call.
    [[nodiscard]] virtual std::optional<std::string> take_trouble() { return std::nullopt; }

    /// Messages that were sent.
    [[nodiscard]] std::uint64_t sent() const noexcept { return sent_.load(); }
    /// Messages that were not, as the other side was slow or not there.
    [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(); }

 protected:
    void count_sent() noexcept { ++sent_; }        ///< one message
    void count_dropped() noexcept { ++dropped_; }  ///< one message

 private:
    std::atomic<std::uint64_t> sent_{0};
    std::atomic<std::uint64_t> dropped_{0};
};

/// A kind of output: a row of the table. To add one, write its file pair and its row in
/// output_table.cpp; option, help and manual follow from the row.
struct OutputKind {
    std::string_view option;  ///< of play and live, without "--"
    std::string_view target;  ///< what stands behind it, for the help: "FILE"
    std::string_view help;    ///< one line
    /// Opens it. Errors: the target is none, or cannot be opened.
    Expected<std::unique_ptr<Output>> (*open)(const std::string& target);
};

/// Outputs of one kind, at most.
inline constexpr std::size_t kMostOutputs = 16;

/// All kinds, in the order of the help.
[[nodiscard]] std::span<const OutputKind> output_kinds() noexcept;

}  // namespace raks::engine
