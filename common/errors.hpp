/// Error types and exit statuses shared by all programs.
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace common {

/// Exit statuses of every program.
enum ExitStatus : int { exit_done = 0, exit_failed = 1, exit_bad_input = 2, exit_interrupted = 130 };

/// The user's input is wrong: scene, layout, command line, or an upstream file. Exit 2.
/// The message is one clear line (or one line per mistake): file, line, key, what was expected.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The run itself went wrong: unstable, disk full, upstream failed. Exit 1; what was published stays valid.
struct RunError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Ctrl-C or a polite kill. Exit 130; what was published stays valid.
struct Interrupted : std::exception {
    const char* what() const noexcept override { return "interrupted"; }
};

/// Watches for interrupts, runs a program's body, and turns its errors into one message on stderr and an exit
/// status.
int run_guarded(const std::string& program, const std::function<int()>& body);

/// Installs handlers for SIGINT and SIGTERM that only raise a flag.
void watch_for_interrupts();

/// Throws Interrupted once the flag is up. Cheap: one relaxed atomic load; call it once a step.
void check_for_interrupt();

}  // namespace common
