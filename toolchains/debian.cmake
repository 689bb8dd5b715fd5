# Common part of the toolchain files, which first set MFAR_TRIPLE, MFAR_EMULATOR and
# CMAKE_SYSTEM_PROCESSOR. The sysroot (headers and libraries of the board's architecture) is
# .build/sysroot-<processor>, a symbolic link that `./run cross` creates.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_LIBRARY_ARCHITECTURE ${MFAR_TRIPLE})
set(CMAKE_CXX_COMPILER ${MFAR_TRIPLE}-g++)

get_filename_component(CMAKE_SYSROOT
    ${CMAKE_CURRENT_LIST_DIR}/../.build/sysroot-${CMAKE_SYSTEM_PROCESSOR} ABSOLUTE)
if(NOT EXISTS ${CMAKE_SYSROOT}/usr/include)
    message(FATAL_ERROR "${CMAKE_SYSROOT} is missing: run ./run cross ${CMAKE_SYSTEM_PROCESSOR}")
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${CMAKE_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR}
    ${CMAKE_SYSROOT}/usr/lib/${MFAR_TRIPLE}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig)

set(CMAKE_CROSSCOMPILING_EMULATOR ${MFAR_EMULATOR} -L ${CMAKE_SYSROOT})
