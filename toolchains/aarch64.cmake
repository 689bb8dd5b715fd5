# Debian arm64, for boards with a 64-bit ARM processor, such as the Raspberry Pi 3 and later.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(MFAR_TRIPLE aarch64-linux-gnu)
set(MFAR_EMULATOR qemu-aarch64-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
