#include "common/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "common/errors.hpp"

namespace common {

namespace fs = std::filesystem;

namespace {

/// NFS without a lock daemon, Lustre mounted without flock, and others.
bool has_no_locks(int reason) {
    return reason == ENOLCK || reason == ENOSYS || reason == EOPNOTSUPP || reason == EINVAL;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder, const std::string& holder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw InputError(
            fmt::format("{}: cannot create the output folder: {}", folder.string(), error.message()));
    descriptor_ = ::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
        throw InputError(fmt::format("{}: cannot write here: {}", folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const int reason = errno;
    if (reason == EWOULDBLOCK) {
        ::close(descriptor_);
        throw InputError(fmt::format("{}: another {} is running here", folder.string(), holder));
    }
    if (!has_no_locks(reason)) {
        ::close(descriptor_);
        throw InputError(
            fmt::format("{}: cannot lock the output folder: {}", folder.string(), std::strerror(reason)));
    }
    // Some network file systems are mounted without locks: the run goes on, and the user has to take care.
    fmt::print(stderr, "{}: this file system has no locks ({}): goes on without; start no second {} here\n",
               folder.string(), std::strerror(reason), holder);
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

bool is_locked(const fs::path& folder) {
    const int descriptor = ::open((folder / ".lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool is_free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    ::close(descriptor);
    return !is_free;
}

}  // namespace common
