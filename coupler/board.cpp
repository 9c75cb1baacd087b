#include "coupler/board.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>

namespace coupler {

namespace {

using Clock = std::chrono::steady_clock;

/// Longer lines would wrap and leave remains when the board is redrawn.
std::size_t terminal_width() {
    winsize size{};
    constexpr std::size_t usual = 80;
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

Board::Board(bool is_quiet)
    : is_quiet_(is_quiet), is_terminal_(::isatty(STDERR_FILENO) != 0), last_(Clock::now()) {}

bool Board::is_due() const {
    using namespace std::chrono_literals;
    return !is_quiet_ && Clock::now() - last_ >= (is_terminal_ ? 250ms : 10s);
}

void Board::show(const std::vector<std::string>& lines) {
    last_ = Clock::now();
    if (is_quiet_) return;
    if (is_terminal_) erase();
    print(lines);
    if (is_terminal_) shown_ = lines;
}

void Board::say(const std::string& message) {
    if (is_terminal_) erase();
    fmt::print(stderr, "{}\n", message);
    if (is_terminal_) print(shown_);
}

void Board::finish(const std::vector<std::string>& lines) {
    show(lines);
    shown_.clear();
}

void Board::erase() {
    if (!shown_.empty()) fmt::print(stderr, "\x1b[{}A\r\x1b[J", shown_.size());
}

void Board::print(const std::vector<std::string>& lines) {
    for (const auto& line : lines)
        fmt::print(stderr, "{}\n", is_terminal_ ? line.substr(0, terminal_width() - 1) : line);
    std::fflush(stderr);
}

std::string duration_text(double seconds) {
    if (seconds < 100) return fmt::format("{:.0f} s", seconds);
    if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
    return fmt::format("{:.1f} h", seconds / 3600);
}

std::string memory_text(double bytes) {
    return fmt::format("{:.0f} MB", bytes / 1e6);
}

}  // namespace coupler
