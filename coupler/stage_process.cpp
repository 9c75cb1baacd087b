#include "coupler/stage_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <thread>

#include "common/errors.hpp"

namespace coupler {

namespace {

struct Pipe {
    int read_end = -1, write_end = -1;
};

Pipe open_pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw common::RunError(fmt::format("cannot open a pipe: {}", std::strerror(errno)));
    ::fcntl(ends[0], F_SETFL, O_NONBLOCK);
    return {ends[0], ends[1]};
}

/// In the child, between fork and exec: only async-signal-safe calls.
[[noreturn]] void become(const std::vector<char*>& arguments, pid_t parent, int output, int messages) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(common::exit_failed);  // the parent died before the line above
    ::dup2(output, STDOUT_FILENO);
    ::dup2(messages, STDERR_FILENO);
    ::execv(arguments.front(), arguments.data());
    const char* reason = ::strerrordesc_np(errno);
    for (const char* part :
         {"cannot start ", static_cast<const char*>(arguments.front()), ": ", reason, "\n"})
        if (::write(STDERR_FILENO, part, std::strlen(part)) < 0) break;
    ::_exit(common::exit_failed);
}

/// Appends what a pipe holds now; closes it at its end.
void drain(int& pipe, std::string& text) {
    std::array<char, 4096> buffer{};
    while (pipe >= 0) {
        const ssize_t count = ::read(pipe, buffer.data(), buffer.size());
        if (count > 0) {
            text.append(buffer.data(), static_cast<std::size_t>(count));
        } else if (count < 0 && errno == EINTR) {
            continue;
        } else {
            if (count == 0) {
                ::close(pipe);
                pipe = -1;
            }
            return;
        }
    }
}

double seconds(const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

std::string Ending::describe() const {
    if (signal != 0) return fmt::format("killed by signal {} ({})", signal, ::strsignal(signal));
    return fmt::format("exit status {}", status);
}

StageProcess::StageProcess(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const auto& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    const Pipe output = open_pipe(), messages = open_pipe();
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) become(arguments, parent, output.write_end, messages.write_end);
    const int reason = errno;
    ::close(output.write_end);
    ::close(messages.write_end);
    output_pipe_ = output.read_end;
    message_pipe_ = messages.read_end;
    if (process_ < 0) {
        ::close(output_pipe_);
        ::close(message_pipe_);
        throw common::RunError(fmt::format("cannot start {}: {}", command.front(), std::strerror(reason)));
    }
}

StageProcess::~StageProcess() {
    if (!has_ended()) {
        send(SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    if (output_pipe_ >= 0) ::close(output_pipe_);
    if (message_pipe_ >= 0) ::close(message_pipe_);
}

void StageProcess::read_pipes() {
    drain(output_pipe_, output_);
    drain(message_pipe_, pending_messages_);
}

void StageProcess::poll() {
    if (has_ended()) return;
    read_pipes();
    int status = 0;
    rusage usage{};
    if (::wait4(process_, &status, WNOHANG, &usage) != process_) return;
    read_pipes();
    constexpr double bytes_per_unit = 1024;  // ru_maxrss is in KiB
    ending_ = Ending{.status = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
                     .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
                     .wall_seconds = wall_seconds(),
                     .cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime),
                     .peak_memory = bytes_per_unit * static_cast<double>(usage.ru_maxrss)};
}

double StageProcess::wall_seconds() const {
    if (has_ended()) return ending_->wall_seconds;
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

std::vector<std::string> StageProcess::take_messages() {
    if (has_ended() && !pending_messages_.empty() && pending_messages_.back() != '\n')
        pending_messages_ += '\n';
    std::vector<std::string> lines;
    std::size_t from = 0;
    for (std::size_t end; (end = pending_messages_.find('\n', from)) != std::string::npos; from = end + 1)
        if (end > from) lines.push_back(pending_messages_.substr(from, end - from));
    pending_messages_.erase(0, from);
    return lines;
}

void StageProcess::send(int signal) const {
    if (!has_ended()) ::kill(process_, signal);
}

void wait_for_end(StageProcess& process) {
    for (process.poll(); !process.has_ended(); process.poll()) {
        common::check_for_interrupt();
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
}

}  // namespace coupler
