# The Debian package. `cpack` in the build folder or `./run package` builds it. Each distribution
# and architecture needs its own package, because the sonames of libcamera and OpenCV differ.
if(CMAKE_CROSSCOMPILING)
    set(architectures aarch64 arm64 armhf armhf)
    list(FIND architectures ${CMAKE_SYSTEM_PROCESSOR} known)
    if(known EQUAL -1)
        return()
    endif()
    math(EXPR known "${known} + 1")
    list(GET architectures ${known} CPACK_DEBIAN_PACKAGE_ARCHITECTURE)
else()
    # The processor does not suffice: a 64-bit kernel can run a 32-bit system.
    execute_process(COMMAND dpkg --print-architecture OUTPUT_VARIABLE architecture
                    OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
    if(failed)
        return()
    endif()
    set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE ${architecture})
endif()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME mfar)
set(CPACK_PACKAGE_CONTACT "the mfar authors <mfar@localhost>")
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/package)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION
"mfard lifts the video of one image sensor to the resolution of a second one
that takes stills on a trigger, finds the camera's pose by AprilTags, and shows
virtual objects behind real ones. It runs as a service on small Linux boards.")
if(NOT MFAR_PATH_TRACING)
    string(APPEND CPACK_DEBIAN_PACKAGE_DESCRIPTION
           "\n .\n This build has no path tracer: virtual objects are simple shapes.")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION video)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_STRIP_FILES ON)
# The configuration is installed in /etc, outside the prefix.
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)

# depends.cmake adds the packages of the shared libraries. procps contains the kill command that
# reloads the service.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "init-system-helpers, procps, systemd, udev")
# Programs load OpenGL ES at run time and also start without it. Without libcamera-ipa, libcamera
# finds no camera on a board's CSI connector.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libcamera-ipa, libegl1, libgl1-mesa-dri, libgles2")
set(CPACK_MFAR_SYSROOT ${CMAKE_SYSROOT})
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/depends.cmake)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
    ${CMAKE_CURRENT_LIST_DIR}/conffiles ${CMAKE_CURRENT_LIST_DIR}/postinst
    ${CMAKE_CURRENT_LIST_DIR}/postrm ${CMAKE_CURRENT_LIST_DIR}/prerm)

# README.md and docs link to the other files.
install(FILES ${CMAKE_CURRENT_LIST_DIR}/copyright ${CMAKE_SOURCE_DIR}/README.md
              ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/CONTRIBUTING.md
              ${CMAKE_SOURCE_DIR}/LICENSE
        DESTINATION share/doc/mfar)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION share/doc/mfar PATTERN man EXCLUDE)
foreach(folder boards testbed)
    install(FILES ${CMAKE_SOURCE_DIR}/toolchains/${folder}/README.md
            DESTINATION share/doc/mfar/toolchains/${folder})
endforeach()
include(CPack)
