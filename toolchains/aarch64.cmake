# Debian arm64: boards with 64-bit ARM, from the Raspberry Pi 3 on.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(MFAR_TRIPLE aarch64-linux-gnu)
set(MFAR_EMULATOR qemu-aarch64-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)
