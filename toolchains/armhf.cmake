# Debian armhf: 32-bit ARMv7 with a floating-point unit.
set(CMAKE_SYSTEM_PROCESSOR armhf)
set(MFAR_TRIPLE arm-linux-gnueabihf)
set(MFAR_EMULATOR qemu-arm-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
# Nothing that GCC 6 made is linked, whose calls were others.
string(APPEND CMAKE_CXX_FLAGS_INIT " -Wno-psabi")
