#include "engine/show/listed_devices.hpp"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <system_error>

#include "base/child_process.hpp"
#include "base/descriptor.hpp"

#include <nlohmann/json.hpp>

namespace raks::engine {
namespace {

using Document = nlohmann::json;

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
constexpr std::chrono::seconds kLongest(5);

ListedDevice device_of(const Document& entry) {
    ListedDevice device;
    device.name = entry.value("name", std::string());
    device.system = entry.value("host_api", std::string());
    device.is_input = entry.value("inputs", 0) > 0;
    device.is_output = entry.value("outputs", 0) > 0;
    device.is_monitor = entry.value("monitor", false);
    device.monitor_of = entry.value("monitor_of", std::string());
    if (const auto level = entry.find("level_dbfs"); level != entry.end() && level->is_number()) {
        device.level_dbfs = level->get<float>();
    }
    return device;
}

// All that comes until the end; errors: too late, too much.
Expected<std::string> read_to_end(int descriptor) {
    const auto deadline = std::chrono::steady_clock::now() + kLongest;
    std::string text;
    std::array<char, 4096> part{};
    for (;;) {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
            deadline - std::chrono::steady_clock::now());
        pollfd waiting{descriptor, POLLIN, 0};
        if (left.count() <= 0 || ::poll(&waiting, 1, static_cast<int>(left.count())) == 0) {
            return fail("the sound system does not say which devices there are");
        }
        const ssize_t count = ::read(descriptor, part.data(), part.size());
        if (count <= 0) {
            return text;
        }
        text.append(part.data(), static_cast<std::size_t>(count));
        if (text.size() > kMostBytes) {
            return fail("the list of devices is too long");
        }
    }
}

}  // namespace

Expected<std::vector<ListedDevice>> parse_devices(const std::string& json) {
    constexpr bool kThrows = false;
    const Document document = Document::parse(json, nullptr, kThrows);
    const auto list = document.is_object() ? document.find("devices") : document.end();
    if (!document.is_object() || list == document.end() || !list->is_array()) {
        return fail("no sound device was found");
    }
    std::vector<ListedDevice> devices;
    try {
        for (const Document& entry : *list) {
            if (entry.is_object()) {
                devices.push_back(device_of(entry));
            }
        }
    } catch (const Document::exception&) {
        return fail("the list of devices cannot be read");
    }
    return devices;
}

// A shell gives the child's standard output, which spawn_child closes, back to us.
Expected<std::vector<ListedDevice>> ask_for_devices() {
    std::error_code problem;
    const auto self = std::filesystem::read_symlink("/proc/self/exe", problem);
    std::array<int, 2> ends{};
    if (problem || ::pipe2(ends.data(), O_CLOEXEC) != 0) {
        return fail("devices cannot be asked for: " + std::generic_category().message(errno));
    }
    const Descriptor ours(ends[0]);
    Descriptor childs(ends[1]);
    const auto child = spawn_child(
        {.program = "/bin/sh",
         .arguments = {"-c", R"(exec "$0" devices --json --levels >&3 3>&-)", self.string()},
         .descriptors = std::array{childs.number},
         .has_our_environment = true});
    childs.close();
    if (!child) {
        return fail(child.error());
    }
    const auto text = read_to_end(ours.number);
    end_child_group(*child);
    return text ? parse_devices(*text) : fail(text.error());
}

}  // namespace raks::engine
