# Builds for 64-bit ARM on another machine: compiler of Debian's g++-aarch64-linux-gnu, libraries of the folder SYSROOT,
# which workflows/cross/check_arm64 fills.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(sysroot "$ENV{TSUNAGI_ARM64_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH "${sysroot}/usr" "${sysroot}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-L${sysroot}/usr/lib/aarch64-linux-gnu/hdf5/serial -L${sysroot}/usr/lib/aarch64-linux-gnu -Wl,-rpath-link,${sysroot}/usr/lib/aarch64-linux-gnu:${sysroot}/lib/aarch64-linux-gnu")
# FindHDF5 asks a compiler wrapper, of which there is none for another machine: it is told.
set(HDF5_hdf5_LIBRARY "${sysroot}/usr/lib/aarch64-linux-gnu/hdf5/serial/libhdf5.so" CACHE FILEPATH "")
set(CMAKE_CXX_STANDARD_INCLUDE_DIRECTORIES
    "${sysroot}/usr/include/hdf5/serial" "${sysroot}/usr/include/aarch64-linux-gnu")
