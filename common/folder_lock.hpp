/// One writer at a time in a folder.
#pragma once

#include <filesystem>
#include <string>

namespace common {

/// Holds DIR/.lock while it lives.
class FolderLock {
 public:
    /// Creates the folder when needed. Throws InputError when it cannot be written, or when another process
    /// holds it: the message then says that another `holder` is running ("run", "chain"). A file system
    /// without locks is told, and the run goes on.
    FolderLock(const std::filesystem::path& folder, const std::string& holder);
    ~FolderLock();
    FolderLock(const FolderLock&) = delete;
    FolderLock& operator=(const FolderLock&) = delete;

 private:
    int descriptor_;
};

/// True while a living process holds the lock of the folder; false where the file system has no locks.
bool is_locked(const std::filesystem::path& folder);

}  // namespace common
