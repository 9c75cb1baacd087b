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

FolderLock::FolderLock(const fs::path& folder, const std::string& holder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        throw InputError(
            fmt::format("{}: cannot create the output folder: {}", folder.string(), error.message()));
    descriptor_ = ::open((folder / ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (descriptor_ < 0)
        throw InputError(fmt::format("{}: cannot write here: {}", folder.string(), std::strerror(errno)));
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
        ::close(descriptor_);
        throw InputError(fmt::format("{}: another {} is running here", folder.string(), holder));
    }
}

FolderLock::~FolderLock() {
    ::close(descriptor_);
}

bool is_locked(const fs::path& folder) {
    const int descriptor = ::open((folder / ".lock").c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return false;
    const bool is_free = ::flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    ::close(descriptor);
    return !is_free;
}

}  // namespace common
