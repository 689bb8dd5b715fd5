# Debian armhf, for 32-bit ARMv7 processors with a floating-point unit.
set(CMAKE_SYSTEM_PROCESSOR armhf)
set(MFAR_TRIPLE arm-linux-gnueabihf)
set(MFAR_EMULATOR qemu-arm-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
# GCC warns where its ABI differs from that of GCC 6. The warning is of no use, because no library
# is built by GCC 6.
string(APPEND CMAKE_CXX_FLAGS_INIT " -Wno-psabi")
