#include "common/errors.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <new>
#include <string_view>

namespace common {

namespace {
std::atomic<bool> interrupt_raised{false};
extern "C" void raise_interrupt(int) {
    interrupt_raised.store(true, std::memory_order_relaxed);
}
}  // namespace

namespace {

/// A line each, all with the program's name, so that a log of several programs stays readable.
void print_lines(const std::string& program, std::string_view message) {
    while (!message.empty()) {
        const auto end = std::min(message.find('\n'), message.size());
        fmt::print(stderr, "{}: {}\n", program, message.substr(0, end));
        message.remove_prefix(std::min(end + 1, message.size()));
    }
}

}  // namespace

int run_guarded(const std::string& program, const std::function<int()>& body) {
    watch_for_interrupts();
    try {
        return body();
    } catch (const InputError& error) {
        print_lines(program, error.what());
        return exit_bad_input;
    } catch (const Interrupted&) {
        fmt::print(stderr, "{}: interrupted; finished windows are kept, --resume goes on from them\n",
                   program);
        return exit_interrupted;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "{}: out of memory\n", program);
        return exit_failed;
    } catch (const std::exception& error) {
        print_lines(program, error.what());
        return exit_failed;
    }
}

void watch_for_interrupts() {
    struct sigaction action {};
    action.sa_handler = raise_interrupt;
    sigaction(SIGINT, &action, nullptr);
    sigaction(SIGTERM, &action, nullptr);
    // A terminal that was closed ends a run like Ctrl-C; under nohup it goes on.
    struct sigaction hangup {};
    sigaction(SIGHUP, nullptr, &hangup);
    if (hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
    // A write past a file-size limit must fail with EFBIG, not kill the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
}

void check_for_interrupt() {
    if (interrupt_raised.load(std::memory_order_relaxed)) throw Interrupted();
}

}  // namespace common
