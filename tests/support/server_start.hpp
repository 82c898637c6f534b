#pragma once

#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>

/// What tests need that start a server of their own.
namespace raks::test {

/// For this process and its children. Threads: main, before others run.
inline void set_variable(const char* name, const std::string& value) {
    setenv(name, value.c_str(), 1);  // NOLINT(concurrency-mt-unsafe)
}

/// Asks every 50 ms, for 10 s, whether a server answers, as it has no "ready" to wait for; false
/// when it does not.
inline bool wait_for_answer(const std::function<bool()>& answers) {
    for (int i = 0; i < 200; ++i) {
        if (answers()) {
            return true;
        }
        const timespec pause{0, 50'000'000};
        nanosleep(&pause, nullptr);
    }
    return false;
}

}  // namespace raks::test
